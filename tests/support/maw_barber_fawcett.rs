//! Oblique impact of an elastic sphere with micro-slip, as Maw, Barber and Fawcett computed it.

/// Tangential restitution of an elastic sphere on a rigid wall by the reduction of the contact to independent springs, exact
/// for uncoupled Hertz and Cattaneo-Mindlin contacts (Popov and Hess 2015): what Maw, Barber and Fawcett (1976) computed.
/// Unit radius, density and modulus.
pub fn tangential_restitution(nu: f64, mu: f64, normal: f64, along: f64) -> f64 {
    const SPRINGS: usize = 200;
    let mass = 4.0 / 3.0 * std::f64::consts::PI;
    let stiff = 1.0 / (1.0 - nu * nu);
    let shear = 4.0 / (2.0 * (1.0 + nu) * (2.0 - nu));
    let deepest = (15.0 * mass * normal * normal / (16.0 * stiff)).powf(0.4);
    let width = 1.02 * deepest.sqrt() / SPRINGS as f64;
    let dt = 2.94 * deepest / normal / 4000.0;
    let mut tangential = [0.0f64; SPRINGS];
    let (mut approach, mut speed, mut slip) = (0.0, normal, along);
    loop {
        let (mut press, mut drag) = (0.0, 0.0);
        for (k, t) in tangential.iter_mut().enumerate() {
            let x = (k as f64 + 0.5) * width;
            let force = (stiff * width * (approach - x * x)).max(0.0);
            *t = (*t + shear * width * slip * dt).clamp(-mu * force, mu * force);
            press += 2.0 * force;
            drag += 2.0 * *t;
        }
        speed -= press / mass * dt;
        slip -= 3.5 * drag / mass * dt;
        approach += speed * dt;
        if approach <= 0.0 {
            return -slip / along;
        }
    }
}

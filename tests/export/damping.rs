//! The restitution asked for in the exported contact: in C, LIGGGHTS and LAMMPS, at the steps a contact that a bed takes for it.

use crate::codes::exported::Exported;
use crate::codes::{succeed, write};
use impactlaw::dem::force::damping::steps_for;
use impactlaw::export::c::contact::headers;
use impactlaw::export::scene::Code;
use impactlaw::export::source::portable::Portable;
use impactlaw::law::Form;
use std::f64::consts::PI;
use std::path::Path;
use std::process::Command;

const ASKED: [f64; 6] = [0.05, 0.1, 0.3, 0.6, 0.9, 0.99];
const SPEEDS: [f64; 2] = [0.01, 10.0];
const RADIUS: f64 = 250e-6;
/// Yield strength over that of solder: within ten per cent of a radius Hertz's law is not left.
const HARDER: f64 = 100.0;

/// The law of solder balls in one form, but elastic: what an impact dissipates is the damping's alone.
fn elastic(form: Form) -> Portable {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
    let text = std::fs::read_to_string(file).unwrap();
    // the flattening at yield grows with the square of the strength, its force with the third power
    let scaled = text.lines().map(|line| {
        let power = match line.split(" = ").next() {
            Some("yield_strength_Pa") => 1,
            Some("displacement_over_radius") => 2,
            Some("force_over_radius2_Pa") => 3,
            _ => return format!("{line}\n"),
        };
        let (key, value) = line.split_once(" = ").unwrap();
        let value: f64 = value.parse().unwrap();
        format!("{key} = {:e}\n", value * HARDER.powi(power))
    });
    let scaled: String = scaled.collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("elastic.toml");
    std::fs::write(&path, scaled).unwrap();
    Portable::read(&path, Some(form)).unwrap()
}

/// A grain thrown at a wall.
struct Throw {
    asked: f64,
    speed: f64,
    /// Time step, s.
    dt: f64,
    /// Steps of the impact, of the flight to the wall and of the flight away.
    steps: u32,
}

impl Throw {
    fn of(law: &Portable, asked: f64, speed: f64) -> Self {
        let material = law.material();
        let mass = 4.0 / 3.0 * PI * RADIUS.powi(3) * material.density;
        let modulus = material.contact_modulus();
        let time = 2.868 * (mass * mass / (RADIUS * modulus * modulus * speed)).powf(0.2);
        let steps = steps_for(asked, 1.5);
        Throw {
            asked,
            speed,
            dt: time / steps,
            steps: (4.0 * steps) as u32,
        }
    }
}

/// Throws grains at every speed for every restitution from `least` on; `had` gives the speeds they come back with.
fn assert_had(what: &str, law: &Portable, least: f64, had: impl Fn(&[Throw]) -> Vec<f64>) {
    let asked = ASKED.map(|asked| asked.max(least));
    let throws: Vec<Throw> = SPEEDS
        .iter()
        .flat_map(|&speed| asked.map(|asked| Throw::of(law, asked, speed)))
        .collect();
    let had = had(&throws);
    assert_eq!(had.len(), throws.len());
    for (Throw { asked, speed, .. }, back) in throws.iter().zip(had) {
        let had = back / speed;
        println!(
            "{what} {:?} at {speed} m/s: asked {asked}, had {had:.5}",
            law.form
        );
        assert!((had / asked - 1.0).abs() < 0.01, "{what}: {asked}: {had}");
    }
}

const MAIN: &str = r#"
#include <stdio.h>
#include <stdlib.h>
#include "@FILE@_contact.h"
int main(int count, char **words)
{
    const double asked = atof(words[1]), radius = atof(words[3]), mass = atof(words[4]), dt = atof(words[5]);
    const law_effects effects = {0.0, 0.0, law_damping_ratio(asked)};
    const long steps = atol(words[6]);
    double rate = atof(words[2]), overlap = -0.37 * rate * dt;
    law_side side = {0};
    law_dashpot dashpot = {0};
    long k;
    (void)count;
    for (k = 0; k < steps; k++) {
        if (overlap > 0.0) {
            const law_pressed p = law_wall(overlap, radius, &side);
            rate -= law_damped(&effects, &p, rate, mass, dt, &dashpot) / mass * dt;
        }
        overlap += rate * dt;
    }
    printf("%.17g\n", -rate);
    return 0;
}
"#;

#[test]
fn the_restitution_asked_for_is_had_in_c_under_both_forms() {
    for form in [Form::ClosedForm, Form::Spline] {
        let law = elastic(form);
        let scratch = tempfile::tempdir().unwrap();
        let folder = write(&headers(&law, "c"), scratch.path());
        let main =
            impactlaw::export::c::kernel::named(MAIN, &law).replace("@FILE@", &law.identifier);
        std::fs::write(folder.join("main.c"), main).unwrap();
        let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
        let program = folder.join("thrown");
        let mut command = Command::new(compiler);
        command
            .current_dir(&folder)
            .args(["-O1", "-o"])
            .arg(&program);
        succeed(command.args(["main.c", "-lm"]));
        let mass = 4.0 / 3.0 * PI * RADIUS.powi(3) * law.material().density;
        let thrown = |throw: &Throw| {
            let words = [throw.asked, throw.speed, RADIUS, mass, throw.dt];
            let mut command = Command::new(&program);
            command.args(words.map(|word| format!("{word:e}")));
            command.arg(throw.steps.to_string());
            succeed(&mut command).trim().parse().unwrap()
        };
        assert_had("C", &law, 0.0, |throws| throws.iter().map(thrown).collect());
    }
}

/// Throws grains in a code, where it is installed: one after the other, in one run of it.
fn assert_had_in(code: Code, name: &str, least: f64) {
    for form in [Form::ClosedForm, Form::Spline] {
        let Some(exported) = Exported::of(elastic(form), code) else {
            return;
        };
        let law = &exported.law;
        let constants = [
            ("R", RADIUS.to_string()),
            ("RHO", law.material().density.to_string()),
        ];
        assert_had(name, law, least, |throws| {
            let each = |of: &dyn Fn(&Throw) -> f64| {
                let values = throws.iter().map(|throw| format!("{:e}", of(throw)));
                values.collect::<Vec<_>>()
            };
            let steps = throws.iter().map(|throw| throw.steps.to_string()).collect();
            let mut variables = vec![
                ("E", each(&|throw| throw.asked)),
                ("V", each(&|throw| throw.speed)),
                ("DT", each(&|throw| throw.dt)),
                ("STEPS", steps),
                ("GAP", each(&|throw| 0.37 * throw.speed * throw.dt)),
            ];
            variables.extend(
                constants
                    .iter()
                    .map(|(key, value)| (*key, vec![value.clone()])),
            );
            let rows = exported.run_each("thrown", &variables, 3);
            let ends = |pair: &[Vec<f64>]| pair[1][0] < pair[0][0];
            let last = rows
                .windows(2)
                .filter(|pair| ends(pair))
                .map(|pair| &pair[0]);
            let back = last.chain(rows.last()).map(|row| {
                assert_eq!(row[1], 0.0, "it has parted: {row:?}");
                row[2]
            });
            back.collect()
        });
    }
}

#[test]
fn the_restitution_asked_for_is_had_in_liggghts_under_both_forms() {
    // it takes no restitution of 0.05 and below
    assert_had_in(Code::Liggghts, "LIGGGHTS", 0.0501);
}

#[test]
fn the_restitution_asked_for_is_had_in_lammps_under_both_forms() {
    assert_had_in(Code::Lammps, "LAMMPS", 0.0);
}

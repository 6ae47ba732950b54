//! Input lines: fitted models in the words of each code, and which of them are proved by running them.

use super::fit::Target;
use crate::export::native::Model;
use crate::export::source::artifact::Artifact;
use crate::export::source::portable::Portable;
use crate::material::Material;

/// Young's modulus of a wall over that of the grains where a code knows no rigid wall.
const RIGID: f64 = 1e7;
/// Steps of an impact from touch to loss of contact in the runnable inputs.
const STEPS: f64 = 20_000.0;

/// Code that ships a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Code {
    /// LIGGGHTS 3.8.
    Liggghts,
    /// LAMMPS with the package GRANULAR.
    Lammps,
    /// YADE.
    Yade,
    /// MercuryDPM.
    MercuryDpm,
    /// EDEM.
    Edem,
    /// Rocky.
    Rocky,
}

/// A model in the words of a code.
#[derive(Debug, Clone, PartialEq)]
pub struct Lines {
    /// The code.
    pub code: Code,
    /// The model's name in the code.
    pub style: &'static str,
    /// The lines.
    pub text: String,
    /// File name of a runnable impact with these lines; none where the code cannot be had freely.
    pub input: Option<&'static str>,
}

impl Code {
    /// Name and version.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Code::Liggghts => "LIGGGHTS 3.8",
            Code::Lammps => "LAMMPS 22Jul2025",
            Code::Yade => "YADE 2023.02",
            Code::MercuryDpm => "MercuryDPM",
            Code::Edem => "EDEM",
            Code::Rocky => "Rocky",
        }
    }
}

/// The runnable impact of some lines, if there is one.
#[must_use]
pub fn input(lines: &Lines, law: &Portable, target: &Target) -> Option<Artifact> {
    let name = lines.input?;
    let template = match lines.code {
        Code::Lammps => include_str!("inputs/lammps.in"),
        Code::Yade => include_str!("inputs/yade.py"),
        _ => include_str!("inputs/liggghts.in"),
    };
    let (velocity, hit) = target.impacts.last()?;
    let words = [
        ("@FILE@", name.to_owned()),
        ("@RADIUS@", format!("{:e}", law.radius())),
        ("@DENSITY@", format!("{:e}", law.material().density)),
        ("@SPEED@", format!("{velocity:e}")),
        ("@DT@", format!("{:.3e}", hit.contact_time / STEPS)),
        ("@STEPS@", format!("{:.0}", 1.5 * STEPS)),
        ("@SUGGESTED@", format!("{:.3e}", law.time_step())),
        ("@LINES@", lines.text.trim_end().to_owned()),
    ];
    let text = words
        .iter()
        .fold(template.to_owned(), |text, (word, value)| {
            text.replace(word, value)
        });
    Some(Artifact {
        name: name.to_owned(),
        text,
    })
}

/// The lines of a model in every code that ships it.
#[must_use]
pub fn of(model: &Model, law: &Portable) -> Vec<Lines> {
    let (radius, material) = (law.radius(), law.material());
    match *model {
        Model::Luding {
            loading,
            limit,
            depth,
        } => {
            let springs = Springs {
                pair: 0.5 * loading * radius,
                ratio: limit / loading,
                depth,
            };
            vec![
                springs.luding(),
                springs.hooke_hysteresis(&material, radius),
                springs.yade(&material),
                springs.mercury(&material),
            ]
        }
        Model::WaltonBraun { loading, unloading } => walton_braun(loading, unloading),
        Model::Eepa(m) => eepa(m.loading, m.ratio, m.exponent, radius),
        Model::ThorntonNing(m) => vec![thornton_ning(m.modulus, m.yield_ratio, &material)],
        Model::Mdr {
            young_modulus,
            poisson_ratio,
            yield_strength,
        } => vec![mdr(young_modulus, poisson_ratio, yield_strength)],
    }
}

/// Springs of two equal spheres; on a wall a sphere is twice as stiff and its depth a quarter.
struct Springs {
    /// $k_1$, N/m.
    pair: f64,
    /// $\hat k_2/k_1$.
    ratio: f64,
    /// $\phi_f$.
    depth: f64,
}

/// Lines of LIGGGHTS: properties, then the model for pairs and for a wall at `x = ${xw}` of type 2.
fn liggghts(style: &'static str, input: &'static str, properties: &str, settings: &str) -> Lines {
    Lines {
        code: Code::Liggghts,
        style,
        text: format!(
            "{properties}\
             pair_style gran model {style}{settings}\n\
             pair_coeff * *\n\
             fix wall all wall/gran model {style} primitive type 2 xplane ${{xw}}{settings}\n"
        ),
        input: Some(input),
    }
}

/// A property of pairs of types 1 (grains) and 2 (wall).
fn per_pair(name: &str, pair: f64, wall: f64) -> String {
    format!(
        "fix {name} all property/global {name} peratomtypepair 2 {pair:.9e} {wall:.9e} {wall:.9e} {wall:.9e}\n"
    )
}

/// A property of types 1 and 2.
fn per_type(name: &str, grain: f64, wall: f64) -> String {
    format!("fix {name} all property/global {name} peratomtype {grain:.9e} {wall:.9e}\n")
}

impl Springs {
    fn luding(&self) -> Lines {
        let properties = [
            per_pair("coefficientRestitution", 1.0, 1.0),
            per_pair("LoadingStiffness", self.pair, 2.0 * self.pair),
            per_pair("UnloadingStiffness", self.ratio, self.ratio),
            per_pair("coefficientAdhesionStiffness", 0.0, 0.0),
            per_pair("coefficientPlasticityDepth", self.depth, 0.25 * self.depth),
            per_pair("pullOffForce", 0.0, 0.0),
        ];
        liggghts("luding", "liggghts_luding.in", &properties.concat(), "")
    }

    /// The model takes $k_1 = \tfrac{16}{15} \sqrt{R^\ast} E^\ast (15 m^\ast V^2/(16 \sqrt{R^\ast} E^\ast))^{1/5}$: the characteristic
    /// velocity that gives ours, and a wall whose modulus makes it twice as stiff.
    fn hooke_hysteresis(&self, material: &Material, radius: f64) -> Lines {
        let modulus = 0.5 * material.contact_modulus();
        let mass = 0.5 * material.sphere_mass(radius);
        let root = (0.5 * radius).sqrt();
        let share = self.pair / (16.0 / 15.0 * root * modulus);
        let velocity = (share.powi(5) * 16.0 * root * modulus / (15.0 * mass)).sqrt();
        let young = material.young_modulus;
        let nu = material.poisson_ratio;
        let properties = [
            per_type("youngsModulus", young, young / (2f64.sqrt() - 1.0)),
            per_type("poissonsRatio", nu, nu),
            format!(
                "fix characteristicVelocity all property/global characteristicVelocity scalar {velocity:.9e}\n"
            ),
            per_pair("coefficientRestitution", 1.0, 1.0),
            per_pair("coefficientMaxElasticStiffness", self.ratio, self.ratio),
            per_pair("coefficientAdhesionStiffness", 0.0, 0.0),
            per_pair("coefficientPlasticityDepth", self.depth, 0.25 * self.depth),
        ];
        liggghts(
            "hooke/hysteresis",
            "liggghts_hooke_hysteresis.in",
            &properties.concat(),
            "",
        )
    }

    fn yade(&self, material: &Material) -> Lines {
        Lines {
            code: Code::Yade,
            style: "Law2_ScGeom_LudingPhys_Basic",
            text: format!(
                "grain = LudingMat(k1={:.9e}, kp={:.9e}, kc=0, ks=0, G0=0, PhiF={:.9e}, frictionAngle=0, density={:e})\n",
                self.pair,
                self.pair * self.ratio,
                self.depth,
                material.density
            ),
            input: Some("yade_luding.py"),
        }
    }

    fn mercury(&self, material: &Material) -> Lines {
        let (k1, k2) = (self.pair, self.pair * self.ratio);
        let wall_depth = 0.25 * self.depth;
        Lines {
            code: Code::MercuryDpm,
            style: "LinearPlasticViscoelasticSpecies",
            text: format!(
                "// grains: loading stiffness, largest unloading stiffness, cohesion stiffness, largest penetration depth\n\
                 auto grain = speciesHandler.copyAndAddObject(LinearPlasticViscoelasticSpecies());\n\
                 grain->setDensity({:e});\n\
                 grain->setPlasticParameters({k1:.9e}, {k2:.9e}, 0.0, {:.9e});\n\
                 auto wall = speciesHandler.copyAndAddObject(grain);\n\
                 speciesHandler.getMixedObject(grain, wall)->setPlasticParameters({:.9e}, {:.9e}, 0.0, {wall_depth:.9e});\n",
                material.density,
                self.depth,
                2.0 * k1,
                2.0 * k2,
            ),
            input: None,
        }
    }
}

fn walton_braun(loading: f64, unloading: f64) -> Vec<Lines> {
    let e = (loading / unloading).sqrt();
    vec![
        Lines {
            code: Code::Edem,
            style: "Hysteretic Spring",
            text: format!(
                "yield strength (each material): {:.6e} Pa   (the model takes k1 = 5 R* Y)\n\
                 coefficient of restitution: {e:.6}\n\
                 damping factor: 0\n",
                loading / 5.0
            ),
            input: None,
        },
        Lines {
            code: Code::Rocky,
            style: "hysteretic linear spring",
            text: format!(
                "Young's modulus (grains): {:.6e} Pa   (the model takes K = E times the particle size)\n\
                 Young's modulus (boundary): {:.6e} Pa, rigid\n\
                 restitution coefficient: {e:.6}\n",
                0.5 * loading,
                0.5 * loading * RIGID
            ),
            input: None,
        },
    ]
}

fn eepa(loading: f64, ratio: f64, exponent: f64, radius: f64) -> Vec<Lines> {
    let wall = loading * radius.powf(2.0 - exponent);
    let pair = wall * 0.5f64.powf(exponent);
    let properties = [
        per_pair("coefficientRestitution", 1.0, 1.0),
        per_pair("LoadingStiffness", pair, wall),
        per_pair("UnloadingStiffness", ratio, ratio),
        per_pair("coefficientAdhesionStiffness", 0.0, 0.0),
        per_pair("pullOffForce", 0.0, 0.0),
        per_pair("surfaceEnergy", 0.0, 0.0),
        format!("fix overlapExponent all property/global overlapExponent scalar {exponent:.9e}\n"),
        "fix adhesionExponent all property/global adhesionExponent scalar 1\n".to_owned(),
    ];
    let edinburgh = liggghts(
        "edinburgh/stiffness",
        "liggghts_edinburgh.in",
        &properties.concat(),
        " fixKc on",
    );
    vec![
        edinburgh,
        Lines {
            code: Code::Edem,
            style: "EEPA",
            text: format!(
                "slope exponent: {exponent:.6}\n\
                 contact plasticity ratio (1 - k1/k2): {:.6}\n\
                 constant pull-off force, surface energy: 0\n\
                 k1 of two equal spheres of R = {radius:e} m: {pair:.6e} N/m^n\n",
                1.0 - 1.0 / ratio
            ),
            input: None,
        },
    ]
}

fn thornton_ning(modulus: f64, yield_ratio: f64, material: &Material) -> Lines {
    let nu = material.poisson_ratio;
    let young = modulus * (1.0 - nu * nu);
    let properties = [
        per_type("youngsModulus", young, young * RIGID),
        per_type("poissonsRatio", nu, nu),
        per_pair("coefficientRestitution", 1.0, 1.0),
        per_pair("surfaceEnergy", 0.0, 0.0),
        per_type("coefficientYieldRatio", yield_ratio, yield_ratio),
    ];
    liggghts(
        "thornton_ning",
        "liggghts_thornton_ning.in",
        &properties.concat(),
        "",
    )
}

/// No adhesion, bulk response below half the free surface, no damping; friction is left to the user.
fn mdr(young: f64, nu: f64, yield_strength: f64) -> Lines {
    let model = format!(
        "mdr {young:.9e} {nu} {yield_strength:.9e} 0 0.5 0 tangential linear_nohistory 0.0 0.0 damping mdr 1"
    );
    Lines {
        code: Code::Lammps,
        style: "granular mdr",
        text: format!(
            "pair_style granular\n\
             pair_coeff * * {model}\n\
             fix wall all wall/gran granular {model} xplane ${{xw}} NULL\n"
        ),
        input: Some("lammps_mdr.in"),
    }
}

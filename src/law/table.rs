//! Tables of a law file: the parts that say how good and how general a law is.

use crate::document::keys::{key, keys, table};
use crate::fit::quality::{LeftOut, Quality};
use serde::{Deserialize, Serialize};

/// `[yield_point]`: the units of the constants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct YieldTable {
    /// Peak Hertz pressure over Y.
    pub pressure_ratio: f64,
    /// delta_y/R.
    pub displacement_over_radius: f64,
    /// F_y/R^2.
    #[serde(rename = "force_over_radius2_Pa")]
    pub force_over_radius2_pa: f64,
}

keys! {
    YieldTable {
        pressure_ratio: key("peak Hertz pressure at first yield over Y", "> 0", "1.6"),
        displacement_over_radius: key("δ_y/R", "that of the material", "1.33e-5"),
        force_over_radius2_pa as "force_over_radius2_Pa": key("F_y/R², Pa", "that of the material", "4365.5"),
    }
}

/// `[valid]`: what the impacts covered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValidTable {
    /// Largest delta/R.
    pub displacement_over_radius_max: f64,
    /// Slowest impact.
    pub velocity_min_m_s: f64,
    /// Fastest impact.
    pub velocity_max_m_s: f64,
}

keys! {
    ValidTable {
        displacement_over_radius_max: key("largest δ/R of the impacts", "> 0", "0.124"),
        velocity_min_m_s: key("slowest impact, m/s", "> 0", "5.0"),
        velocity_max_m_s: key("fastest impact, m/s", "≥ the slowest", "30.0"),
    }
}

/// `[thresholds]`: relative errors from which on the law counts as missed, and a left-out speed as a warning.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThresholdTable {
    /// Accuracy of the impacts, the case's.
    pub tolerance: f64,
    /// Largest error of F*, delta* and e at any speed; beyond it `fit` and `run` end with exit code 1.
    pub error: f64,
    /// The same at a speed left out of the fit; beyond it there is a warning.
    pub left_out: f64,
}

keys! {
    ThresholdTable {
        tolerance: key("accuracy of the impacts: the case's", "", "0.02"),
        error: key("largest error of F*, δ* and e at any speed; beyond it `fit` and `run` end with exit code 1", "", "0.03"),
        left_out: key("the same at a speed left out of the fit; beyond it there is a warning", "", "0.1"),
    }
}

/// `[provenance]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProvenanceTable {
    /// Program and version.
    pub program: String,
    /// Name of the case.
    pub case: String,
    /// SHA-256 of the case file.
    pub case_sha256: String,
    /// Radius of the sphere that was simulated; of a pair the effective one.
    pub radius_m: f64,
    /// Impacts that were not used.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skipped_velocities_m_s: Vec<f64>,
}

keys! {
    ProvenanceTable {
        program: key("program and version", "", "'impactlaw 0.1.0'"),
        case: key("name of the case", "", "'solder-ball'"),
        case_sha256: key("SHA-256 of the case file", "", "'99a5...'"),
        radius_m: key("radius that was simulated, m; of a pair the effective one, 1/(1/R₁ + 1/R₂)", "> 0", "0.00025"),
        skipped_velocities_m_s: key("impacts that were not used, m/s", "", "[50.0]").or("none"),
    }
}

/// `[*.unloading]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnloadingTable {
    /// c.
    pub residual_scale: f64,
    /// k.
    pub residual_power: f64,
    /// n_1.
    pub exponent_residual: f64,
    /// n_2.
    pub exponent_strain: f64,
}

keys! {
    UnloadingTable {
        residual_scale: key("c: flattening past w₁ on which the residual grows", "> 0", "32.46"),
        residual_power: key("k: how fast the recovered part falls", "> 0", "0.69"),
        exponent_residual: key("n₁: change of the exponent with the residual", "≥ -0.5", "-0.40"),
        exponent_strain: key("n₂: growth of the exponent with δ/R", "≥ 0", "11.8"),
    }
}

/// `[*.unloading_intervals]`: 95 % intervals of the unloading constants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnloadingIntervals {
    /// Of c.
    pub residual_scale: [f64; 2],
    /// Of k.
    pub residual_power: [f64; 2],
    /// Of n_1.
    pub exponent_residual: [f64; 2],
    /// Of n_2.
    pub exponent_strain: [f64; 2],
}

keys! {
    UnloadingIntervals {
        residual_scale: key("95 % interval of c", "", "[7.1, 22.4]"),
        residual_power: key("95 % interval of k", "", "[7.1, 22.4]"),
        exponent_residual: key("95 % interval of n₁", "", "[7.1, 22.4]"),
        exponent_strain: key("95 % interval of n₂", "", "[7.1, 22.4]"),
    }
}

/// `[closed_form]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClosedFormTable {
    /// w_1.
    pub departure: f64,
    /// b.
    pub breadth: f64,
    /// q.
    pub softening: f64,
    /// kappa; absent where the impacts do not show inertia.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<f64>,
    /// Unloading.
    pub unloading: UnloadingTable,
    /// 95 % intervals; absent for fewer than five speeds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intervals: Option<ClosedFormIntervals>,
    /// Errors, one row a speed.
    pub quality: Vec<QualityRow>,
    /// Errors at speeds left out of the fit; empty for a single speed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<LeftOutRow>,
}

keys! {
    ClosedFormTable {
        departure: key("w₁: flattening at which loading leaves Hertz's, in δ_y", "> 0", "0.19"),
        breadth: key("b: breadth of the transition", "> 0", "20.3"),
        softening: key("q: how far the exponent falls", "[0, 4/3)", "1.28"),
        inertia: key("κ of the inertia term of first loading", "≥ 0", "10.2").or("none: not seen"),
        unloading: table("unloading branches"),
        intervals: table("95 % intervals, by bootstrap over the impacts").or("none: fewer than five speeds"),
        quality: table("relative errors, one table a speed"),
        left_out: table("errors at speeds left out of the fit").or("none: one speed"),
    }
}

/// `[closed_form.intervals]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClosedFormIntervals {
    /// Of w_1.
    pub departure: [f64; 2],
    /// Of b.
    pub breadth: [f64; 2],
    /// Of q.
    pub softening: [f64; 2],
    /// Of kappa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<[f64; 2]>,
    /// Of the unloading.
    pub unloading: UnloadingIntervals,
}

keys! {
    ClosedFormIntervals {
        departure: key("95 % interval of w₁", "", "[0.19, 0.33]"),
        breadth: key("95 % interval of b", "", "[0.19, 0.33]"),
        softening: key("95 % interval of q", "", "[0.19, 0.33]"),
        inertia: key("95 % interval of κ", "", "[9.1, 11.3]").or("none"),
        unloading: table("of the unloading constants"),
    }
}

/// `[spline]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplineTable {
    /// w_1.
    pub hertz_to: f64,
    /// `[w, f, df/dw]` of each knot past it.
    pub knots: Vec<[f64; 3]>,
    /// kappa; absent where the impacts do not show inertia.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<f64>,
    /// Unloading.
    pub unloading: UnloadingTable,
    /// 95 % intervals; absent for fewer than five speeds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intervals: Option<SplineIntervals>,
    /// Errors, one row a speed.
    pub quality: Vec<QualityRow>,
    /// Errors at speeds left out of the fit; empty for a single speed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<LeftOutRow>,
}

keys! {
    SplineTable {
        hertz_to: key("w₁: flattening at which loading leaves Hertz's, in δ_y", "> 0", "0.2"),
        knots: key("`[w, f, df/dw]` past it", "rising", "[[10.0, 25.0, 3.1]]"),
        inertia: key("κ of the inertia term of first loading", "≥ 0", "10.2").or("none: not seen"),
        unloading: table("unloading branches"),
        intervals: table("95 % intervals, by bootstrap over the impacts").or("none: fewer than five speeds"),
        quality: table("relative errors, one table a speed"),
        left_out: table("errors at speeds left out of the fit").or("none: one speed"),
    }
}

/// `[spline.intervals]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplineIntervals {
    /// Of f at each knot.
    pub knot_force: Vec<[f64; 2]>,
    /// Of kappa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<[f64; 2]>,
    /// Of the unloading.
    pub unloading: UnloadingIntervals,
}

keys! {
    SplineIntervals {
        knot_force: key("95 % interval of f at each knot", "", "[[24.0, 26.0]]"),
        inertia: key("95 % interval of κ", "", "[7.5, 8.6]").or("none"),
        unloading: table("of the unloading constants"),
    }
}

/// `[hertz]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HertzTable {
    /// Why the law is Hertz's.
    pub reason: String,
    /// Errors, one row a speed.
    pub quality: Vec<QualityRow>,
}

keys! {
    HertzTable {
        reason: key("why the law is Hertz's", "", "'nothing yielded'"),
        quality: table("relative errors, one table a speed"),
    }
}

/// Relative errors at one speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QualityRow {
    /// V.
    pub velocity_m_s: f64,
    /// F*.
    pub max_force: f64,
    /// delta*.
    pub max_displacement: f64,
    /// e.
    pub restitution: f64,
    /// delta_res over delta*.
    pub residual_displacement: f64,
    /// Contact time.
    pub contact_time: f64,
    /// Root mean square force in loading over F*.
    pub loading_force_rms: f64,
    /// Root mean square force in unloading over F*.
    pub unloading_force_rms: f64,
}

keys! {
    QualityRow {
        velocity_m_s: key("speed, m/s", "", "5.0"),
        max_force: key("error of F*", "", "0.004"),
        max_displacement: key("error of δ*", "", "-0.002"),
        restitution: key("error of e", "", "0.01"),
        residual_displacement: key("error of δ_res over δ*", "", "0.003"),
        contact_time: key("error of the contact time", "", "0.002"),
        loading_force_rms: key("root mean square force error in loading over F*", "", "0.01"),
        unloading_force_rms: key("the same in unloading", "", "0.01"),
    }
}

impl From<&Quality> for QualityRow {
    fn from(q: &Quality) -> Self {
        QualityRow {
            velocity_m_s: q.velocity,
            max_force: q.max_force,
            max_displacement: q.max_displacement,
            restitution: q.restitution,
            residual_displacement: q.residual_displacement,
            contact_time: q.contact_time,
            loading_force_rms: q.loading_force,
            unloading_force_rms: q.unloading_force,
        }
    }
}

/// Relative errors at a speed the fit did not see.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeftOutRow {
    /// V.
    pub velocity_m_s: f64,
    /// F*.
    pub max_force: f64,
    /// delta*.
    pub max_displacement: f64,
    /// e.
    pub restitution: f64,
}

keys! {
    LeftOutRow {
        velocity_m_s: key("speed, m/s", "", "5.0"),
        max_force: key("error of F*", "", "0.004"),
        max_displacement: key("error of δ*", "", "-0.002"),
        restitution: key("error of e", "", "0.01"),
    }
}

impl From<&LeftOut> for LeftOutRow {
    fn from(l: &LeftOut) -> Self {
        LeftOutRow {
            velocity_m_s: l.velocity,
            max_force: l.max_force,
            max_displacement: l.max_displacement,
            restitution: l.restitution,
        }
    }
}

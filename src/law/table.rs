//! Tables of a law file: the parts that say how good and how general a law is.

use crate::fit::confidence::LeftOut;
use crate::fit::quality::Quality;
use crate::material::flow::{FlowConstants, InSi, WithFlow};
use serde::{Deserialize, Serialize};

/// `[material]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "WithFlow<ElasticTable, InSi>")]
pub struct MaterialTable {
    /// rho.
    pub density_kg_m3: f64,
    /// E.
    #[serde(rename = "young_modulus_Pa")]
    pub young_modulus_pa: f64,
    /// nu.
    pub poisson_ratio: f64,
    /// Constants of the flow stress; none for an elastic body.
    #[serde(flatten)]
    pub flow: FlowConstants<InSi>,
}

/// The keys of `[material]` besides the constants of the flow stress.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ElasticTable {
    density_kg_m3: f64,
    #[serde(rename = "young_modulus_Pa")]
    young_modulus_pa: f64,
    poisson_ratio: f64,
}

impl From<WithFlow<ElasticTable, InSi>> for MaterialTable {
    fn from(table: WithFlow<ElasticTable, InSi>) -> Self {
        let WithFlow { others, flow } = table;
        MaterialTable {
            density_kg_m3: others.density_kg_m3,
            young_modulus_pa: others.young_modulus_pa,
            poisson_ratio: others.poisson_ratio,
            flow,
        }
    }
}

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
    /// Radius of the sphere that was simulated.
    pub radius_m: f64,
    /// Impacts that were not used.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skipped_velocities_m_s: Vec<f64>,
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

/// `[hertz]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HertzTable {
    /// Why the law is Hertz's.
    pub reason: String,
    /// Errors, one row a speed.
    pub quality: Vec<QualityRow>,
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

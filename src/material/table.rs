//! Table of a material in files of results: its constants as plain numbers in SI.

use super::Material;
use super::flow::{FlowConstants, InSi, WithFlow};
use crate::Result;
use crate::document::Document;
use crate::document::keys::{self, key, keys};
use serde::{Deserialize, Serialize};

/// Constants of a material as law files and `summary.json` hold them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "WithFlow<ElasticTable, InSi>")]
pub struct MaterialTable {
    /// rho, kg/m3.
    pub density_kg_m3: f64,
    /// E, Pa.
    #[serde(rename = "young_modulus_Pa")]
    pub young_modulus_pa: f64,
    /// nu.
    pub poisson_ratio: f64,
    /// Constants of the flow stress; none for an elastic body.
    #[serde(flatten)]
    pub flow: FlowConstants<InSi>,
}

/// The keys besides the constants of the flow stress.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ElasticTable {
    density_kg_m3: f64,
    #[serde(rename = "young_modulus_Pa")]
    young_modulus_pa: f64,
    poisson_ratio: f64,
}

keys! {
    ElasticTable {
        density_kg_m3: key("density, kg/m³", "> 0", "7274.0"),
        young_modulus_pa as "young_modulus_Pa": key("Young's modulus, Pa", "> 0", "5.982e10"),
        poisson_ratio: key("Poisson's ratio", "[0, 0.5)", "0.33"),
    }
}

impl keys::Value for MaterialTable {
    fn kind() -> keys::Kind {
        WithFlow::<ElasticTable, InSi>::kind()
    }
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

impl From<&Material> for MaterialTable {
    fn from(material: &Material) -> Self {
        let Material {
            density,
            young_modulus,
            poisson_ratio,
            flow,
        } = material;
        MaterialTable {
            density_kg_m3: *density,
            young_modulus_pa: *young_modulus,
            poisson_ratio: *poisson_ratio,
            flow: FlowConstants::of(flow.as_ref()),
        }
    }
}

impl MaterialTable {
    /// That every constant is in its range; `at` is the dotted key of the table.
    ///
    /// # Errors
    /// [`crate::Error::Value`] for one that is not, or constants that belong to no one kind of flow stress.
    pub fn check(&self, document: &Document, at: &str) -> Result<()> {
        for (key, value) in [
            ("density_kg_m3", self.density_kg_m3),
            ("young_modulus_Pa", self.young_modulus_pa),
            ("poisson_ratio", self.poisson_ratio),
        ] {
            document.within(&format!("{at}.{key}"), value)?;
        }
        self.flow.check(document, at, self.young_modulus_pa)?;
        Ok(())
    }

    /// The material of a table that was checked.
    #[must_use]
    pub fn material(&self) -> Material {
        Material {
            density: self.density_kg_m3,
            young_modulus: self.young_modulus_pa,
            poisson_ratio: self.poisson_ratio,
            flow: self.flow.checked(),
        }
    }
}

//! Losses: the energy that each effect of a contact has dissipated.

use super::list::effects;
use crate::tape::keep_fields;
use serde::Serialize;

macro_rules! declare {
    ($($(#[$what:meta])* $effect:ident: $kind:ident { key: $key:ident, column: $column:literal },)+) => {
        /// Energy dissipated by each effect, J.
        #[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
        pub struct Losses {
            $($(#[$what])* #[serde(rename = $column)] pub $effect: f64,)+
        }
        keep_fields!(Losses: $($effect),+);

        impl Losses {
            /// Sum of all.
            #[must_use]
            pub fn total(&self) -> f64 {
                [$(self.$effect),+].into_iter().sum()
            }
        }

        impl std::ops::AddAssign for Losses {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                $(self.$effect += other.$effect;)+
            }
        }
    };
}
effects!(declare);

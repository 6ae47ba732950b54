//! Named effects: the constants that a scene names, and the effects they call for.

use super::by_material::Table;
use super::damping::Viscous;
use super::effects::{Effect, EffectList, Law, Named};
use super::friction::Mindlin;
use super::list::effects;
use super::rolling::RollingSpring;
use crate::material::Material;

/// The list `((a, b), c)` of `a`, `b`, `c`.
macro_rules! list {
    ($list:expr $(,)?) => { $list };
    ($list:expr, $next:expr $(, $rest:expr)* $(,)?) => { list!(($list, $next) $(, $rest)*) };
}

/// The chain `(a, (b, ()))` of `a`, `b`.
macro_rules! chain {
    () => { () };
    ($next:expr $(, $rest:expr)* $(,)?) => { ($next, chain!($($rest),*)) };
}

macro_rules! declare {
    ($($(#[$what:meta])* $effect:ident: $kind:ident { key: $key:ident, column: $column:literal },)+) => {
        /// Checked constants of a contact; an effect that is not named does not act.
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct Constants {
            $($(#[$what])* pub $key: Option<f64>,)+
            /// Contact stiffness over that of the material, in (0, 1]: softer contacts allow longer time steps.
            pub stiffness: Option<f64>,
        }

        impl Constants {
            /// An effect that is named without the one it needs: both keys, and why.
            #[must_use]
            pub fn unmet(&self) -> Option<(&'static str, &'static str, &'static str)> {
                let named = |key: &str| match key {
                    $(stringify!($key) => self.$key.is_some(),)+
                    _ => false,
                };
                let needs = [$((stringify!($key), self.$key, <$kind as Named>::NEEDS),)+];
                needs.into_iter().find_map(|(key, constant, needs)| {
                    let (needed, why) = needs.filter(|(needed, _)| constant.is_some() && !named(needed))?;
                    Some((key, needed, why))
                })
            }
        }

        /// Effects beside the normal law.
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct Effects {
            $($(#[$what])* pub $effect: Option<$kind>,)+
        }

        impl Effects {
            /// Effects a scene names for grains of `material`.
            #[must_use]
            pub fn of(contact: &Constants, material: &Material) -> Self {
                Self { $($effect: contact.$key.map(|constant| <$kind as Named>::of(constant, material)),)+ }
            }

            /// The same for two bodies of these materials, rigid ones if none.
            #[must_use]
            pub fn between(contact: &Constants, materials: [Option<&Material>; 2]) -> Self {
                Self { $($effect: contact.$key.map(|constant| <$kind as Named>::between(constant, materials)),)+ }
            }

            /// Hands the effects that act to `pick`, as a list of their types.
            pub fn pick<P: Pick>(&self, pick: P) -> P::Output {
                chain!($(self.$effect),+).choose((), pick)
            }
        }

        impl Table<Effects> {
            /// Every effect by the materials of the contact.
            #[must_use]
            pub fn by_effect(&self) -> impl EffectList + use<> {
                list!((), $(self.map(|effects| effects.$effect)),+)
            }
        }
    };
}
effects!(declare);

impl Constants {
    /// Contact stiffness over that of the material.
    #[must_use]
    pub fn softening(&self) -> f64 {
        self.stiffness.unwrap_or(1.0)
    }
}

/// What is done with the effects that act, once their types are known: one `match` an effect, outside every loop.
pub trait Pick {
    /// What comes of it.
    type Output;

    /// With the effects in order.
    fn pick<L: EffectList>(self, effects: L) -> Self::Output;
}

/// Effects still to be chosen.
trait Chain {
    /// Adds those that act to `chosen` and hands all to `pick`.
    fn choose<L: EffectList, P: Pick>(self, chosen: L, pick: P) -> P::Output;
}

impl Chain for () {
    fn choose<L: EffectList, P: Pick>(self, chosen: L, pick: P) -> P::Output {
        pick.pick(chosen)
    }
}

impl<E: Effect, R: Chain> Chain for (Option<E>, R) {
    fn choose<L: EffectList, P: Pick>(self, chosen: L, pick: P) -> P::Output {
        match self.0 {
            Some(effect) => self.1.choose((chosen, effect), pick),
            None => self.1.choose(chosen, pick),
        }
    }
}

/// Law of the effects of each pair of materials.
#[must_use]
pub fn mixed(effects: &Table<Effects>) -> Law<impl EffectList + use<>> {
    Law::new(effects.by_effect())
}

//! List of effects: what can act in a contact beside its normal law, the one place where an effect is entered.
//!
//! An effect states itself in its own file ([`super::effects::Effect`], [`super::effects::Named`]). Its entry gives it a field of
//! [`super::named::Constants`], [`super::named::Effects`] and [`super::losses::Losses`], its keys in `[contact]` and `[[pair]]`, and
//! its column in `bed.csv`. Whoever has to answer for every effect takes `Constants` apart field by field.

/// Calls a macro with every effect, in the order in which they act: field, type, key in scenes, column of `bed.csv`.
macro_rules! effects {
    ($then:ident) => {
        $then! {
            /// Viscous damping.
            damping: Viscous { key: restitution, column: "damping_J" },
            /// Friction.
            friction: Mindlin { key: friction, column: "friction_J" },
            /// Rolling resistance; only with friction.
            rolling: RollingSpring { key: rolling, column: "rolling_J" },
        }
    };
}
pub(crate) use effects;

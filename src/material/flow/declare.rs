//! Declarations: the structure of one flow stress from its constants, and the enumeration of all from their list.

/// Declares the structure of a flow stress: name, name in running text, and a field for each of its constants.
macro_rules! flow_stress {
    (
        $(#[$doc:meta])* $name:ident, $title:literal {
            $($(#[$field_doc:meta])* $field:ident: $constant:expr),+ $(,)?
        }
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: f64,)+
        }

        impl $crate::material::flow::Constants for $name {
            const NAME: &'static str = $title;
            const CONSTANTS: &'static [$crate::material::constant::Constant] = &[$($constant),+];
            fn of(mut value: impl FnMut(&$crate::material::constant::Constant) -> f64) -> Self {
                $name { $($field: value(&$constant)),+ }
            }
            fn values(&self) -> Vec<f64> {
                let $name { $($field),+ } = *self;
                vec![$($field),+]
            }
        }
    };
}
pub(in crate::material) use flow_stress;

/// Makes the enumeration of the flow stresses of a list.
macro_rules! flow_stresses {
    ($($file:ident::$name:ident),+ $(,)?) => {
        $(pub use $file::$name;)+

        /// Flow stress of a material, constants in SI.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub enum Flow {
            $(#[doc = concat!("[`", stringify!($name), "`].")] $name($name),)+
        }

        $(impl From<$name> for Flow {
            fn from(flow: $name) -> Self {
                Flow::$name(flow)
            }
        })+

        impl Flow {
            /// Every kind.
            pub const KINDS: &'static [Kind] = &[$(Kind {
                name: <$name as Constants>::NAME,
                constants: <$name as Constants>::CONSTANTS,
                of: |values| {
                    let mut values = values.iter().copied();
                    Flow::$name(<$name as Constants>::of(|_| values.next().unwrap_or_default()))
                },
            }),+];

            /// Initial yield strength Y, Pa.
            #[must_use]
            pub const fn yield_strength(&self) -> f64 {
                match *self {
                    $(Flow::$name($name { strength, .. }) => strength,)+
                }
            }

            /// Name, constants and their values.
            fn parts(&self) -> (&'static str, &'static [Constant], Vec<f64>) {
                fn of<F: Constants>(flow: &F) -> (&'static str, &'static [Constant], Vec<f64>) {
                    (F::NAME, F::CONSTANTS, flow.values())
                }
                match self {
                    $(Flow::$name(flow) => of(flow),)+
                }
            }

            /// The same flow stress with its constants in reference units.
            #[must_use]
            pub fn in_reference(&self, units: &ReferenceUnits) -> Self {
                match self {
                    $(Flow::$name(flow) => Flow::$name(flow.in_reference(units)),)+
                }
            }

            /// What `visitor` makes of the flow stress: the one place where a kind becomes a type.
            pub fn visit<V: FlowVisitor>(self, visitor: V) -> V::Output {
                match self {
                    $(Flow::$name(flow) => visitor.visit(flow),)+
                }
            }
        }
    };
}
pub(super) use flow_stresses;

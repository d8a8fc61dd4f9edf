//! How parameters are written, in every module: structs with the start value beside each field, and enumerations with
//! the name that the interface has for each choice.

/// One literal of an enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Value at the FMI boundary.
    pub value: i32,
    /// Literal.
    pub name: &'static str,
    /// What it means.
    pub description: &'static str,
}

/// An enumeration type.
#[derive(Debug, PartialEq, Eq)]
pub struct EnumType {
    /// Name of the type.
    pub name: &'static str,
    /// Its literals.
    pub choices: &'static [Choice],
}

/// A parameter that is one of several choices.
pub trait Choices: Copy + 'static {
    /// The choices as the interface has them.
    const TYPE: &'static EnumType;
    /// The value of this one.
    fn value(self) -> i32;
    /// The one of value `value`.
    fn of(value: i32) -> Option<Self>;
}

/// Parameters with their start values.
macro_rules! spec {
    ($(#[$about:meta])* pub struct $name:ident { $($(#[$doc:meta])* pub $field:ident: $type:ty = $start:expr,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        pub struct $name { $($(#[$doc])* pub $field: $type,)+ }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $start,)+ }
            }
        }
    };
}

/// An enumeration, named `$type` in the interface, with its choices.
macro_rules! choices {
    ($(#[$about:meta])* pub enum $name:ident: $type:literal {
        $($variant:ident = $value:literal, $literal:literal: $meaning:literal;)+
    }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        #[repr(i32)]
        pub enum $name { $(#[doc = $meaning] $variant = $value,)+ }

        impl $name {
            /// Its name in the interface.
            pub const fn literal(self) -> &'static str {
                match self { $(Self::$variant => $literal,)+ }
            }
        }

        impl $crate::spec::Choices for $name {
            const TYPE: &'static $crate::spec::EnumType = &$crate::spec::EnumType {
                name: $type,
                choices: &[$($crate::spec::Choice { value: $value, name: $literal, description: $meaning }),+],
            };

            fn value(self) -> i32 {
                self as i32
            }

            fn of(value: i32) -> Option<Self> {
                match value {
                    $($value => Some(Self::$variant),)+
                    _ => None,
                }
            }
        }
    };
}

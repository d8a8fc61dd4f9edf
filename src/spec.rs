//! Macros that declare parameters: structs with a start value for each field, and enumerations with a name in the
//! interface for each choice.

/// One literal of an enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Value in the FMI interface.
    pub value: i32,
    /// Name of the literal.
    pub name: &'static str,
    /// Meaning of the literal.
    pub description: &'static str,
}

/// An enumeration type.
#[derive(Debug, PartialEq, Eq)]
pub struct EnumType {
    /// Name of the type.
    pub name: &'static str,
    /// Literals of the type.
    pub choices: &'static [Choice],
}

/// A parameter that is one of several choices.
pub trait Choices: Copy + 'static {
    /// Enumeration type in the interface.
    const TYPE: &'static EnumType;
    /// Returns the value of this choice.
    fn value(self) -> i32;
    /// Returns the choice with `value`, if it exists.
    fn of(value: i32) -> Option<Self>;
}

/// Defines a struct of parameters with their start values.
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

/// Defines an enumeration of choices, named `$type` in the interface.
macro_rules! choices {
    ($(#[$about:meta])* pub enum $name:ident: $type:literal {
        $($variant:ident = $value:literal, $literal:literal: $meaning:literal;)+
    }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        #[repr(i32)]
        pub enum $name { $(#[doc = $meaning] $variant = $value,)+ }

        impl $name {
            /// Returns the name in the interface.
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

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

/// Defines a group of parameters. One line declares a parameter:
///
/// ```text
/// /// Mean radius of the linings, for sliding speed
/// mean_radius: f64 = 0.12, METRE | MM, 1e-3..=1.0, TUNABLE, when(above!(WheelBrakeSpec.sliding.slip_slope, 0.0));
/// ```
///
/// The doc comment is the description in the interface, so it has no unit and no final period. Start value, SI unit with
/// display unit, range, variability and condition follow. Without a range, every number is valid. A pair `[f64; 2]` gives
/// the parameters `left_…` and `right_…`, and its description contains `{side}`. Behind the parameters, `..field: Type`
/// adds those of a nested group, which is declared `of` a trait of the groups that contain it.
#[macro_export]
macro_rules! parameters {
    ($(#[$about:meta])* pub struct $name:ident in $group:literal {
        $($(#[doc = $line:literal])+ $field:ident: $type:ty = $start:expr $(, $detail:expr)*;)*
        $(..$nested:ident: $nested_type:ty $(, $default:expr)*;)*
    }) => {
        $crate::parameters! { @define $(#[$about])* $name {
            $($(#[doc = $line])+ $field: $type = $start;)*
            $(#[allow(missing_docs)] $nested: $nested_type = Default::default();)*
        } }

        impl $crate::declaration::Group for $name {
            const NAME: &'static str = $group;
        }

        impl $crate::declaration::Rows for $name {
            fn rows() -> $crate::declaration::RowsOf<Self> {
                #[allow(unused_mut)]
                let mut rows = Vec::new();
                $($crate::declaration::add(
                    &mut rows,
                    <$type as $crate::declaration::Declared>::rows($group, stringify!($field), concat!($($line),+), &|p: &mut Self| &mut p.$field),
                    &[$(&$detail),*],
                );)*
                $($crate::declaration::add(&mut rows, <$nested_type>::rows_of::<Self>(), &[$(&$default),*]);)*
                rows
            }

            fn find(&self, kind: std::any::TypeId) -> Option<&dyn std::any::Any> {
                (kind == std::any::TypeId::of::<Self>()).then_some(self)
            }
        }
    };
    ($(#[$about:meta])* pub struct $name:ident of $owner:ident: $bound:path, by $access:ident {
        $($(#[doc = $line:literal])+ $field:ident: $type:ty = $start:expr $(, $detail:expr)*;)*
    }) => {
        $crate::parameters! { @define $(#[$about])* $name { $($(#[doc = $line])+ $field: $type = $start;)* } }

        impl $name {
            /// Rows of the parameters in the group that contains these.
            pub fn rows_of<$owner: $bound>() -> $crate::declaration::RowsOf<$owner> {
                let mut rows = Vec::new();
                $($crate::declaration::add(
                    &mut rows,
                    <$type as $crate::declaration::Declared>::rows($owner::NAME, stringify!($field), concat!($($line),+), &|p: &mut $owner| &mut p.$access().$field),
                    &[$(&$detail),*],
                );)*
                rows
            }
        }
    };
    (@define $(#[$about:meta])* $name:ident { $($(#[$doc:meta])+ $field:ident: $type:ty = $start:expr;)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        pub struct $name {
            $($(#[$doc])+ pub $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $start,)* }
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

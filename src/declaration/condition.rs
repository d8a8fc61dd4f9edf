//! Conditions under which the value of a variable has an effect: trees of tests on parameters.
//!
//! A test is written with the type of its group, so the compiler checks the field and the type of its values:
//!
//! ```text
//! is!(Scene.start, Start::SteadyHeat)                    one of the listed values
//! differs!(WheelBrakeSpec.sliding.slip_slope, 0.0)       none of the listed values; `sliding` is a nested group
//! above!(LimitedSlipSpec.preload, 0.0)
//! on!(WarmUpSpec), off!(WarmUpSpec)                      the switch of an effect
//! ```

use std::any::{Any, TypeId};

use super::Setting;
use crate::static_memory::store_all;

/// Group of parameters, with the common first part of their names.
pub trait Group: Any + Copy {
    /// First part of the names.
    const NAME: &'static str;
}

/// All parameters of a scene, as tests see them.
pub trait Groups {
    /// Group of the type `kind`; `None` if there is no such group.
    fn group(&self, kind: TypeId) -> Option<&dyn Any>;
    /// True if the effect with the parameters of type `kind` is on; `None` if there is no such effect.
    fn is_on(&self, kind: TypeId) -> Option<bool>;
}

/// Influence of a parameter that several effects share. Each effect declares under which condition it needs the parameter
/// for this influence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// The oil keeps the given temperature.
    GivenTemperature,
    /// The oil warms up from its temperature at the start.
    TemperatureAtStart,
    /// Friction or stress depends on the temperature of the oil.
    Temperature,
    /// Kinematic viscosity of the oil.
    Viscosity,
    /// Dynamic viscosity of the oil, and therefore its density.
    DynamicViscosity,
    /// Mass of the side gears along their axes.
    AxialMass,
    /// Inertia of the pinion.
    Pinion,
    /// Inertia of the driven end of the propeller shaft.
    PropellerEnd,
}

/// Condition on parameters, and on the situation in which a value is set.
#[derive(Clone, Copy, Debug)]
pub enum Condition {
    /// At least one condition holds.
    Any(&'static [Self]),
    /// All conditions hold.
    All(&'static [Self]),
    /// A test on one parameter holds.
    Test(Test),
    /// An effect has this need, under the condition that it declares.
    Need(Need),
    /// The FMU integrates, as in co-simulation.
    OwnSteps,
    /// The value is set before the first step.
    FromStart,
}

/// Returns the condition that at least one of `parts` holds.
pub fn any<const N: usize>(parts: [Condition; N]) -> Condition {
    Condition::Any(store_all(&parts))
}

/// Returns the condition that all `parts` hold.
pub fn all<const N: usize>(parts: [Condition; N]) -> Condition {
    Condition::All(store_all(&parts))
}

/// Test on one parameter.
#[derive(Clone, Copy, Debug)]
pub struct Test {
    /// Group of the parameter.
    pub group: &'static str,
    /// Name of the parameter in its group.
    pub field: &'static str,
    /// Relation to the wanted values: `=`, `!=` or `>`.
    pub sign: &'static str,
    /// Wanted values, as numbers.
    pub wanted: fn() -> Vec<f64>,
    /// Returns whether the test holds; `None` if the group does not exist.
    pub holds: fn(&dyn Groups) -> Option<bool>,
}

impl Test {
    /// Name of the parameter.
    pub fn name(&self) -> String {
        format!("{}.{}", self.group, self.field)
    }
}

/// Returns the name of the parameter at the end of `path`, which may lead through a nested group.
pub fn end_of(path: &'static str) -> &'static str {
    path.rsplit('.').next().unwrap_or(path).trim_start()
}

/// Returns the group of type `G`.
pub fn group<G: Group>(all: &dyn Groups) -> Option<&G> {
    all.group(TypeId::of::<G>())?.downcast_ref()
}

/// Returns `value` as a number.
pub fn number<T: Setting>(value: T) -> f64 {
    value.number()
}

/// A test on the group `$group`: name in the group, relation, predicate, and wanted values.
macro_rules! test {
    ($group:ty, $field:expr, $sign:literal, $holds:expr, [$($value:expr),+]) => {
        $crate::declaration::Condition::Test($crate::declaration::Test {
            group: <$group as $crate::declaration::Group>::NAME,
            field: $field,
            sign: $sign,
            wanted: || vec![$($crate::declaration::number($value)),+],
            holds: |all| {
                let holds: fn(&$group) -> bool = $holds;
                $crate::declaration::group::<$group>(all).map(holds)
            },
        })
    };
}

/// The parameter has one of the values.
macro_rules! is {
    ($group:ident $(. $field:ident)+, $($value:expr),+) => {
        test!($group, $crate::declaration::end_of(stringify!($($field).+)), "=", |g| [$($value),+].contains(&g$(.$field)+), [$($value),+])
    };
}

/// The parameter has none of the values.
macro_rules! differs {
    ($group:ident $(. $field:ident)+, $($value:expr),+) => {
        test!($group, $crate::declaration::end_of(stringify!($($field).+)), "!=", |g| ![$($value),+].contains(&g$(.$field)+), [$($value),+])
    };
}

/// The parameter is above the value.
macro_rules! above {
    ($group:ident $(. $field:ident)+, $value:expr) => {
        test!($group, $crate::declaration::end_of(stringify!($($field).+)), ">", |g| g$(.$field)+ > $value, [$value])
    };
}

/// The switch `effects.$name` of the effect with these parameters has the state `$state`.
macro_rules! switched {
    ($effect:ty, $name:expr, $state:literal) => {
        $crate::declaration::Condition::Test($crate::declaration::Test {
            group: "effects",
            field: $name,
            sign: "=",
            wanted: || vec![$crate::declaration::number($state)],
            holds: |all| all.is_on(std::any::TypeId::of::<$effect>()).map(|on| on == $state),
        })
    };
}

/// The effect with these parameters is on.
macro_rules! on {
    ($effect:ty) => {
        switched!($effect, <$effect as $crate::declaration::Group>::NAME, true)
    };
}

/// The effect with these parameters is off.
macro_rules! off {
    ($effect:ty) => {
        switched!($effect, <$effect as $crate::declaration::Group>::NAME, false)
    };
}

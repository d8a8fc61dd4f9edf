//! A version of FMI: the table of its functions, each with a random call.

use bevel_differential::instance::{Call, Kind};
use bevel_differential::{fmi2, fmi3};

use super::arguments::CallResult;
use super::interface::Interface;
use super::site::Site;

/// A C function of the FMU.
pub struct Function {
    /// Name of the function.
    pub name: &'static str,
    /// Relative frequency of calls.
    pub weight: usize,
    /// Kind of instance for this function; `None` for both kinds.
    pub kind: Option<Kind>,
    /// Calls the function with random arguments.
    pub call: fn(&mut Site) -> CallResult,
}

/// A version of FMI.
pub struct Version {
    /// Functions that the fuzzer itself needs for its instances.
    pub interface: Interface,
    /// All functions.
    pub functions: &'static [Function],
}

/// Creates a table of functions: name, weight, kind of instance, and the call. The call follows a comma, or is a shape
/// after a colon, with its argument between the site and the C function.
macro_rules! functions {
    ($($name:ident $weight:literal $kind:ident $(: $shape:ident $(($further:expr))?)? $(, $call:expr)?;)+) => {
        &[$(Function {
            name: stringify!($name),
            weight: $weight,
            kind: $kind,
            call: { $($call)? $(|s| $shape(s, $($further,)? $name))? },
        }),+]
    };
}

pub(super) use functions;

/// Co-simulation, in tables of functions.
pub const STEPS: Option<Kind> = Some(Kind::CoSimulation);
/// Model exchange, in tables of functions.
pub const EXCHANGE: Option<Kind> = Some(Kind::ModelExchange);

impl Function {
    /// True if the function only reads.
    pub fn only_reads(&self) -> bool {
        let name = &self.name["fmi2".len()..];
        let frees = name.eq_ignore_ascii_case("FreeFMUState");
        name.starts_with("Get") || name.to_ascii_lowercase().contains("serialize") || frees
    }

    /// True if the function may change the instance although it fails: a start or a step may fail halfway.
    pub fn may_change_on_failure(&self) -> bool {
        let halfway = [
            "DoStep",
            "ExitInitializationMode",
            "CompletedIntegratorStep",
            "NewDiscreteStates",
            "UpdateDiscreteStates",
        ];
        halfway.contains(&&self.name["fmi2".len()..])
    }

    /// Row of the function in the library's table of calls; `None` if it is not called on an instance.
    pub fn row(&self) -> Option<&'static Call> {
        fmi2::CALLS.iter().chain(fmi3::CALLS).find(|call| call.names[0] == self.name)
    }
}

//! A version of FMI: the table of its functions, each with a call at random.

use bevel_differential::instance::Kind;

use super::arguments::CallResult;
use super::interface::Interface;
use super::site::Site;

/// A C function of the FMU.
pub struct Function {
    /// Its name.
    pub name: &'static str,
    /// Relative frequency of calls.
    pub weight: usize,
    /// Kind of instance that it is for; none if it is for both.
    pub kind: Option<Kind>,
    /// Beginning of its messages: its name, or that of a family of functions.
    pub said: &'static str,
    /// Calls it with arguments at random.
    pub call: fn(&mut Site) -> CallResult,
}

/// A version of FMI.
pub struct Version {
    /// Functions by which the calls look after instances.
    pub interface: Interface,
    /// All functions.
    pub functions: &'static [Function],
}

/// A table of functions: name, weight, kind of instance, call, and the beginning of its messages if that is not the name.
macro_rules! functions {
    ($($name:ident $weight:literal $kind:expr, $call:expr $(, $said:expr)?;)+) => {
        &[$(Function {
            name: stringify!($name),
            weight: $weight,
            kind: $kind,
            said: functions!(@said $name $($said)?),
            call: $call,
        }),+]
    };
    (@said $name:ident) => { stringify!($name) };
    (@said $name:ident $said:expr) => { $said };
}

pub(super) use functions;

/// Kinds of instances in tables of functions.
pub const STEPS: Option<Kind> = Some(Kind::CoSimulation);
/// Model exchange.
pub const EXCHANGE: Option<Kind> = Some(Kind::ModelExchange);

impl Function {
    /// True if it only reads.
    pub fn only_reads(&self) -> bool {
        let name = &self.name["fmi2".len()..];
        let frees = name.eq_ignore_ascii_case("FreeFMUState");
        name.starts_with("Get") || name.to_ascii_lowercase().contains("serialize") || frees
    }

    /// True if it may change the instance although it fails: a start or a step may fail halfway.
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

    /// True if it is called on an instance.
    pub fn has_component(&self) -> bool {
        let name = &self.name["fmi2".len()..];
        !name.starts_with("Instantiate") && !["GetTypesPlatform", "GetVersion", "FreeInstance"].contains(&name)
    }
}

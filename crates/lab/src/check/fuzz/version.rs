//! A version of FMI as the random calls need it: the table of its functions, and those by which they look after instances.

use bevel_differential::instance::{ComponentPointer, FmuState, Kind, Status};

use super::arguments::CallResult;
use super::calls::Site;
use super::instance::{Host, Making};
use super::{fmi2, fmi3};

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
    /// Its first number.
    pub number: u32,
    /// All its functions.
    pub functions: &'static [Function],
    /// Makes an instance; NULL if it is refused.
    pub make: fn(&Making, &Host) -> ComponentPointer,
    /// Frees an instance.
    pub free: unsafe fn(ComponentPointer),
    /// Resets an instance.
    pub reset: unsafe fn(ComponentPointer) -> Status,
    /// Logs all categories of errors only.
    pub log_all: unsafe fn(ComponentPointer) -> Status,
    /// Initialises an instance that has its start values.
    pub initialise: unsafe fn(ComponentPointer) -> [Status; 2],
    /// Goes on from the end of initialisation to where steps happen.
    pub run: unsafe fn(ComponentPointer, Kind),
    /// Reads the time.
    pub time: unsafe fn(ComponentPointer, *mut f64) -> Status,
    /// Moves on from a time by a step.
    pub step: unsafe fn(ComponentPointer, f64, f64) -> Status,
    /// Sets a number.
    pub set_real: unsafe fn(ComponentPointer, u32, f64) -> Status,
    /// Sets an integer or a choice.
    pub set_integer: unsafe fn(ComponentPointer, u32, i32) -> Status,
    /// Sets a switch.
    pub set_boolean: unsafe fn(ComponentPointer, u32, bool) -> Status,
    /// Reads numbers.
    pub get_reals: unsafe fn(ComponentPointer, *const u32, usize, *mut f64) -> Status,
    /// Reads all continuous states.
    pub get_states: unsafe extern "C" fn(ComponentPointer, *mut f64, usize) -> Status,
    /// Reads their derivatives.
    pub get_rates: unsafe extern "C" fn(ComponentPointer, *mut f64, usize) -> Status,
    /// Reads event indicators.
    pub get_indicators: unsafe extern "C" fn(ComponentPointer, *mut f64, usize) -> Status,
    /// Stores the state.
    pub get_state: unsafe fn(ComponentPointer, *mut FmuState) -> Status,
    /// Restores a state.
    pub set_state: unsafe fn(ComponentPointer, FmuState) -> Status,
    /// Frees a state.
    pub free_state: unsafe fn(ComponentPointer, *mut FmuState) -> Status,
    /// Size of a serialised state.
    pub state_size: unsafe fn(ComponentPointer, FmuState, *mut usize) -> Status,
    /// Serialises a state.
    pub serialize: unsafe fn(ComponentPointer, FmuState, *mut u8, usize) -> Status,
    /// Makes a state of bytes.
    pub deserialize: unsafe fn(ComponentPointer, *const u8, usize, *mut FmuState) -> Status,
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

/// Both versions.
pub static VERSIONS: [&Version; 2] = [&fmi2::VERSION, &fmi3::VERSION];

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

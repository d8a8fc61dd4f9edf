//! FMI functions that the fuzzer itself needs for its instances, with signatures that both versions share.

use bevel_differential::instance::{ComponentPointer, FmuState, Kind, Status};

use super::host::{Host, InstanceOptions};

/// Functions of one version of FMI.
pub struct Interface {
    /// Major version of FMI.
    pub number: u32,
    /// Creates an instance; NULL if it is refused.
    pub make: fn(&InstanceOptions, &Host) -> ComponentPointer,
    /// Frees an instance.
    pub free: unsafe extern "C" fn(ComponentPointer),
    /// Resets an instance.
    pub reset: unsafe extern "C" fn(ComponentPointer) -> Status,
    /// Selects all log categories and switches debug logging off, so that only calls without the status OK are logged.
    pub log_all: unsafe fn(ComponentPointer) -> Status,
    /// Initialises an instance with its present start values.
    pub initialise: unsafe fn(ComponentPointer) -> [Status; 2],
    /// Advances from the end of initialisation to the mode in which steps are possible.
    pub run: unsafe fn(ComponentPointer, Kind),
    /// Reads the time.
    pub time: unsafe fn(ComponentPointer, *mut f64) -> Status,
    /// Executes a step from a time.
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
    /// Reads the derivatives of all continuous states.
    pub get_rates: unsafe extern "C" fn(ComponentPointer, *mut f64, usize) -> Status,
    /// Reads event indicators.
    pub get_indicators: unsafe extern "C" fn(ComponentPointer, *mut f64, usize) -> Status,
    /// Stores the state.
    pub get_state: unsafe extern "C" fn(ComponentPointer, *mut FmuState) -> Status,
    /// Restores a state.
    pub set_state: unsafe extern "C" fn(ComponentPointer, FmuState) -> Status,
    /// Frees a state.
    pub free_state: unsafe extern "C" fn(ComponentPointer, *mut FmuState) -> Status,
    /// Returns the size of a serialised state.
    pub state_size: unsafe extern "C" fn(ComponentPointer, FmuState, *mut usize) -> Status,
    /// Serialises a state.
    pub serialize: unsafe fn(ComponentPointer, FmuState, *mut u8, usize) -> Status,
    /// Creates a state from bytes.
    pub deserialize: unsafe fn(ComponentPointer, *const u8, usize, *mut FmuState) -> Status,
}

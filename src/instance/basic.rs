//! Types that both versions of FMI share.

use serde::{Deserialize, Serialize};

use super::c_types::{c_char, c_uint, c_void};

/// Pointer to an instance: fmi2Component or fmi3Instance.
pub type ComponentPointer = *mut c_void;
/// Pointer to a snapshot: fmi2FMUstate or fmi3FMUState.
pub type FmuState = *mut c_void;
/// A C string, which ends with NUL, or NULL.
pub type Text = *const c_char;
/// Value reference.
pub type ValueReference = c_uint;

/// Status that a call returns.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Success.
    Ok = 0,
    /// Something is unusual, but the simulation continues.
    Warning = 1,
    /// Refused, or carried out only in part. The instance is valid.
    Discard = 2,
    /// Refused or failed; see the log.
    Error = 3,
    /// The instance is unusable; never returned by this FMU.
    Fatal = 4,
    /// The step is still running. Exists only in FMI 2.0, and is never returned by this FMU.
    Pending = 5,
}

/// Kind of an instance, which determines who integrates the states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum Kind {
    /// The host's solver integrates the states.
    ModelExchange = 0,
    /// The instance integrates the states.
    CoSimulation = 1,
}

/// C interface of a version of FMI: its number, and names of functions for messages.
#[derive(Debug)]
pub struct Interface {
    /// 2 for FMI 2.0, 3 for FMI 3.0.
    pub version: u32,
    /// The function that announces tolerance and time interval.
    pub setup: &'static str,
    /// The function that restores a state.
    pub set_state: &'static str,
    /// The function that resets an instance.
    pub reset: &'static str,
    /// The function that ends initialisation.
    pub exit_initialization: &'static str,
}

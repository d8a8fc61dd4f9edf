//! Readings of the ledger.

use crate::model::setup::{HEATS, STEP_READINGS};

/// Number of kinds of bodies that dry friction holds.
pub const HELD: usize = 4;

/// Ledger and solver statistics.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LedgerReadings {
    /// Heat since the start by cause [J].
    pub heat: [f64; HEATS],
    /// Readings of the effects that change with accepted steps.
    pub readings: [f64; STEP_READINGS],
    /// Numbers of side gears, planet groups, wheels and clutches on command that dry friction holds.
    pub held: [f64; HELD],
    /// Energy balance: stored energy − work of the inputs + heat [J]; 0 for an exact solution.
    pub energy_residual: f64,
    /// Accepted steps.
    pub steps: f64,
    /// Rejected steps.
    pub rejected: f64,
    /// Evaluations of the tooth forces.
    pub rhs_calls: f64,
    /// Size of the last accepted step [s].
    pub step_size: f64,
}

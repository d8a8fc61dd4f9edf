//! Counters of the integrator.

use serde::{Deserialize, Serialize};

/// Counts of steps and evaluations, by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// Accepted steps.
    pub accepted: u64,
    /// Steps rejected because the local error was too large.
    pub rejected_error: u64,
    /// Steps rejected because a value was not finite or the matrix singular.
    pub rejected_invalid: u64,
    /// Steps rejected because their ledger did not close.
    pub rejected_ledger: u64,
    /// Steps shortened because the equations switched within them.
    pub rejected_switch: u64,
    /// Evaluations of the right-hand side, including those of linearisations and of the ledger.
    pub evaluations: u64,
    /// Evaluations of the Jacobian, each followed by a factorisation.
    pub jacobians: u64,
}

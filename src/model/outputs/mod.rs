//! What can be read from a simulation: motion from the state, forces by one evaluation of the teeth, the ledger.

pub mod readings;
pub mod resultants;

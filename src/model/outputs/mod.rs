//! Readings of a simulation: motion from the state, forces from one evaluation of the teeth, and the ledger.

pub mod forces;
pub mod ledger_readings;
mod loads;
pub mod motion;
pub mod pairs;

pub use ledger_readings::LedgerReadings;
pub use motion::Motion;

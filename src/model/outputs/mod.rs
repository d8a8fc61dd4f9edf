//! What can be read from a simulation: motion from the state, forces by one evaluation of the teeth, the ledger.

pub mod forces;
pub mod ledger_readings;
mod loads;
pub mod motion;
pub mod pairs;
pub mod pv;
pub mod resultants;

pub use ledger_readings::LedgerReadings;
pub use motion::Motion;

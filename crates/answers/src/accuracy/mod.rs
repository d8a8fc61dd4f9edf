//! Cost of accuracy in a scene: the cheapest model that gives wanted quantities to a wanted accuracy, with the reasons.
//!
//! 1. The **reference** is the richest model that the question admits, at a tolerance whose own error does not matter.
//! 2. Every plainer level and law, and the richest model without each effect, is compared with the reference.
//! 3. The search starts from the plainest gears that are accurate enough. It leaves out effects and loosens the
//!    tolerance step by step, as long as the *combination* stays within the accuracy. The chosen setting was itself run
//!    and compared.
//! 4. A scene with fixed steps keeps them: the search then looks for the longest step instead of the loosest tolerance.
//!
//! The choice depends only on counted work, so it is the same on every machine. Measured times are for information
//! only.
//!
//! [`answer`] searches and returns an [`Answer`]; [`report`], [`table`] and [`chosen`] show it.

pub mod answer;
pub mod bench;
pub mod chosen;
pub mod fraction;
pub mod gears;
pub mod knowledge;
pub mod price;
pub mod record;
pub mod reference;
pub mod report;
pub mod search;
pub mod statistic;
pub mod switches;
pub mod table;
pub mod want;
pub mod words;

pub use answer::{Answer, answer};

/// Request for the cheapest accurate model of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Wanted quantities, `OUTPUT:STATISTIC`; none = all outputs of the scene.
    pub wants: Vec<String>,
    /// Wanted accuracy, as a fraction.
    pub within: f64,
    /// Outputs count from this time on [s].
    pub from: f64,
}

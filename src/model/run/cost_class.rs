//! What a step costs.

/// What a step costs, by what has to be evaluated, cheapest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CostClass {
    /// No teeth and no effect on bodies: a step is a formula.
    ClosedForm,
    /// No teeth, but torques of effects: integrated, without fast motion.
    Rigid,
    /// Teeth or springs that see no effect.
    Teeth,
    /// The same with effects on bodies.
    TeethAndBodies,
    /// Teeth slice by slice: errors, friction, pins.
    TeethInDetail,
}

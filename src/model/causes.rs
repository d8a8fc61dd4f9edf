//! What heat comes from.

/// Causes of heat, in the order of the ledger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Cause {
    Contact,
    ToothFriction,
    Thrust,
    Clutch,
    Drag,
    Shaft,
    Support,
}

/// Number of causes.
pub const CAUSES: usize = 7;

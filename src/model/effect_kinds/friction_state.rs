//! State of the dry friction on a body: stuck or sliding, and the anchor of its spring.

use serde::{Deserialize, Serialize};

use crate::model::scene::PAIRS;
use crate::numeric::finite;

/// Mode of a body: stuck, or sliding in one direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// Held by the spring from its anchor.
    #[default]
    Stuck,
    /// Slides forward.
    Forward,
    /// Slides backward.
    Backward,
}

impl Mode {
    /// +1 or −1 while sliding, 0 while stuck.
    pub fn direction(self) -> f64 {
        match self {
            Mode::Stuck => 0.0,
            Mode::Forward => 1.0,
            Mode::Backward => -1.0,
        }
    }

    /// Opposite direction of sliding.
    pub fn reversed(self) -> Self {
        match self {
            Mode::Stuck => Mode::Stuck,
            Mode::Forward => Mode::Backward,
            Mode::Backward => Mode::Forward,
        }
    }
}

/// State of the friction on a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrictionState {
    /// Stuck or sliding.
    pub mode: Mode,
    /// Position at which the spring is relaxed, or would be relaxed while the body slides [rad].
    pub anchor: f64,
    /// Stiffness for which the anchor is valid [N·m/rad]; 0 if no friction acts.
    pub stiffness: f64,
}

finite!(FrictionState { anchor, stiffness; mode });

impl FrictionState {
    /// True if friction holds the body.
    pub fn holds(&self) -> bool {
        self.stiffness > 0.0 && self.mode == Mode::Stuck
    }
}

/// Dry friction on all pairs at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairFriction {
    /// Torque that holds each pair back, for a single pair if there are several identical ones [N·m].
    pub torque: [f64; PAIRS],
    /// Direction ±1 in which a pair at rest begins to slide, or 0.
    pub begins: [f64; PAIRS],
}

impl PairFriction {
    /// No friction.
    pub const NONE: Self = Self { torque: [0.0; PAIRS], begins: [0.0; PAIRS] };
}

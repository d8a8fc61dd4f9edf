//! End of the last step of the host's solver.

use serde::{Deserialize, Serialize};

use crate::model::dynamics::State;
use crate::model::scene::{Inputs, MAX_DOF};
use crate::numeric::finite;

/// End of the last step that the host's solver completed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accepted {
    /// Time [s].
    pub time: f64,
    /// Positions.
    pub q: [f64; MAX_DOF],
    /// Velocities.
    pub v: [f64; MAX_DOF],
    /// Commands of the imposed speeds to whose jumps the free speeds have already responded.
    pub followed_commands: Inputs,
}

finite!(Accepted { time, q, v, followed_commands });

impl Accepted {
    /// Returns `state` moved to the end of this step.
    pub fn applied_to(&self, state: &State) -> State {
        state.elsewhere(self.time, self.q, self.v)
    }
}

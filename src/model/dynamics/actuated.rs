//! Commands that pass actuators: the states of the actuators, and the inputs that act behind them.

use serde::{Deserialize, Serialize};

use crate::model::effect_kinds::{Actuator, ActuatorState, Parabola};
use crate::model::scene::{ACTUATED, InputDerivatives, Inputs};
use crate::numeric::finite;

/// Actuators of a scene, in the order of [`Inputs::actuated_mut`]. `None` for a command that acts directly.
pub type Actuators = [Option<Actuator>; ACTUATED];

/// States of the actuators.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Actuated {
    /// State of each actuator. It belongs to the present, or to the start of the pending step.
    pub states: [ActuatorState; ACTUATED],
    /// Time to which the states belong if the host's solver integrates [s].
    pub since: Option<f64>,
}

finite!(Actuated { states, since });

impl Actuated {
    /// States that have settled at the commands of `inputs`; `None` without actuators.
    pub fn settled(actuators: &Actuators, inputs: &Inputs) -> Option<Self> {
        let commands = inputs.actuated();
        let state = |k: usize| actuators[k].map_or(ActuatorState::default(), |of| of.settled(commands[k]));
        let any = actuators.iter().any(Option::is_some);
        any.then(|| Self { states: std::array::from_fn(state), since: None })
    }

    /// True if the output of any actuator changes under these commands.
    pub fn moves(&self, actuators: &Actuators, commands: &[Parabola; ACTUATED]) -> bool {
        (0..ACTUATED).any(|k| self.moves_one(k, actuators, commands))
    }

    /// True if the output of actuator `k` changes under these commands.
    pub fn moves_one(&self, k: usize, actuators: &Actuators, commands: &[Parabola; ACTUATED]) -> bool {
        actuators[k].is_some_and(|of| !of.is_settled(&self.states[k], &commands[k]))
    }

    /// States `time` [s] later.
    pub fn after(&self, actuators: &Actuators, commands: &[Parabola; ACTUATED], time: f64) -> Self {
        let state = |k: usize| match &actuators[k] {
            Some(of) => of.after(&self.states[k], &commands[k], time),
            None => self.states[k],
        };
        Self { states: std::array::from_fn(state), ..*self }
    }

    /// States at the time `now` [s] of the host's solver. The inputs have changed from `before` to
    /// `inputs` since the last completed step. This change is taken as linear, because only its ends are known.
    pub fn at(&self, actuators: &Actuators, [before, inputs]: [&Inputs; 2], now: f64) -> Self {
        let Some(time) = self.since.map(|since| now - since).filter(|&time| time > 0.0) else { return *self };
        let slopes = before.rates_to(inputs, time).actuated();
        let from = before.actuated();
        self.after(actuators, &std::array::from_fn(|k| [from[k], slopes[k], 0.0]), time)
    }

    /// Replaces commands and their derivatives by what acts behind the actuators.
    pub fn act(
        &self,
        actuators: &Actuators,
        commands: &[Parabola; ACTUATED],
        inputs: &mut Inputs,
        InputDerivatives { rates: [first, second] }: &mut InputDerivatives,
    ) {
        let slots = inputs.actuated_mut().into_iter().zip(first.actuated_mut().into_iter().zip(second.actuated_mut()));
        for (k, (value, (first, second))) in slots.enumerate() {
            if let Some(of) = &actuators[k] {
                [*value, *first, *second] = of.acting(&self.states[k], &commands[k]);
            }
        }
    }
}

/// Courses of the commands that may pass actuators.
pub fn courses(inputs: &Inputs, derivatives: Option<&InputDerivatives>) -> [Parabola; ACTUATED] {
    let values = inputs.actuated();
    let [first, second] = derivatives.map_or([[0.0; ACTUATED]; 2], |of| of.rates.each_ref().map(Inputs::actuated));
    std::array::from_fn(|k| [values[k], first[k], second[k]])
}

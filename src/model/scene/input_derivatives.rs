//! How inputs change between communication points: u(t) = u + u̇ t + ü t²/2, as far as the host gives derivatives.
//!
//! Torques follow the parabola, and so do imposed speeds, whose derivatives are accelerations. Lock and fault are commands:
//! they follow it too, but act at the start of a step.

use serde::{Deserialize, Serialize};

use super::inputs::Inputs;

/// Highest order of the derivatives.
pub const ORDERS: usize = 2;

/// Derivatives of the inputs: u̇ and ü [unit of the input per s and per s²].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InputDerivatives {
    /// By order, the first first.
    pub rates: [Inputs; ORDERS],
}

impl InputDerivatives {
    /// Inputs that stay constant.
    pub const ZERO: Self = Self { rates: [Inputs::ZERO; ORDERS] };

    /// Whether all derivatives are finite numbers.
    pub fn is_finite(&self) -> bool {
        self.rates.iter().all(Inputs::is_finite)
    }

    /// Inputs and their derivatives `time` [s] after they were `inputs`.
    pub fn after(&self, time: f64, inputs: &Inputs) -> (Inputs, Self) {
        let [first, second] = &self.rates;
        let unlimited = inputs.plus(time, first).plus(0.5 * time * time, second);
        let later = unlimited.limited();
        let rates = [first.plus(time, second), *second];
        if later == unlimited {
            return (later, Self { rates });
        }
        // an input that has reached its limit stays there
        (later, Self { rates: rates.map(|rate| rate.where_equal(&later, &unlimited)) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_follow_a_parabola_from_any_point_on_it() {
        let rate = Inputs { carrier_torque: 3.0, ..Inputs::ZERO };
        let second = Inputs { carrier_torque: -4.0, planet_spin: 2.0, ..Inputs::ZERO };
        let input_derivatives = InputDerivatives { rates: [rate, second] };
        let start = Inputs { carrier_torque: 5.0, ..Inputs::ZERO };
        let (half, rest) = input_derivatives.after(0.25, &start);
        let (end, _) = rest.after(0.5, &half);
        let (t, whole) = (0.75, input_derivatives.after(0.75, &start).0);
        assert_eq!(whole.carrier_torque, 5.0 + 3.0 * t - 2.0 * t * t);
        assert_eq!((end.carrier_torque, end.planet_spin), (whole.carrier_torque, t * t));
    }

    #[test]
    fn commands_stay_within_their_limits() {
        let input_derivatives =
            InputDerivatives { rates: [Inputs { lock: 1.0, fault: -1.0, ..Inputs::ZERO }, Inputs::ZERO] };
        let (later, _) = input_derivatives.after(3.0, &Inputs { lock: 0.5, fault: 0.5, ..Inputs::ZERO });
        assert_eq!((later.lock, later.fault), (1.0, 0.0));
    }

    #[test]
    fn an_input_at_its_limit_has_no_rate() {
        let rate = Inputs { brake_torque: [-100.0, -10.0], carrier_torque: 5.0, ..Inputs::ZERO };
        let course = InputDerivatives { rates: [rate, Inputs::ZERO] };
        let (later, rest) = course.after(1.0, &Inputs { brake_torque: [50.0; 2], ..Inputs::ZERO });
        assert_eq!((later.brake_torque, later.carrier_torque), ([0.0, 40.0], 5.0));
        assert_eq!((rest.rates[0].brake_torque, rest.rates[0].carrier_torque), ([0.0, -10.0], 5.0));
    }
}

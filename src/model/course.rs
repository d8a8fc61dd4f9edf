//! How inputs go on between communication points: u(t) = u + u̇ t + ü t²/2, as far as the host told derivatives.
//!
//! Torques act as they go on, and so do imposed speeds, whose derivatives are accelerations. Lock and fault are commands:
//! they go on too, but act at the begin of a step.

use serde::{Deserialize, Serialize};

use super::parameters::Inputs;

/// Highest order of the derivatives.
pub const ORDERS: usize = 2;

/// Derivatives of the inputs: u̇ and ü [unit of the input per s and per s²].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// By order, the first first.
    pub rates: [Inputs; ORDERS],
}

impl Inputs {
    /// No input at all.
    pub const ZERO: Self = Self {
        carrier_speed: 0.0,
        carrier_torque: 0.0,
        load_torque: [0.0; 2],
        side_speed: [0.0; 2],
        planet_spin: 0.0,
        lock: 0.0,
        fault: 0.0,
    };

    /// All inputs in a row.
    pub fn as_array(&self) -> [f64; 9] {
        let ([left, right], [left_speed, right_speed]) = (self.load_torque, self.side_speed);
        let Self { carrier_speed, carrier_torque, planet_spin, lock, fault, .. } = *self;
        [carrier_speed, carrier_torque, left, right, left_speed, right_speed, planet_spin, lock, fault]
    }

    /// Whether all inputs are finite numbers.
    pub fn is_finite(&self) -> bool {
        self.as_array().into_iter().all(f64::is_finite)
    }

    /// self + factor · other.
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        let sum = |a: f64, b: f64| a + factor * b;
        let sums = |a: [f64; 2], b: [f64; 2]| [sum(a[0], b[0]), sum(a[1], b[1])];
        Self {
            carrier_speed: sum(self.carrier_speed, other.carrier_speed),
            carrier_torque: sum(self.carrier_torque, other.carrier_torque),
            load_torque: sums(self.load_torque, other.load_torque),
            side_speed: sums(self.side_speed, other.side_speed),
            planet_spin: sum(self.planet_spin, other.planet_spin),
            lock: sum(self.lock, other.lock),
            fault: sum(self.fault, other.fault),
        }
    }
}

impl Course {
    /// Inputs that stay as they are.
    pub const STILL: Self = Self { rates: [Inputs::ZERO; ORDERS] };

    /// Whether all derivatives are finite numbers.
    pub fn is_finite(&self) -> bool {
        self.rates.iter().all(Inputs::is_finite)
    }

    /// Inputs, and how they go on from there, `time` [s] after they were `inputs`.
    pub fn after(&self, time: f64, inputs: &Inputs) -> (Inputs, Self) {
        let [first, second] = &self.rates;
        let mut inputs = inputs.plus(time, first).plus(0.5 * time * time, second);
        // commands have two ends
        (inputs.lock, inputs.fault) = (inputs.lock.clamp(0.0, 1.0), inputs.fault.clamp(0.0, 1.0));
        (inputs, Self { rates: [first.plus(time, second), *second] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_is_a_parabola_wherever_it_is_taken_up() {
        let rate = Inputs { carrier_torque: 3.0, ..Inputs::ZERO };
        let second = Inputs { carrier_torque: -4.0, planet_spin: 2.0, ..Inputs::ZERO };
        let course = Course { rates: [rate, second] };
        let start = Inputs { carrier_torque: 5.0, ..Inputs::ZERO };
        let (half, rest) = course.after(0.25, &start);
        let (end, _) = rest.after(0.5, &half);
        let (t, whole) = (0.75, course.after(0.75, &start).0);
        assert_eq!(whole.carrier_torque, 5.0 + 3.0 * t - 2.0 * t * t);
        assert_eq!((end.carrier_torque, end.planet_spin), (whole.carrier_torque, t * t));
    }
}

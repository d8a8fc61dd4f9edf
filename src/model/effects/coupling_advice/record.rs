//! Record of all ports: sums that decay, and the ratio and the advice that follow from them.

use serde::{Deserialize, Serialize};

use super::memory::LEAST_STEPS;
use super::port::{LAG, Port, PortStep, energy_difference};
use super::regression::{CERTAINLY_EXPLAINED, EXPLAINED};
use crate::numeric::{Finite, finite, sqrt};

/// Number of ports: carrier, left side, right side.
pub const PORTS: usize = 3;
/// Index of the left side, which always has a port.
const LEFT: usize = 1;
/// Signs of the energy that the cut creates if the host exchanges more than the unit. Torque drives the carrier and
/// loads the sides.
const SIGNS: [f64; PORTS] = [-1.0, 1.0, 1.0];
/// Weight of steps below which nothing is reported.
const LEAST_WEIGHT: f64 = 30.0;
/// Ratio above which a warning is reported.
const HIGH: f64 = 0.1;
/// Number of successive half-periods of growth after which a warning is reported.
const GROWTHS: u32 = 8;

/// Position and its rate of each port at a communication point: angle and speed, or twist and torque of the half-shaft.
pub type Places = [[f64; 2]; PORTS];

/// Record of the exchange between host and unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Coupling {
    /// Time [s], positions and their rates at the last communication point.
    pub last: Option<(f64, Places)>,
    /// True for each port whose input follows the host's derivatives although other inputs ramp (`solver.input_ramp`).
    pub follows: [bool; PORTS],
    /// Last four steps of each port; the step with number n has the index n modulo 4.
    steps: [[PortStep; 4]; PORTS],
    /// Number of steps.
    count: u64,
    /// True if any value of the host has changed. Until then, there is no error, and no sum is needed.
    has_changed: bool,
    /// Sum of the weights of all steps in the sums.
    weight: f64,
    /// Decaying sum of the energy that passed through the ports [J].
    passed: f64,
    /// Decaying sum of the magnitudes of the energy errors of order 1, each divided by its step [J/s].
    first_order: f64,
    /// Decaying sum of the magnitudes of the energy errors of order 2, each divided by the square of its step [J/s²].
    second_order: f64,
    /// Sums of each port.
    ports: [Port; PORTS],
}

finite!(Coupling {
    last, steps, weight, passed, first_order, second_order, ports; count, has_changed, follows
});

/// Cause of a warning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// Port with the largest error.
    pub port: usize,
    /// True if the energy error grows from period to period; otherwise, the ratio is high.
    pub grows: bool,
}

impl Coupling {
    /// Adds a step of all ports, of a host with `delay`. A carrier driven by speed has an empty step.
    pub fn add(&mut self, steps: &[PortStep; PORTS], delay: f64) {
        if !(steps[LEFT].h > 0.0 && steps.iter().all(PortStep::is_moderate)) {
            return;
        }
        if self.count == 0 {
            self.steps = steps.map(|step| [step; 4]);
        }
        let (before, place) = ((self.count.wrapping_sub(1) & 3) as usize, (self.count & 3) as usize);
        self.has_changed |=
            self.steps.iter().zip(steps).any(|(steps, step)| step.given != steps[before].given || step.is_line);
        self.steps.iter_mut().zip(steps).for_each(|(steps, step)| steps[place] = *step);
        self.count = self.count.wrapping_add(1);
        if self.has_changed && self.count > LAG as u64 {
            self.evaluate(delay);
        }
    }

    /// Adds the second of the last four steps to the sums.
    fn evaluate(&mut self, delay: f64) {
        let has_earlier = self.count > LAG as u64 + 1;
        // the oldest of the four steps is the one that the next step replaces
        let places: [usize; 4] = std::array::from_fn(|k| (self.count as usize + k) & 3);
        let h = self.steps[LEFT][places[3 - LAG]].h;
        let memory = self.ports.iter().fold(LEAST_STEPS * h, |longest, port| longest.max(port.oscillation.memory()));
        let keep = memory / (memory + h);
        self.weight = keep * self.weight + 1.0;
        let (mut passed, mut first, mut second) = (0.0, 0.0, 0.0);
        for ((port, steps), sign) in self.ports.iter_mut().zip(&self.steps).zip(SIGNS) {
            let steps = places.map(|place| &steps[place]);
            if steps[1].h == 0.0 {
                continue;
            }
            let error = sign * energy_difference(steps, delay, has_earlier);
            passed += steps[1].passed().abs();
            if steps[1].is_line && delay == 0.0 {
                second += error.abs();
            } else {
                first += error.abs();
            }
            port.add(steps, error, delay, keep);
        }
        self.passed = keep * self.passed + passed;
        self.first_order *= keep;
        self.second_order *= keep;
        if first + second > 0.0 {
            self.first_order += first / h;
            self.second_order += second / (h * h);
        }
    }

    /// Energy that the cut at each port has created since the start [J].
    pub fn errors(&self) -> [f64; PORTS] {
        self.ports.map(|port| port.error)
    }

    /// Length of the last step [s].
    pub fn step(&self) -> f64 {
        self.steps[LEFT][(self.count.wrapping_sub(1) & 3) as usize].h
    }

    /// Magnitude of the energy errors divided by the energy that passed.
    pub fn ratio(&self) -> f64 {
        let errors: f64 = self.ports.iter().map(|port| port.errors).sum();
        if self.passed > 0.0 { errors / self.passed } else { 0.0 }
    }

    /// Communication step at which the ratio would be `wanted` [s]: the positive root of A h + B h² = `wanted` · W. It
    /// is 0 if nothing moves, if no host reacts, or if there is no error.
    pub fn advice(&self, wanted: f64) -> f64 {
        let moves = self.ports.iter().any(|port| port.moves);
        let reacts = self.ports.iter().any(|port| port.reacts(EXPLAINED));
        let (a, b, c) = (self.first_order, self.second_order, wanted * self.passed);
        if !(moves && reacts && c > 0.0 && a + b > 0.0) {
            return 0.0;
        }
        let advice = 2.0 * c / (a + sqrt(a * a + 4.0 * b * c));
        if advice.is_finite() { advice } else { 0.0 }
    }

    /// Cause of a warning, if there is one: ports at which the host reacts cause a high ratio, or their energy errors
    /// grow.
    #[inline]
    pub fn growth(&self) -> Option<Growth> {
        let is_high = |errors: f64| errors > HIGH * self.passed;
        let any_grows = self.ports.iter().any(|port| port.growths >= GROWTHS);
        let all: f64 = self.ports.iter().map(|port| port.errors).sum();
        if self.weight < LEAST_WEIGHT || !(any_grows || is_high(all)) {
            return None;
        }
        let reacting = || (0..PORTS).filter(|&port| self.ports[port].reacts(CERTAINLY_EXPLAINED));
        let of = |port: usize| self.ports[port].errors;
        let port = reacting().max_by(|&a, &b| of(a).total_cmp(&of(b)))?;
        let grows = reacting().any(|port| self.ports[port].growths >= GROWTHS);
        (grows || is_high(reacting().map(of).sum())).then_some(Growth { port, grows })
    }

    /// True if a simulation can continue from these numbers.
    pub fn is_valid(&self) -> bool {
        Finite::is_finite(self) && self.weight >= 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Record of a spring at the left side, of torque `sign` · 4 φ, which turns to and fro in steps of 1 ms.
    fn spring(sign: f64, is_line: bool) -> Coupling {
        let (mut coupling, mut angle) = (Coupling::default(), 0.0);
        for step in 0..200 {
            let moved = sign * (0.3 * f64::from(step)).sin();
            let left =
                PortStep { given: 4.0 * angle, mean: 4.0 * angle, moved, changed: 0.5 * moved, h: 1e-3, is_line };
            let right = PortStep { h: 1e-3, ..PortStep::default() };
            coupling.add(&[PortStep::default(), left, right], 0.0);
            angle += moved;
        }
        coupling
    }

    #[test]
    fn the_advice_scales_the_step_by_the_order_of_the_exchange() {
        let wanted = 1e-3;
        let held = spring(1.0, false);
        assert!((held.advice(wanted) - 1e-3 * wanted / held.ratio()).abs() < 1e-15);
        let lines = spring(1.0, true);
        assert!((lines.advice(wanted) - 1e-3 * sqrt(wanted / lines.ratio())).abs() < 1e-15);
    }

    #[test]
    fn the_mirror_image_has_the_same_bits() {
        let [image, mirrored] = [1.0, -1.0].map(|sign| spring(sign, false));
        assert_eq!(image.errors(), mirrored.errors());
        assert_eq!([image.ratio(), image.advice(0.01)], [mirrored.ratio(), mirrored.advice(0.01)]);
    }

    #[test]
    fn values_that_are_not_finite_make_a_record_invalid() {
        assert!(spring(1.0, false).is_valid());
        assert!(!Coupling { passed: f64::NAN, ..spring(1.0, false) }.is_valid());
    }
}

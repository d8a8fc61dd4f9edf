//! Record of all ports: the ratio, the advice and its state, which follow from their sums.

use serde::{Deserialize, Serialize};

use super::memory::LEAST_STEPS;
use super::port::{LAG, Port, PortStep, Shaft, energy_difference};
use super::regression::{CERTAINLY_EXPLAINED, EXPLAINED, Law, WITHOUT_DOUBT_EXPLAINED};
use super::spec::AdviceState;
use crate::model::effect_kinds::Memory;
use crate::numeric::{Finite, finite};

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
/// Ratio above which a warning is reported after a few steps already, and the weight of these steps.
const EXTREME: f64 = 0.5;
const FEW_STEPS: f64 = 12.0;
/// Number of successive swings with growth after which the cut is unstable: four periods.
const GROWTHS: u32 = 8;
/// Fraction of the energy through all ports that is the lower bound of the denominator of each port's ratio.
const LEAST_SHARE: f64 = 0.05;

/// Position and its rate of each port at a communication point: angle and speed, or twist and torque of the half-shaft.
pub type PortMotion = [[f64; 2]; PORTS];

/// Cut between unit and host: the host's delay, and the half-shafts of sides driven by speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cut {
    /// Delay of the host's answer in communication steps.
    pub delay: f64,
    /// True if the unit ramps held inputs, so that they act half a step later.
    pub is_ramp: bool,
    /// Half-shaft behind each port; `None` at a port driven by torque.
    pub shafts: [Option<Shaft>; PORTS],
    /// Accelerations of the ports under a torque at each port that is driven by torque [1/(kg·m²)]. They are needed
    /// only for the longest stable steps.
    pub mobility: [[f64; PORTS]; PORTS],
}

impl Cut {
    /// Delay of the host's answer and of the unit's ramps, in communication steps.
    fn lag(&self) -> f64 {
        self.delay + if self.is_ramp { 0.5 } else { 0.0 }
    }
}

/// Record of the exchange between host and unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Coupling {
    /// Time [s], positions and their rates at the last communication point.
    pub last: Option<(f64, PortMotion)>,
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
    /// Sums of each port.
    ports: [Port; PORTS],
}

finite!(Coupling { last, steps, weight, ports; count, has_changed, follows });

/// Cause of a warning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// Port with the shortest stable step, or with the largest ratio.
    pub port: usize,
    /// True if a swing grows by the cut; otherwise, the ratio is high.
    pub is_unstable: bool,
}

impl Coupling {
    /// Adds a step of all ports. A carrier driven by speed has an empty step.
    pub fn add(&mut self, steps: &[PortStep; PORTS], cut: &Cut) {
        if !(steps[LEFT].h > 0.0 && steps.iter().all(PortStep::is_moderate)) {
            return;
        }
        if self.count == 0 {
            self.steps = steps.map(|step| [step; 4]);
        }
        let (before, index) = ((self.count.wrapping_sub(1) & 3) as usize, (self.count & 3) as usize);
        self.has_changed |=
            self.steps.iter().zip(steps).any(|(steps, step)| step.given != steps[before].given || step.is_line);
        self.steps.iter_mut().zip(steps).for_each(|(steps, step)| steps[index] = *step);
        self.count = self.count.wrapping_add(1);
        if self.has_changed && self.count > LAG as u64 {
            self.evaluate(cut);
        }
    }

    /// Adds the second of the last four steps to the sums.
    fn evaluate(&mut self, cut: &Cut) {
        let has_earlier = self.count > LAG as u64 + 1;
        // the oldest of the four steps is the one that the next step replaces
        let indices: [usize; 4] = std::array::from_fn(|k| (self.count as usize + k) & 3);
        let h = self.steps[LEFT][indices[3 - LAG]].h;
        let memory = self.ports.iter().fold(LEAST_STEPS * h, |longest, port| longest.max(port.oscillation.memory()));
        let decay = memory / (memory + h);
        self.weight = decay * self.weight + 1.0;
        for (k, (port, steps)) in self.ports.iter_mut().zip(&self.steps).enumerate() {
            let steps = indices.map(|index| &steps[index]);
            if steps[1].h > 0.0 {
                let error = SIGNS[k] * energy_difference(steps, cut.delay, has_earlier);
                port.add(steps, (error, cut.shafts[k].is_some()), [cut.delay, cut.lag()], decay);
            }
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

    /// Lower bound of the denominators of all ratios [J]. A port that passes almost nothing does not raise the ratio.
    fn least_passed(&self) -> f64 {
        LEAST_SHARE * self.ports.iter().map(|port| port.passed).sum::<f64>()
    }

    /// Largest ratio of a port: magnitude of its energy errors divided by the energy that passed.
    pub fn ratio(&self) -> f64 {
        let least = self.least_passed();
        self.ports.iter().fold(0.0, |largest, port| largest.max(port.ratio(least)))
    }

    /// Smallest advice of a port whose host reacts [s], and its meaning. The advice is the step at which the ratio
    /// would be
    /// `wanted`. It is at most the longest stable step, if this is known, and at most the present step, because one step
    /// size cannot show that a longer one is stable.
    pub fn advice(&self, wanted: f64, cut: &Cut) -> (f64, AdviceState) {
        let none = |state| (0.0, state);
        if !self.has_changed {
            return none(AdviceState::NoReaction);
        }
        let all = || (0..PORTS).filter(|&port| self.ports[port].reacts(EXPLAINED));
        let reacting = || all().filter(|&port| self.ports[port].moves());
        if reacting().next().is_none() {
            let moves = all().next().is_none() && self.ports.iter().any(Port::moves);
            return none(if moves { AdviceState::NoReaction } else { AdviceState::NothingMoves });
        }
        let (least, steps) = (self.least_passed(), self.stable_steps(cut));
        let by_ratio =
            reacting().map(|port| self.ports[port].step_of_ratio(wanted, least)).fold(f64::INFINITY, f64::min);
        let stable = reacting().map(|port| steps[port]).fold(f64::INFINITY, f64::min);
        if self.growth(cut).is_some_and(|growth| growth.is_unstable) {
            return (by_ratio.min(stable).min(0.5 * self.step()), AdviceState::UnstableCut);
        }
        if by_ratio.is_infinite() {
            return none(AdviceState::NotPossible);
        }
        (by_ratio.min(stable).min(self.step()), AdviceState::Given)
    }

    /// Longest stable step of each port [s]. Springs and dampers at several ports that move each other act together;
    /// the sum over the ports is an upper bound of their rates.
    fn stable_steps(&self, cut: &Cut) -> [f64; PORTS] {
        // torque drives the carrier and loads the sides
        let laws: [Law; PORTS] = std::array::from_fn(|port| self.ports[port].law(SIGNS[port]).unwrap_or_default());
        std::array::from_fn(|port| {
            let together = |of: fn(&Law) -> f64| -> f64 {
                laws.iter().zip(cut.mobility[port]).map(|(law, mobility)| mobility.abs() * of(law).max(0.0)).sum()
            };
            match cut.shafts[port] {
                Some(shaft) => self.ports[port].stable_step_of_speed(cut.lag(), shaft, &laws[port]),
                None => {
                    let rates = [together(|law| law.per_movement), together(|law| law.per_rate)];
                    self.ports[port].stable_step_of_torque(cut.lag(), rates)
                }
            }
        })
    }

    /// True if the values of `port` have grown for so long that its cut is unstable, if its host reacts.
    fn is_unstable(&self, port: &Port) -> bool {
        self.weight >= LEAST_WEIGHT && port.growths() >= GROWTHS
    }

    /// True if the ratio of `port` is high although its values oscillate. Steps that are far too long show no period,
    /// and soon end the run.
    fn is_high(&self, port: &Port) -> bool {
        let exceeds = |ratio: f64| port.errors > ratio * port.passed.max(self.least_passed());
        self.weight >= LEAST_WEIGHT && port.oscillation.has_period() && exceeds(HIGH)
            || self.weight >= FEW_STEPS && exceeds(EXTREME) && port.reacts(WITHOUT_DOUBT_EXPLAINED)
    }

    /// True if there may be a cause of a warning.
    #[inline]
    pub fn is_conspicuous(&self) -> bool {
        self.ports.iter().any(|port| self.is_unstable(port) || self.is_high(port))
    }

    /// Cause of a warning, if there is one: a swing at a port at which the host reacts grows by the cut, or its ratio
    /// is high although its values oscillate.
    pub fn growth(&self, cut: &Cut) -> Option<Growth> {
        if !self.is_conspicuous() {
            return None;
        }
        let reacting = || (0..PORTS).filter(|&port| self.ports[port].reacts(CERTAINLY_EXPLAINED));
        // all ports swing with the one that is unstable, which has the shortest stable step
        let stable = self.stable_steps(cut);
        let unstable = reacting().filter(|&port| self.is_unstable(&self.ports[port]));
        if let Some(port) = unstable.min_by(|&a, &b| stable[a].total_cmp(&stable[b])) {
            return Some(Growth { port, is_unstable: true });
        }
        let least = self.least_passed();
        let ratio = |port: usize| self.ports[port].ratio(least);
        let high = reacting().filter(|&port| self.is_high(&self.ports[port]));
        let port = high.max_by(|&a, &b| ratio(a).total_cmp(&ratio(b)))?;
        Some(Growth { port, is_unstable: false })
    }
}

impl Memory for Coupling {
    /// The record changes only with whole communication steps.
    type Checkpoint = ();

    fn checkpoint(&mut self) {}

    fn roll_back(&mut self, (): ()) {}

    fn is_valid(&self) -> bool {
        self.is_finite() && self.weight >= 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::sqrt;

    /// Record of a spring at the left side, of torque `sign` · 4 φ, which turns to and fro in steps of 1 ms.
    fn spring(sign: f64, is_line: bool) -> Coupling {
        let (mut coupling, mut angle) = (Coupling::default(), 0.0);
        for step in 0..200 {
            let moved = sign * (0.3 * f64::from(step)).sin();
            let left =
                PortStep { given: 4.0 * angle, mean: 4.0 * angle, moved, changed: 0.5 * moved, h: 1e-3, is_line };
            let right = PortStep { h: 1e-3, ..PortStep::default() };
            coupling.add(&[PortStep::default(), left, right], &Cut::default());
            angle += moved;
        }
        coupling
    }

    #[test]
    fn the_advice_scales_the_step_by_the_order_of_the_exchange() {
        let (wanted, cut) = (1e-3, Cut::default());
        let held = spring(1.0, false);
        assert!((held.advice(wanted, &cut).0 - 1e-3 * wanted / held.ratio()).abs() < 1e-15);
        let lines = spring(1.0, true);
        assert!((lines.advice(wanted, &cut).0 - 1e-3 * sqrt(wanted / lines.ratio())).abs() < 1e-15);
    }

    #[test]
    fn the_mirror_image_has_the_same_bits() {
        let [image, mirrored] = [1.0, -1.0].map(|sign| spring(sign, false));
        assert_eq!(image.errors(), mirrored.errors());
        let cut = Cut::default();
        assert_eq!([image.ratio(), image.advice(0.01, &cut).0], [mirrored.ratio(), mirrored.advice(0.01, &cut).0]);
    }

    #[test]
    fn values_that_are_not_finite_make_a_record_invalid() {
        assert!(spring(1.0, false).is_valid());
        assert!(!Coupling { weight: f64::NAN, ..spring(1.0, false) }.is_valid());
    }
}

//! The check that a motion repeats from one cycle to the next, without which its mean heats belong to no steady state.
//!
//! The first cycle settles what the start has shaken; the second and the third are compared. Mean speeds come from angles, so that
//! the ripple of teeth and shafts hardly counts: it moves an angle by less than [`RIPPLE`] at both ends of a cycle, while a constant
//! acceleration moves it by α L² from one cycle of length L to the next.

use super::Simulation;
use crate::model::setup::HEATS;
use crate::model::thermal::{NODES, Network, Thermal};

/// Shortest time over which means are compared [s]. Shorter cycles are repeated until they last as long.
const SHORTEST: f64 = 0.1;
/// Difference of the angles of two cycles that ripple may cause [rad].
const RIPPLE: f64 = 2e-3;
/// Difference of the mean speeds of two cycles, relative to the fastest shaft, that is no change.
const SAME_SPEED: f64 = 1e-4;
/// Difference of the mean heats of two cycles, relative to the larger one, that is no change.
const SAME_HEAT: f64 = 0.05;
/// Difference of the mean heats of two cycles that is no change, as the temperature of the case that it causes [K].
const SAME_TEMPERATURE: f64 = 0.1;
/// Outputs whose means are compared: speeds of carrier, left and right wheel [rad/s].
const SPEEDS: [&str; 3] = ["carrier.speed", "left.wheel_speed", "right.wheel_speed"];

impl Simulation {
    /// Describes what changes from one cycle of `length` [s] to the next at the temperatures `at` [K] and what to do. Returns `None`
    /// if the motion is periodic, or if it cannot be continued that long.
    #[inline(never)]
    pub(super) fn not_periodic(&self, network: &Network<HEATS>, at: &[f64; NODES], length: f64) -> Option<String> {
        let mut run = Box::new(self.clone());
        run.state.thermal = Thermal::at(*at);
        let (begin, span) = (self.time(), length * libm::ceil(SHORTEST / length).max(1.0));
        let mut ends = [([0.0; 3], 0.0); 3];
        for (number, end) in (1..).zip(&mut ends) {
            run.advance(begin + f64::from(number) * span).ok()?;
            let motion = run.motion();
            let [left, right] = motion.wheel_angle;
            *end = ([motion.carrier_angle, left, right], network.entering(&run.ledger().heat).iter().sum());
        }
        let means = |from: usize| {
            let [(begun_at, before), (ended_at, after)] = [ends[from], ends[from + 1]];
            let speeds: [f64; 3] = std::array::from_fn(|i| (ended_at[i] - begun_at[i]) / span);
            (speeds, (after - before) / span)
        };
        let [(speeds, heat), (next_speeds, next_heat)] = [means(0), means(1)];
        let fastest = speeds.iter().chain(&next_speeds).fold(0.0, |fastest, speed| speed.abs().max(fastest));
        let is_drifting = |i: &usize| (next_speeds[*i] - speeds[*i]).abs() > SAME_SPEED * fastest + RIPPLE / span;
        if let Some(i) = (0..SPEEDS.len()).find(is_drifting) {
            return Some(format!(
                "{} has a mean of {:.4} rad/s over {span} s and of {:.4} rad/s over the next {span} s; balance the torques of \
                 carrier and wheels, or impose speeds (scene.carrier_drive, scene.left_drive or scene.right_drive = speed)",
                SPEEDS[i], speeds[i], next_speeds[i]
            ));
        }
        let same = SAME_HEAT * heat.abs().max(next_heat.abs()) + SAME_TEMPERATURE * network.to_ambient.at(speeds[0].abs());
        ((next_heat - heat).abs() > same).then(|| {
            format!(
                "power.loss has a mean of {heat:.4e} W over {span} s and of {next_heat:.4e} W over the next {span} s; raise \
                 warm_up.cycle (now {length} s) to the period of the heat, or to many periods of the meshes"
            )
        })
    }
}

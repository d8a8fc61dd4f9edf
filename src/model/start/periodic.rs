//! Check that a motion repeats from one cycle to the next. Otherwise, its mean heat flows do not belong to a steady
//! state.
//!
//! The first cycle damps the transients of the start; the second and the third cycle are compared. Mean speeds follow
//! from angles, so that the ripple of teeth and shafts hardly matters. Ripple changes an angle by less than [`RIPPLE`]
//! at both ends of a cycle. A constant acceleration α changes it by α L² from one cycle of length L to the next.

use crate::model::run::Simulation;
use crate::model::setup::HEATS;
use crate::model::thermal::{NODES, Network, Thermal};

/// Shortest time over which means are compared [s]. Shorter cycles are repeated until they last as long.
const SHORTEST: f64 = 0.1;
/// Time over which means are compared if the motion cannot be continued for three cycles [s].
const BEFORE_FAILURE: f64 = 0.01;
/// Difference of the angles of two cycles that ripple may cause [rad].
const RIPPLE: f64 = 2e-3;
/// Difference of the mean speeds of two cycles that does not count as a change, relative to the fastest shaft.
const SAME_SPEED: f64 = 1e-4;
/// Difference of the mean heat flows of two cycles that does not count as a change, relative to the larger one.
const SAME_HEAT: f64 = 0.05;
/// Difference of the mean heat flows of two cycles that does not count as a change, expressed as the change of the case
/// temperature that it causes [K].
const SAME_TEMPERATURE: f64 = 0.1;
/// Outputs whose means are compared: speeds of carrier, left and right wheel [rad/s].
const SPEEDS: [&str; 3] = ["carrier.speed", "left.wheel_speed", "right.wheel_speed"];

/// Means over a cycle and over the next one.
struct Means {
    /// Duration of each cycle [s].
    span: f64,
    /// Speeds named by [`SPEEDS`] [rad/s].
    speeds: [[f64; 3]; 2],
    /// Heat flow into the nodes [W].
    heat: [f64; 2],
}

impl Simulation {
    /// Describes the change from one cycle of `length` [s] to the next at the temperatures `at` [K], with a remedy.
    /// Returns `None` if the motion is periodic.
    pub(super) fn not_periodic(&self, network: &Network<HEATS>, at: &[f64; NODES], length: f64) -> Option<String> {
        let span = length * libm::ceil(SHORTEST / length).max(1.0);
        let Some(means) = self.means(network, at, span) else { return self.runs_away(network, at) };
        means.changing_speed().or_else(|| {
            let (span, [heat, next]) = (means.span, means.heat);
            let same = SAME_HEAT * heat.abs().max(next.abs())
                + SAME_TEMPERATURE * network.to_ambient.at(means.speeds[0][0].abs());
            ((next - heat).abs() > same).then(|| {
                format!(
                    "power.loss has a mean of {heat:.4e} W over {span} s and of {next:.4e} W over the next {span} s; raise \
                     warm_up.cycle (now {length} s) to the period of the heat, or to many periods of the meshes"
                )
            })
        })
    }

    /// Describes a speed that changes right after the start at the temperatures `at` [K], with a remedy. This is for
    /// motions whose cycles cannot be run. Returns `None` if no speed changes, or if even a short motion fails.
    pub(super) fn runs_away(&self, network: &Network<HEATS>, at: &[f64; NODES]) -> Option<String> {
        self.means(network, at, BEFORE_FAILURE)?.changing_speed()
    }

    /// Means over the second and the third of three spans [s], or `None` if the motion cannot be continued that long.
    #[inline(never)]
    fn means(&self, network: &Network<HEATS>, at: &[f64; NODES], span: f64) -> Option<Means> {
        let mut run = Box::new(self.clone());
        run.state.sums.thermal = Thermal::at(*at);
        let begin = self.time();
        let mut ends = [([0.0; 3], 0.0); 3];
        for (number, end) in (1..).zip(&mut ends) {
            run.advance(begin + f64::from(number) * span).ok()?;
            let motion = run.motion();
            let [left, right] = motion.wheel_angle;
            *end = ([motion.carrier_angle, left, right], network.entering(&run.ledger().heat).iter().sum());
        }
        let speed = |from: usize| std::array::from_fn(|i| (ends[from + 1].0[i] - ends[from].0[i]) / span);
        let heat = |from: usize| (ends[from + 1].1 - ends[from].1) / span;
        Some(Means { span, speeds: [speed(0), speed(1)], heat: [heat(0), heat(1)] })
    }
}

impl Means {
    /// Describes the first speed that changes, with a remedy. Returns `None` if no speed changes.
    fn changing_speed(&self) -> Option<String> {
        let (span, [speeds, next]) = (self.span, self.speeds);
        let fastest = speeds.iter().chain(&next).fold(0.0, |fastest, speed| speed.abs().max(fastest));
        let changes = |i: &usize| (next[*i] - speeds[*i]).abs() > SAME_SPEED * fastest + RIPPLE / span;
        let i = (0..SPEEDS.len()).find(changes)?;
        Some(format!(
            "{} has a mean of {:.4} rad/s over {span} s and of {:.4} rad/s over the next {span} s; balance the torques of carrier \
             and wheels, or impose speeds (scene.carrier_drive, scene.left_drive or scene.right_drive = speed)",
            SPEEDS[i], speeds[i], next[i]
        ))
    }
}

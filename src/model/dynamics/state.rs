//! State of a simulation: all that changes during a run, except the damage of teeth and values over mesh cycles
//! (`Memories`). The state is small and `Copy`, so that a snapshot is an assignment.

use serde::{Deserialize, Serialize};

use super::acting_inputs::ActingInputs;
use super::event::Events;
use super::pending_step::PendingStep;
use super::rattle::Rattle;
use super::sums::Sums;
use super::timeline::Timeline;
use crate::integrate::{Control, Point, Statistics};
use crate::model::assembly::{BodyEffects, Teeth};
use crate::model::effect_kinds::FrictionState;
use crate::model::scene::{Dogs, Inputs, Layout, MAX_DOF, PAIRS, PLANET, RubbingPair};
use crate::numeric::Finite;

/// Number of periods above which a double no longer resolves a single period.
const MOST_PERIODS: u64 = 1 << 53;

/// State of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Present time, and times at which something happens.
    pub timeline: Timeline,
    /// Positions [rad; seats m]. Angles of gears are wrapped into a tooth pitch, the carrier's angle into a turn.
    pub q: [f64; MAX_DOF],
    /// Velocities [rad/s; seats m/s].
    pub v: [f64; MAX_DOF],
    /// Number of whole periods removed from each position: tooth pitches for gears, turns for the carrier.
    pub whole_periods: [i64; MAX_DOF],
    /// Step-size control.
    pub control: Control,
    /// Solver statistics.
    pub statistics: Statistics,
    /// Impacts of flanks, and the steps spent on them.
    pub rattle: Rattle,
    /// Sums to which completed steps add.
    pub sums: Sums,
    /// State of the dry friction, by the number of the pair.
    pub friction: [FrictionState; PAIRS],
    /// True if the tooth of the tooth fault is broken.
    pub is_tooth_broken: bool,
    /// Lock command that acted in the last step, from 0 to 1.
    pub lock: f64,
    /// State of the dog clutches.
    pub dogs: Dogs,
    /// Inputs that act.
    pub inputs: ActingInputs,
    /// Kinetic and elastic energy at the start [J].
    pub energy_at_start: f64,
    /// Step of the integrator that contains the present. Work, heat, friction and damage are still the values at the
    /// start of this step.
    pub pending_step: Option<PendingStep>,
    /// Last events.
    pub events: Events,
}

impl State {
    /// State at rest at `time` [s] with all quantities zero; `first_step` is the first step size [s].
    pub fn at_rest(time: f64, first_step: f64) -> Self {
        Self {
            timeline: Timeline::new(time),
            q: [0.0; MAX_DOF],
            v: [0.0; MAX_DOF],
            whole_periods: [0; MAX_DOF],
            control: Control::new(first_step),
            statistics: Statistics::default(),
            rattle: Rattle::default(),
            sums: Sums::default(),
            friction: [FrictionState::default(); PAIRS],
            is_tooth_broken: false,
            lock: 0.0,
            dogs: Dogs::default(),
            inputs: ActingInputs { values: Inputs::ZERO, derivatives: None, actuated: None },
            energy_at_start: 0.0,
            pending_step: None,
            events: Events::default(),
        }
    }

    /// Time [s].
    #[inline]
    pub fn time(&self) -> f64 {
        self.timeline.now
    }

    /// Returns a copy with another time [s], other positions and other velocities.
    pub fn elsewhere(&self, time: f64, q: [f64; MAX_DOF], v: [f64; MAX_DOF]) -> Self {
        Self { timeline: Timeline { now: time, ..self.timeline }, q, v, ..*self }
    }

    /// Moves the first `n` degrees of freedom to `until` [s] if the pending step contains this time. If the motion
    /// `pauses` there, `until` precedes the next communication point. Returns true if the state moved.
    #[inline]
    pub fn move_within(&mut self, until: f64, pauses: bool, n: usize) -> bool {
        let Some(pending_step) = &mut self.pending_step else { return false };
        let last = self.timeline.last_communication_point(&pending_step.clock);
        let now = last.clock + (until - last.time);
        if now > pending_step.end() {
            return false;
        }
        pending_step.clock.now = now;
        (self.timeline.now, self.timeline.pause) = (until, pauses.then_some(last));
        pending_step.write_motion(n, [&mut self.q, &mut self.v]);
        true
    }

    /// First `N` degrees of freedom, or all if there are fewer.
    pub fn point<const N: usize>(&self) -> Point<N> {
        Point::of([&self.q, &self.v])
    }

    /// Sets the first `N` degrees of freedom, or all if there are fewer.
    pub fn set_point<const N: usize>(&mut self, point: &Point<N>) {
        point.write([&mut self.q, &mut self.v]);
    }

    /// True if all planets of `layout` move identically and only plain teeth act on them. Then `teeth`, with all
    /// planets in one group, gives the same motion.
    pub fn planets_move_alike(&self, teeth: &Teeth, layout: &Layout) -> bool {
        let alike = |i: usize| {
            self.q[i] == self.q[PLANET]
                && self.v[i] == self.v[PLANET]
                && self.whole_periods[i] == self.whole_periods[PLANET]
        };
        !teeth.effect_terms.body_effects.act_in(self) && (PLANET + 1..PLANET + layout.groups).all(alike)
    }

    /// Copies the motion of the first planet to the other planets of `layout`.
    pub fn let_others_follow(&mut self, layout: &Layout) {
        for i in PLANET + 1..PLANET + layout.groups {
            (self.q[i], self.v[i]) = (self.q[PLANET], self.v[PLANET]);
            if let Some(pending_step) = &mut self.pending_step {
                pending_step.let_follow(i, PLANET);
            }
        }
    }

    /// Moves whole periods of each position into a counter, and shifts the anchors of dry friction on these `pairs`
    /// together with their bodies.
    pub fn wrap(&mut self, periods: &[f64; MAX_DOF], pairs: &[Option<RubbingPair>; PAIRS]) {
        for (i, period) in periods.iter().enumerate() {
            // the usual case
            if self.q[i].abs() < *period {
                continue;
            }
            let count = libm::rint(self.q[i] / period);
            if count != 0.0 {
                self.q[i] -= count * period;
                self.whole_periods[i] = self.whole_periods[i].saturating_add(count as i64);
                self.move_anchors(i, count * period, pairs);
            }
        }
    }

    /// Shifts the anchors of all friction whose slip depends on degree of freedom `i`.
    fn move_anchors(&mut self, i: usize, by: f64, pairs: &[Option<RubbingPair>; PAIRS]) {
        for pair in pairs.iter().flatten() {
            let moved = pair.position().iter().filter(|(of, _)| *of == i).map(|(_, factor)| factor * by);
            self.friction[pair.number].anchor -= moved.sum::<f64>();
        }
    }

    /// Position `i`, including its whole periods.
    pub fn position(&self, i: usize, periods: &[f64; MAX_DOF]) -> f64 {
        let count = self.whole_periods[i];
        if count == 0 { self.q[i] } else { self.q[i] + count as f64 * periods[i] }
    }

    /// True if the motion of ideal gears is finite: side gears, carrier, first planet and work.
    pub fn is_motion_finite(&self) -> bool {
        // a sum is not finite if a term is not
        let sum = |x: &[f64]| x.iter().sum::<f64>();
        (sum(&self.q[..PLANET + 1]) + sum(&self.v[..PLANET + 1]) + self.sums.work).is_finite()
    }

    /// True if a simulation can continue from this state: all numbers, including those of the pending step, are finite
    /// and within their ranges.
    pub fn is_valid(&self) -> bool {
        self.is_valid_without_pending_step()
            && self.pending_step.as_ref().is_none_or(PendingStep::is_valid)
            && self.control.after_discontinuity.is_valid()
            && self.events.is_finite()
            && self.timeline.pause.is_finite()
            && self.inputs.is_finite()
    }

    /// True if all numbers are valid. Pending step, events, pause and values of the inputs are not checked. This
    /// suffices after an integration, because its pending step has passed the error test.
    pub fn is_valid_without_pending_step(&self) -> bool {
        let Self {
            timeline,
            q,
            v,
            whole_periods,
            control,
            statistics: _,
            rattle: _,
            sums,
            friction,
            is_tooth_broken: _,
            lock,
            dogs,
            inputs,
            energy_at_start,
            pending_step: _,
            events: _,
        } = self;
        timeline.is_valid()
            && sums.is_valid()
            && Finite::is_finite(energy_at_start)
            && [q, v].into_iter().all(Finite::is_finite)
            && friction.is_finite()
            && friction.iter().all(|body| body.stiffness >= 0.0)
            && dogs.is_finite()
            && inputs.derivatives.is_finite()
            && inputs.actuated.is_finite()
            && whole_periods.iter().all(|count| count.unsigned_abs() < MOST_PERIODS)
            && (0.0..=1.0).contains(lock)
            && control.is_valid()
    }
}

impl BodyEffects {
    /// True if more than plain teeth acts in `state`: effects of the scene, a broken tooth, a lock that is commanded or
    /// still holds.
    pub fn act_in(&self, state: &State) -> bool {
        self.has_effects || state.is_tooth_broken || self.may_have_dry_friction(state)
    }

    /// True if the forces of ideal gears have a closed form in `state`: no effect acts on bodies, and inputs are
    /// constant.
    pub fn have_closed_form(&self, state: &State) -> bool {
        !self.act_in(state) && state.inputs.derivatives.is_none()
    }

    /// True if there may be dry friction in `state`: sources of the scene, a lock that is commanded, or friction that
    /// still holds.
    pub fn may_have_dry_friction(&self, state: &State) -> bool {
        self.has_friction || state.lock > 0.0 || state.friction.iter().any(|friction| friction.stiffness > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::dynamics::event::Happening;
    use crate::model::dynamics::timeline::CommunicationPoint;

    #[test]
    fn the_anchor_of_a_pair_moves_with_each_body_on_which_its_slip_depends() {
        let pair = |number, position: &[_]| Some(RubbingPair::new(number, (0, None), position, 1.0));
        let mut pairs = [None; PAIRS];
        (pairs[0], pairs[6]) = (pair(0, &[(0, 1.0)]), pair(6, &[(2, 1.0), (0, 1.0), (5, -1.0)]));
        for (moved, anchors) in [(0, [-2.0, -2.0]), (1, [0.0; 2]), (2, [0.0, -2.0]), (5, [0.0, 2.0])] {
            let mut state = State::at_rest(0.0, 1e-3);
            state.move_anchors(moved, 2.0, &pairs);
            assert_eq!([0, 6].map(|number| state.friction[number].anchor), anchors, "degree of freedom {moved}");
        }
    }

    #[test]
    fn a_state_whose_friction_or_mean_torques_are_not_finite_is_invalid() {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut states = [State::at_rest(0.0, 1e-3); 5];
            states[0].friction[2].stiffness = bad;
            states[1].friction[2].stiffness = -1.0;
            states[2].friction[0].anchor = bad;
            states[3].sums.torque_means.sum[1] = bad;
            states[4].sums.torque_means.last = Some(([0.0, bad], 1.0));
            assert!(states.iter().all(|state| !state.is_valid()), "{bad}");
        }
    }

    #[test]
    fn a_state_whose_events_pause_or_inputs_are_not_finite_is_invalid() {
        let mut good = State::at_rest(0.0, 1e-3);
        good.timeline.pause = Some(CommunicationPoint { clock: 0.0, time: 0.0 });
        assert!(good.is_valid());
        for bad in [f64::NAN, f64::INFINITY] {
            let mut states = [good; 4];
            states[0].events.record(Happening::ToothBreaks, 0, bad);
            states[0].events.record(Happening::ToothBreaks, 0, 0.0);
            states[1].timeline.pause = Some(CommunicationPoint { clock: 0.0, time: bad });
            states[2].timeline.pause = Some(CommunicationPoint { clock: bad, time: 0.0 });
            states[3].inputs.values.planet_spin = bad;
            assert!(states.iter().all(|state| !state.is_valid()), "{bad}");
        }
    }
}

//! Dry friction that sticks: a spring while a body is held, a limit torque while it slides.
//!
//! While stuck T = k (z + τ ω) with the rotation z since the body stopped, while sliding T = ±T_max (P. R. Dahl's and
//! Jenkins' element: a spring in series with a Coulomb slider). The rotation z is a position of the model less an anchor,
//! so that sticking adds no state and a constant load is held without creep. While sliding the spring drags the anchor
//! along, step by step, so that a body stops with the torque that the spring has then, never with more. The integrator
//! ends a step at each transition; the energy that the spring loses there is heat.

use super::body_friction::BodyFriction;
use super::{FrictionPart, FrictionSource, FrictionState, Mode, Slip, SurfaceLoad};
use crate::numeric::TAU;

/// Damping of the spring over its stiffness τ, where the source gives none [s].
pub const DAMPING_TIME: f64 = 1e-4;
/// How closely a step ends at the limit torque, relative to it.
const LIMIT_TOLERANCE: f64 = 1e-5;
/// How closely a step ends at zero speed [rad/s]. The error norm resolves speeds of bodies that stop to the same value: its
/// floor is 1 rad/s, and the start value of the tolerance is 1e-6.
pub const SPEED_TOLERANCE: f64 = 1e-6;
/// Largest torque of the damping when a body begins to stick, relative to the limit torque: beyond the limit, the body would
/// slide again at once. Weak and stiff friction stops at lower speeds than [`SPEED_TOLERANCE`] for this reason.
const DAMPED_SHARE: f64 = 0.5;
/// Least limit torque that holds a body [N·m]. A spring of 1e5 N·m/rad has this torque at a twist of 1e-14 rad, which is the
/// rounding of angles; stiffer springs have more, see [`DryFriction::torque_resolution`].
const NOTHING: f64 = 1e-9;
/// Rounding of the position of a body, relative to it: half a unit in the last place for each of the angles of carrier, side gear
/// and half-shaft, and for their sum.
const ROUNDING: f64 = 2.0 * f64::EPSILON;
/// Torque beyond the limit at which a body that stands still begins to slide, as a fraction of the tolerance. Steps end at half
/// the tolerance.
const STANDING: f64 = 0.25;
/// Parts of a step within which a switch is looked for.
const FRACTIONS: (f64, f64) = (1e-3, 0.999);
/// Friction on a body: its parts, and the sources that know how they slide.
#[derive(Clone, Copy, Debug)]
pub struct DryFriction<'a> {
    of: &'a BodyFriction,
    sources: &'a [FrictionSource],
}

impl<'a> DryFriction<'a> {
    /// Friction `of` a body from `sources`.
    #[inline]
    pub fn new(of: &'a BodyFriction, sources: &'a [FrictionSource]) -> Self {
        Self { of, sources }
    }

    /// Whether there is any source.
    #[inline]
    pub fn is_on(&self) -> bool {
        self.of.is_on()
    }

    fn parts(&self) -> impl Iterator<Item = (&'a FrictionPart, &'a FrictionSource)> + use<'a> {
        let sources = self.sources;
        self.of.parts().iter().map(move |part| (part, &sources[usize::from(part.source)]))
    }

    /// Limit torque of a body that slides at `speed` in its direction [N·m], and its slope by speed.
    #[inline]
    pub fn sliding_limit(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if self.of.feels_slip { self.limit_at(speed, by) } else { [self.of.limit(by), 0.0] }
    }

    /// The same of friction that changes with slip: apart, as other friction has no need of it.
    #[inline(never)]
    fn limit_at(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        self.parts().fold([0.0; 2], |[torque, slope], (part, source)| {
            let [value, by_speed] = part.sliding(source, speed, by);
            [torque + value, slope + by_speed]
        })
    }

    /// Slopes of the same by thrust and load.
    #[inline]
    pub fn limit_slopes(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if self.of.feels_slip { self.limit_slopes_at(speed, by) } else { self.of.limit_slopes() }
    }

    #[inline(never)]
    fn limit_slopes_at(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        self.parts().fold([0.0; 2], |[t, l], (part, source)| {
            let [by_thrust, by_load] = part.slopes(source, speed, by);
            [t + by_thrust, l + by_load]
        })
    }

    fn breakaway(&self, by: &SurfaceLoad) -> f64 {
        self.parts().map(|(part, source)| source.static_ratio * part.at(by)).sum()
    }

    /// Torque against the motion.
    pub fn torque(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        match state.mode {
            Mode::Stuck => state.stiffness * (slip.position - state.anchor + self.of.damping_time * slip.speed),
            mode => mode.direction() * self.sliding_limit(mode.direction() * slip.speed, by)[0],
        }
    }

    /// Slopes of the torque by position and speed; those by loads are [`Self::limit_slopes`].
    pub fn torque_slopes(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> [f64; 2] {
        match state.mode {
            Mode::Stuck => [state.stiffness, self.of.damping_time * state.stiffness],
            mode => [0.0, self.sliding_limit(mode.direction() * slip.speed, by)[1]],
        }
    }

    /// Torque against the motion; adds its heat to the causes, `count` bodies alike.
    pub fn act(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad, count: f64, heat: &mut [f64]) -> f64 {
        if state.mode == Mode::Stuck {
            let power = state.stiffness * self.of.damping_time * slip.speed * slip.speed;
            self.add_heat(count * power, by, heat);
            return self.torque(state, slip, by);
        }
        let direction = state.mode.direction();
        let slides = (direction * slip.speed, count * direction * slip.speed);
        direction * if self.of.feels_slip { self.rub_at(slides, by, heat) } else { self.of.rub(slides.1, by, heat) }
    }

    /// Limit torque of a body that slides at `speed`; adds its heat, `sliding` times the torque of each part, to the causes.
    #[inline(never)]
    fn rub_at(&self, (speed, sliding): (f64, f64), by: &SurfaceLoad, heat: &mut [f64]) -> f64 {
        self.parts().fold(0.0, |limit, (part, source)| {
            let [torque, _] = part.sliding(source, speed, by);
            heat[part.heat_index] += sliding * torque;
            limit + torque
        })
    }

    /// Returns true if the loads decide whether a switch is due, or to which state: while stuck, and once the speed of sliding
    /// has reached zero.
    pub fn awaits_load(&self, state: &FrictionState, slip: &Slip) -> bool {
        state.mode.direction() * slip.speed <= 0.0
    }

    /// Shares `amount` out to the causes in proportion to their limit torques.
    fn add_heat(&self, amount: f64, by: &SurfaceLoad, heat: &mut [f64]) {
        let whole = self.of.limit(by);
        for part in self.of.parts() {
            let share = if whole > 0.0 { part.at(by) / whole } else { 1.0 / self.of.parts().len() as f64 };
            heat[part.heat_index] += amount * share;
        }
    }

    /// Energy in the spring [J].
    pub fn energy(&self, state: &FrictionState, position: f64) -> f64 {
        let z = position - state.anchor;
        if state.mode == Mode::Stuck { 0.5 * state.stiffness * z * z } else { 0.0 }
    }

    /// Torque of the spring that rounding of the position produces [N·m]. The angles of which the position is the sum are up
    /// to a turn large, even if the position is small.
    fn torque_resolution(&self, slip: &Slip) -> f64 {
        NOTHING.max(self.of.stiffness * ROUNDING * slip.position.abs().max(TAU))
    }

    /// Returns true if a body stands still. Then its torque decides whether it begins to slide, and not its speed. The torque of
    /// other friction than a commanded one changes with the motion itself, so its bodies stand at a speed of exactly zero only.
    fn stands(&self, slip: &Slip) -> bool {
        slip.speed == 0.0 || self.of.commanded && slip.speed.abs() < SPEED_TOLERANCE
    }

    /// Torque of a held body beyond its limit, in the direction in which it would slide [N·m].
    fn excess(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        let torque = self.torque(state, slip, by);
        // a spring past its limit that is being unwound is cut back, it does not slide; a body that stands still when
        // its limit is lowered slides to where it is driven
        let sense = if self.stands(slip) { torque } else { slip.speed };
        torque * sense.signum() - self.breakaway(by)
    }

    /// How closely a step ends at zero speed under the loads `by` [rad/s].
    fn speed_tolerance(&self, by: &SurfaceLoad) -> f64 {
        let damping = self.of.stiffness * self.of.damping_time;
        SPEED_TOLERANCE.min(DAMPED_SHARE * self.breakaway(by) / damping)
    }

    /// Distance past the switch, as a fraction of the tolerance: negative before it, above 1 too far.
    fn overshoot(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        match state.mode {
            Mode::Stuck => {
                let limit = self.breakaway(by);
                self.excess(state, slip, by) / (LIMIT_TOLERANCE * limit + self.torque_resolution(slip))
            }
            mode => -mode.direction() * slip.speed / self.speed_tolerance(by),
        }
    }

    /// The fraction of a step after which it ends on a switch; `None` if there is no switch or it is near enough.
    pub fn crossing(
        &self,
        state: &FrictionState,
        start: (&Slip, &SurfaceLoad),
        end: (&Slip, &SurfaceLoad),
    ) -> Option<f64> {
        if self.of.commanded && state.mode == Mode::Stuck {
            return self.crossing_of_command(state, start, end);
        }
        if !self.awaits_load(state, end.0) || self.of.limit(end.1) <= self.torque_resolution(end.0) {
            return None;
        }
        let after = self.overshoot(state, end.0, end.1);
        if after <= 1.0 {
            return None;
        }
        // aim at the middle of the tolerance; that of a sliding body is the tolerance under the loads at the end
        let by = if state.mode == Mode::Stuck { start.1 } else { end.1 };
        let before = self.overshoot(state, start.0, by).min(0.0);
        Some(((0.5 - before) / (after - before)).clamp(FRACTIONS.0, FRACTIONS.1))
    }

    /// The same of a held body whose limit is a command: it may fall within the step, even to nothing.
    fn crossing_of_command(
        &self,
        state: &FrictionState,
        start: (&Slip, &SurfaceLoad),
        end: (&Slip, &SurfaceLoad),
    ) -> Option<f64> {
        let limit = self.breakaway(start.1).max(self.breakaway(end.1));
        let tolerance = LIMIT_TOLERANCE * limit + self.torque_resolution(end.0);
        let [before, after] = [start, end].map(|(slip, by)| self.excess(state, slip, by) / tolerance);
        let before = before.min(0.0);
        (after > 1.0).then(|| ((0.5 - before) / (after - before)).clamp(FRACTIONS.0, FRACTIONS.1))
    }

    /// The state after the switch that is due, if any. A sliding body that stands, where a host's event or a jump of an imposed
    /// speed may put it, sticks if it `stops`, that is, if nothing accelerates it further in the direction of sliding.
    fn switched(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad, stops: bool) -> FrictionState {
        let mut after = *state;
        let torque = self.torque(state, slip, by);
        let due = match state.mode {
            // a body that has just stopped may have the limit torque to the last bit
            Mode::Stuck => self.overshoot(state, slip, by) > if self.stands(slip) { STANDING } else { 0.0 },
            mode => mode.direction() * slip.speed < 0.0,
        };
        let holds = !self.of.commanded || self.breakaway(by) > self.torque_resolution(slip);
        let stops = stops && self.stands(slip) && slip.speed.abs() <= self.speed_tolerance(by);
        match state.mode {
            Mode::Stuck if due => after.mode = if torque > 0.0 { Mode::Forward } else { Mode::Backward },
            Mode::Stuck => {
                let z = slip.position - state.anchor;
                let most = self.breakaway(by) / self.of.stiffness;
                if z.abs() > most * (1.0 + LIMIT_TOLERANCE) + self.torque_resolution(slip) / self.of.stiffness {
                    after.anchor = slip.position - most * z.signum();
                }
            }
            _ if holds && (due || stops) => after.mode = Mode::Stuck,
            // a command of no torque holds nothing
            mode if due => after.mode = mode.reversed(),
            _ => {}
        }
        after
    }

    /// Returns true if a switch is due; see [`Self::switched`] for `stops`.
    pub fn is_due(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad, stops: bool) -> bool {
        self.switched(state, slip, by, stops) != *state
    }

    /// Switches if a switch is due; see [`Self::switched`] for `stops`. The energy that the springs of `count` bodies lose is heat.
    pub fn settle(
        &self,
        state: &mut FrictionState,
        (slip, by): (&Slip, &SurfaceLoad),
        stops: bool,
        count: f64,
        heat: &mut [f64],
    ) {
        let before = std::mem::replace(state, self.switched(state, slip, by, stops));
        if *state != before {
            let lost = self.energy(&before, slip.position) - self.energy(state, slip.position);
            self.add_heat(count * lost, by, heat);
        }
    }

    /// Anchor of a body that has slid to `position` [rad]: the spring, wound to the limit torque [N·m], drags it along.
    /// Where the limit rises faster than the motion winds the spring, the torque of the spring stays below it.
    pub fn drag(&self, anchor: f64, position: f64, limit: f64) -> f64 {
        let most = limit / self.of.stiffness;
        position - (position - anchor).max(-most).min(most)
    }

    /// Distance from the switch, positive before it: torque left while stuck [N·m], speed while sliding [rad/s].
    pub fn margin(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        match state.mode {
            Mode::Stuck => self.breakaway(by) - self.torque(state, slip, by).abs(),
            mode => mode.direction() * slip.speed,
        }
    }

    /// Adapts the state to this stiffness; on a body without friction before, it starts here.
    pub fn adapt(&self, state: &mut FrictionState, slip: &Slip, heat: &mut [f64], count: f64) {
        if state.stiffness == self.of.stiffness {
            return;
        }
        let wound = slip.position - state.anchor;
        let before = if state.mode == Mode::Stuck { 0.5 * state.stiffness * wound * wound } else { 0.0 };
        if self.of.stiffness > 0.0 {
            if state.stiffness == 0.0 {
                state.mode = match slip.speed {
                    v if v > SPEED_TOLERANCE => Mode::Forward,
                    v if v < -SPEED_TOLERANCE => Mode::Backward,
                    _ => Mode::Stuck,
                };
            }
            // a spring that becomes stiffer keeps its torque, one that becomes softer its twist: neither gains energy
            state.anchor = slip.position - wound * (state.stiffness / self.of.stiffness).min(1.0);
        } else {
            *state = FrictionState::default();
        }
        state.stiffness = self.of.stiffness;
        let cause = self.of.parts().first().map_or(self.of.released_heat_index, |part| part.heat_index);
        heat[cause] += count * (before - self.energy(state, slip.position));
    }
}

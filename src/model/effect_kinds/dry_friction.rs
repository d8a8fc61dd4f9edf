//! Dry friction that sticks: a spring while a body is held, a limit torque while it slides.
//!
//! While stuck T = k (z + τ ω) with the rotation z since the body stopped, while sliding T = ±T_max (P. R. Dahl's and
//! Jenkins' element: a spring in series with a Coulomb slider). The rotation z is a position of the model less an anchor,
//! so that sticking adds no state and a constant load is held without creep. While sliding the spring drags the anchor
//! along, step by step, so that a body stops with the torque that the spring has then, never with more. The integrator
//! ends a step at each transition; the energy that the spring loses there is heat.

use super::body_friction::BodyFriction;
use super::{FrictionPart, FrictionSource, FrictionState, Mode, Slip, SurfaceLoad};

/// Damping of the spring over its stiffness τ, where the source gives none [s].
pub const DAMPING_TIME: f64 = 1e-4;
/// How closely a step ends at the limit torque, relative to it.
const LIMIT_TOLERANCE: f64 = 1e-5;
/// How closely a step ends at zero speed [rad/s].
pub const SPEED_TOLERANCE: f64 = 1e-6;
/// Limit torque below which friction is none [N·m].
const NOTHING: f64 = 1e-9;
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

    /// Whether loads decide if a switch is due, or to what: while stuck, and once the speed of sliding has passed zero.
    pub fn awaits_load(&self, state: &FrictionState, slip: &Slip) -> bool {
        state.mode == Mode::Stuck || self.overshoot(state, slip, &SurfaceLoad::default()) > 0.0
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

    /// Torque of a held body beyond its limit, in the direction in which it would slide [N·m].
    fn excess(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        let torque = self.torque(state, slip, by);
        // a spring past its limit that is being unwound is cut back, it does not slide; a body that stands still when
        // its limit is lowered slides to where it is driven
        let stands = self.of.commanded && slip.speed.abs() < SPEED_TOLERANCE;
        let sense = if stands { torque } else { slip.speed };
        torque * sense.signum() - self.breakaway(by)
    }

    /// Distance past the switch, as a fraction of the tolerance: negative before it, above 1 too far.
    fn overshoot(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        match state.mode {
            Mode::Stuck => {
                let limit = self.breakaway(by);
                self.excess(state, slip, by) / (LIMIT_TOLERANCE * limit + NOTHING)
            }
            mode => {
                let direction = if mode == Mode::Forward { 1.0 } else { -1.0 };
                -direction * slip.speed / SPEED_TOLERANCE
            }
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
        let after = self.overshoot(state, end.0, end.1);
        if after <= 1.0 || self.of.limit(end.1) <= NOTHING {
            return None;
        }
        // aim at the middle of the tolerance
        let before = self.overshoot(state, start.0, start.1).min(0.0);
        Some(((0.5 - before) / (after - before)).clamp(FRACTIONS.0, FRACTIONS.1))
    }

    /// The same of a held body whose limit is a command: it may fall within the step, even to nothing.
    fn crossing_of_command(
        &self,
        state: &FrictionState,
        start: (&Slip, &SurfaceLoad),
        end: (&Slip, &SurfaceLoad),
    ) -> Option<f64> {
        let tolerance = LIMIT_TOLERANCE * self.breakaway(start.1).max(self.breakaway(end.1)) + NOTHING;
        let [before, after] = [start, end].map(|(slip, by)| self.excess(state, slip, by) / tolerance);
        let before = before.min(0.0);
        (after > 1.0).then(|| ((0.5 - before) / (after - before)).clamp(FRACTIONS.0, FRACTIONS.1))
    }

    /// The state after the switch that is due, if any.
    fn switched(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> FrictionState {
        let mut after = *state;
        let torque = self.torque(state, slip, by);
        let due = self.overshoot(state, slip, by) > 0.0;
        match state.mode {
            Mode::Stuck if due => after.mode = if torque > 0.0 { Mode::Forward } else { Mode::Backward },
            Mode::Stuck => {
                let z = slip.position - state.anchor;
                let most = self.breakaway(by) / self.of.stiffness;
                if z.abs() > most * (1.0 + LIMIT_TOLERANCE) + NOTHING / self.of.stiffness {
                    after.anchor = slip.position - most * z.signum();
                }
            }
            // a command of no torque holds nothing
            mode if due && self.of.commanded && self.breakaway(by) <= NOTHING => after.mode = mode.reversed(),
            _ if due => after.mode = Mode::Stuck,
            _ => {}
        }
        after
    }

    /// Whether a switch is due.
    pub fn is_due(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> bool {
        self.switched(state, slip, by) != *state
    }

    /// Switches where it is due; what the spring loses is heat of `count` bodies.
    pub fn settle(&self, state: &mut FrictionState, slip: &Slip, by: &SurfaceLoad, count: f64, heat: &mut [f64]) {
        let before = std::mem::replace(state, self.switched(state, slip, by));
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

//! Dry friction that sticks: a spring while a body is held, a limit torque while it slides.
//!
//! While stuck T = k (z + τ ω) with the rotation z since the body stopped, while sliding T = ±T_max (P. R. Dahl's and
//! Jenkins' element: a spring in series with a Coulomb slider). The rotation z is a position of the model less an anchor,
//! so that sticking adds no state and a constant load is held without creep. While sliding the spring drags the anchor
//! along, step by step, so that a body stops with the torque that the spring has then, never with more. The integrator
//! ends a step at each transition; the energy that the spring loses there is heat.

use super::{FrictionPart, FrictionState, Mode, Slip, SurfaceLoad};

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
/// Most parts of the friction on one body.
pub const PARTS: usize = 3;

/// Friction on one kind of body from all its sources.
#[derive(Clone, Copy, Debug)]
pub struct DryFriction {
    parts: [FrictionPart; PARTS],
    count: usize,
    /// Whether friction of any part changes with its slip.
    feels_slip: bool,
    /// Stiffness of all sources together [N·m/rad].
    pub stiffness: f64,
    damping_time: f64,
    /// Whether the limit torque is a command, which may fall while a body is held.
    commanded: bool,
    /// Index of the heat that the spring becomes when the last source is switched off.
    released_heat_index: usize,
}

impl DryFriction {
    /// No source.
    pub const NONE: Self = Self {
        parts: [FrictionPart::NONE; PARTS],
        count: 0,
        feels_slip: false,
        stiffness: 0.0,
        damping_time: 0.0,
        commanded: false,
        released_heat_index: 0,
    };

    /// No source yet; the energy that the spring loses when the last is switched off is heat `released_heat_index`.
    pub fn new(damping_time: f64, released_heat_index: usize) -> Self {
        Self { damping_time, released_heat_index, ..Self::NONE }
    }

    /// The same with a limit torque that is a command.
    pub fn commanded(damping_time: f64, released_heat_index: usize) -> Self {
        Self { commanded: true, ..Self::new(damping_time, released_heat_index) }
    }

    /// Adds a source, whose parts share a spring.
    pub fn push(&mut self, parts: &[FrictionPart], stiffness: f64) {
        if stiffness > 0.0 && self.count + parts.len() <= PARTS {
            self.parts[self.count..self.count + parts.len()].copy_from_slice(parts);
            self.count += parts.len();
            self.feels_slip |= parts.iter().any(FrictionPart::feels_slip);
            self.stiffness += stiffness;
        }
    }

    fn parts(&self) -> &[FrictionPart] {
        &self.parts[..self.count]
    }

    /// Whether there is any source.
    pub fn is_on(&self) -> bool {
        self.count > 0
    }

    /// Whether the limit torque depends on loads.
    pub fn depends_on_load(&self) -> bool {
        self.parts().iter().any(|p| p.per_thrust != 0.0 || p.per_load != 0.0)
    }

    /// Kinetic limit torque, as of a curve that does not depend on speed [N·m].
    pub fn limit(&self, by: &SurfaceLoad) -> f64 {
        self.parts().iter().map(|p| p.at(by)).sum()
    }

    /// Limit torque of a body that slides at `speed` in its direction [N·m], and its slope by speed.
    #[inline]
    pub fn sliding_limit(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if !self.feels_slip {
            return [self.limit(by), 0.0];
        }
        self.parts().iter().fold([0.0; 2], |[torque, slope], p| {
            let [value, by_speed] = p.sliding(speed, by);
            [torque + value, slope + by_speed]
        })
    }

    /// Slopes of the same by thrust and load.
    #[inline]
    pub fn limit_slopes(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if !self.feels_slip {
            return self.parts().iter().fold([0.0; 2], |[t, l], p| [t + p.per_thrust, l + p.per_load]);
        }
        self.parts().iter().fold([0.0; 2], |[t, l], p| {
            let [by_thrust, by_load] = p.slopes(speed, by);
            [t + by_thrust, l + by_load]
        })
    }

    fn breakaway(&self, by: &SurfaceLoad) -> f64 {
        self.parts().iter().map(|p| p.static_ratio * p.at(by)).sum()
    }

    /// Torque against the motion.
    pub fn torque(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        match state.mode {
            Mode::Stuck => state.stiffness * (slip.position - state.anchor + self.damping_time * slip.speed),
            mode => mode.direction() * self.sliding_limit(mode.direction() * slip.speed, by)[0],
        }
    }

    /// Slopes of the torque by position and speed; those by loads are [`Self::limit_slopes`].
    pub fn torque_slopes(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> [f64; 2] {
        match state.mode {
            Mode::Stuck => [state.stiffness, self.damping_time * state.stiffness],
            mode => [0.0, self.sliding_limit(mode.direction() * slip.speed, by)[1]],
        }
    }

    /// Torque against the motion; adds its heat to the causes, `count` bodies alike.
    pub fn act(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad, count: f64, heat: &mut [f64]) -> f64 {
        if state.mode == Mode::Stuck {
            let power = state.stiffness * self.damping_time * slip.speed * slip.speed;
            self.add_heat(count * power, by, heat);
            return self.torque(state, slip, by);
        }
        let (direction, mut limit) = (state.mode.direction(), 0.0);
        let sliding = count * direction * slip.speed;
        for part in self.parts() {
            let torque = if self.feels_slip { part.sliding(direction * slip.speed, by)[0] } else { part.at(by) };
            limit += torque;
            heat[part.heat_index] += sliding * torque;
        }
        direction * limit
    }

    /// Whether loads decide if a switch is due: of a body that slides, its speed does.
    pub fn awaits_load(&self, state: &FrictionState, slip: &Slip) -> bool {
        state.mode == Mode::Stuck || self.overshoot(state, slip, &SurfaceLoad::default()) > 0.0
    }

    /// Shares `amount` out to the causes in proportion to their limit torques.
    fn add_heat(&self, amount: f64, by: &SurfaceLoad, heat: &mut [f64]) {
        let whole = self.limit(by);
        for part in self.parts() {
            let share = if whole > 0.0 { part.at(by) / whole } else { 1.0 / self.count as f64 };
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
        let stands = self.commanded && slip.speed.abs() < SPEED_TOLERANCE;
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
        if self.commanded && state.mode == Mode::Stuck {
            return self.crossing_of_command(state, start, end);
        }
        let after = self.overshoot(state, end.0, end.1);
        if after <= 1.0 || self.limit(end.1) <= NOTHING {
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
                let most = self.breakaway(by) / self.stiffness;
                if z.abs() > most * (1.0 + LIMIT_TOLERANCE) + NOTHING / self.stiffness {
                    after.anchor = slip.position - most * z.signum();
                }
            }
            // a command of no torque holds nothing
            mode if due && self.commanded && self.breakaway(by) <= NOTHING => after.mode = mode.reversed(),
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
        let most = limit / self.stiffness;
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
        if state.stiffness == self.stiffness {
            return;
        }
        let wound = slip.position - state.anchor;
        let before = if state.mode == Mode::Stuck { 0.5 * state.stiffness * wound * wound } else { 0.0 };
        if self.stiffness > 0.0 {
            if state.stiffness == 0.0 {
                state.mode = match slip.speed {
                    v if v > SPEED_TOLERANCE => Mode::Forward,
                    v if v < -SPEED_TOLERANCE => Mode::Backward,
                    _ => Mode::Stuck,
                };
            }
            // a spring that becomes stiffer keeps its torque, one that becomes softer its twist: neither gains energy
            state.anchor = slip.position - wound * (state.stiffness / self.stiffness).min(1.0);
        } else {
            *state = FrictionState::default();
        }
        state.stiffness = self.stiffness;
        let cause = self.parts().first().map_or(self.released_heat_index, |p| p.heat_index);
        heat[cause] += count * (before - self.energy(state, slip.position));
    }
}

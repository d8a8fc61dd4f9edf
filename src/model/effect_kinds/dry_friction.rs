//! Dry friction with sticking: a spring while a body is held, a limit torque while it slides.
//!
//! While the body is stuck, T = k (z + τ ω) with the rotation z since it stopped. While it slides, T = ±T_max. This is
//! the element of P. R. Dahl and of Jenkins: a spring in series with a Coulomb slider. The rotation z is a position of
//! the model minus an anchor, so sticking adds no state, and a constant load is held without creep. While the body
//! slides, the spring drags the anchor along, step by step. A body therefore stops with the present torque of the
//! spring, never with more. The integrator ends a step at each transition. The energy that the spring loses at a
//! transition becomes heat.

use super::body_friction::BodyFriction;
use super::{ActingSurface, FrictionState, Mode, RubbingSurface, Slip, SurfaceLoad};
use crate::numeric::{TAU, quotient};

/// Damping of the spring over its stiffness τ if the surface gives none [s].
pub const DAMPING_TIME: f64 = 1e-4;
/// Tolerance of the limit torque at the end of a step, relative to the limit torque.
const LIMIT_TOLERANCE: f64 = 1e-5;
/// Tolerance of zero speed at the end of a step [rad/s]. The error norm resolves speeds of bodies that stop to the same
/// value: its floor is 1 rad/s, and the start value of the tolerance is 1e-6.
pub const SPEED_TOLERANCE: f64 = 1e-6;
/// Largest damping torque when a body begins to stick, relative to the limit torque. With a damping torque above the
/// limit, the body would slide again immediately. For weak and stiff friction, the speed tolerance is therefore smaller
/// than [`SPEED_TOLERANCE`].
const DAMPED_SHARE: f64 = 0.5;
/// Smallest limit torque that holds a body [N·m]. A spring of 1e5 N·m/rad has this torque at a twist of 1e-14 rad,
/// which is the rounding of angles. For stiffer springs the smallest torque is larger, see
/// [`DryFriction::torque_resolution`].
const NOTHING: f64 = 1e-9;
/// Relative rounding of the position of a body: half a unit in the last place for each of the angles of carrier, side
/// gear and half-shaft, and for their sum.
const ROUNDING: f64 = 2.0 * f64::EPSILON;
/// Torque beyond the limit at which a body at standstill begins to slide, as a fraction of the tolerance. Steps end at
/// half the tolerance.
const STANDSTILL_TOLERANCE: f64 = 0.25;
/// Range of step fractions within which a switch is located.
const FRACTIONS: (f64, f64) = (1e-3, 0.999);

/// Motion of a rubbing body at an instant, and the load of its surfaces.
#[derive(Clone, Copy, Debug)]
pub struct LoadedSlip<'a> {
    /// Motion.
    pub slip: &'a Slip,
    /// Load of the surfaces.
    pub load: &'a SurfaceLoad,
}

/// Friction on a body: its surfaces that act, and all surfaces with their laws of sliding.
#[derive(Clone, Copy, Debug)]
pub struct DryFriction<'a> {
    of: &'a BodyFriction,
    all: &'a [RubbingSurface],
}

impl<'a> DryFriction<'a> {
    /// Friction `of` a body, whose surfaces are among `all`.
    #[inline]
    pub fn new(of: &'a BodyFriction, all: &'a [RubbingSurface]) -> Self {
        Self { of, all }
    }

    /// True if any surface acts.
    #[inline]
    pub fn is_on(&self) -> bool {
        self.of.is_on()
    }

    /// Stiffness of the spring that holds the body [N·m/rad].
    pub fn stiffness(&self) -> f64 {
        self.of.stiffness
    }

    /// Index of the heat of its first surface.
    pub fn heat_index(&self) -> usize {
        self.of.surfaces().first().map_or(self.of.released_heat_index, |first| first.heat_index)
    }

    fn surfaces(&self) -> impl Iterator<Item = (&'a ActingSurface, &'a RubbingSurface)> + use<'a> {
        let all = self.all;
        self.of.surfaces().iter().map(move |acting| (acting, &all[usize::from(acting.surface)]))
    }

    /// Limit torque of a body that slides at `speed` [rad/s] in its direction [N·m], and the derivative with respect to
    /// speed.
    #[inline]
    pub fn sliding_limit(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if self.of.varies_with_slip { self.limit_at(speed, by) } else { [self.of.limit(by), 0.0] }
    }

    /// Evaluates [`Self::sliding_limit`] for friction that changes with slip. It is `inline(never)` to keep the code of
    /// other friction small.
    #[inline(never)]
    fn limit_at(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        self.surfaces().fold([0.0; 2], |[torque, slope], (acting, surface)| {
            let [value, by_speed] = acting.sliding(surface, speed, by);
            [torque + value, slope + by_speed]
        })
    }

    /// Derivatives of [`Self::sliding_limit`] with respect to thrust and load.
    #[inline]
    pub fn limit_slopes(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if self.of.varies_with_slip { self.limit_slopes_at(speed, by) } else { self.of.limit_slopes() }
    }

    #[inline(never)]
    fn limit_slopes_at(&self, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        self.surfaces().fold([0.0; 2], |[t, l], (acting, surface)| {
            let [by_thrust, by_load] = acting.slopes(surface, speed, by);
            [t + by_thrust, l + by_load]
        })
    }

    /// Limit torque of a held body: static ratio times kinetic limit torque, summed over all surfaces [N·m].
    pub fn breakaway(&self, by: &SurfaceLoad) -> f64 {
        self.surfaces().map(|(acting, surface)| acting.breakaway(surface, by)).sum()
    }

    /// Torque against the motion [N·m].
    pub fn torque(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        match state.mode {
            Mode::Stuck => state.stiffness * (slip.position - state.anchor + self.of.damping_time * slip.speed),
            mode => mode.direction() * self.sliding_limit(mode.direction() * slip.speed, by)[0],
        }
    }

    /// Derivatives of the torque with respect to position and speed. [`Self::limit_slopes`] returns the derivatives
    /// with respect to loads.
    pub fn torque_slopes(&self, state: &FrictionState, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        match state.mode {
            Mode::Stuck => [state.stiffness, self.of.damping_time * state.stiffness],
            mode => [0.0, self.sliding_limit(mode.direction() * speed, by)[1]],
        }
    }

    /// Returns the torque against the motion at `speed` [rad/s] and at a `position` [rad], which only a held body needs
    /// [N·m]. Adds the heat of `count` identical bodies to its causes.
    #[inline]
    pub fn act(
        &self,
        state: &FrictionState,
        (speed, position): (f64, impl FnOnce() -> f64),
        by: &SurfaceLoad,
        count: f64,
        heat: &mut [f64],
    ) -> f64 {
        if state.mode == Mode::Stuck {
            self.add_heat(count * state.stiffness * self.of.damping_time * speed * speed, by, heat);
            return self.torque(state, &Slip { position: position(), speed }, by);
        }
        let direction = state.mode.direction();
        let slides = (direction * speed, count * direction * speed);
        direction
            * if self.of.varies_with_slip {
                self.limit_with_heat_at(slides, by, heat)
            } else {
                self.of.limit_with_heat(slides.1, by, heat)
            }
    }

    /// Returns the limit torque of a body that slides at `speed` [rad/s]. Adds `sliding` times the torque of each
    /// surface to the heat of its cause.
    #[inline(never)]
    fn limit_with_heat_at(&self, (speed, sliding): (f64, f64), by: &SurfaceLoad, heat: &mut [f64]) -> f64 {
        self.surfaces().fold(0.0, |limit, (acting, surface)| {
            let [torque, _] = acting.sliding(surface, speed, by);
            heat[acting.heat_index] += sliding * torque;
            limit + torque
        })
    }

    /// Returns true if the loads decide on a switch or on the mode after it: while the body is stuck, and as soon as
    /// its sliding speed has reached zero.
    pub fn awaits_load(&self, state: &FrictionState, speed: f64) -> bool {
        state.mode.direction() * speed <= 0.0
    }

    /// Distributes the heat `amount` [J or W] to the causes in proportion to their limit torques.
    fn add_heat(&self, amount: f64, by: &SurfaceLoad, heat: &mut [f64]) {
        let whole = self.of.limit(by);
        for acting in self.of.surfaces() {
            let share = if whole > 0.0 { acting.limit.at(by) / whole } else { 1.0 / self.of.surfaces().len() as f64 };
            heat[acting.heat_index] += amount * share;
        }
    }

    /// Energy in the spring [J].
    pub fn energy(&self, state: &FrictionState, position: f64) -> f64 {
        let z = position - state.anchor;
        if state.mode == Mode::Stuck { 0.5 * state.stiffness * z * z } else { 0.0 }
    }

    /// Spring torque that corresponds to the rounding of the position [N·m]. The position is a sum of angles of up to
    /// one turn, so its rounding error does not shrink with it.
    fn torque_resolution(&self, slip: &Slip) -> f64 {
        NOTHING.max(self.of.stiffness * ROUNDING * slip.position.abs().max(TAU))
    }

    /// Returns true if a body is at standstill. The sign of its speed is then an error of the solver, so torques decide
    /// whether it slides.
    fn is_at_standstill(slip: &Slip) -> bool {
        slip.speed.abs() < SPEED_TOLERANCE
    }

    /// Torque of a held body beyond its limit, in the direction in which it would slide [N·m]. Damping torque counts only
    /// for the speed that the solver resolves: otherwise, its rounding would release a body that is held at its limit.
    fn excess(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        let unresolved = self.speed_tolerance(by);
        let speed = slip.speed - slip.speed.max(-unresolved).min(unresolved);
        let torque = self.torque(state, &Slip { speed, ..*slip }, by);
        // an overwound spring that is being unwound is shortened instead of released; a body at standstill slides in
        // the direction of its torque when its limit is lowered
        let sense = if Self::is_at_standstill(slip) { torque } else { slip.speed };
        torque * sense.signum() - self.breakaway(by)
    }

    /// Tolerance of zero speed at the end of a step under the loads `by` [rad/s].
    fn speed_tolerance(&self, by: &SurfaceLoad) -> f64 {
        let damping = self.of.stiffness * self.of.damping_time;
        quotient(DAMPED_SHARE * self.breakaway(by), damping).map_or(SPEED_TOLERANCE, |speed| SPEED_TOLERANCE.min(speed))
    }

    /// Distance past the switch, as a fraction of the tolerance: negative before the switch, above 1 too far beyond it.
    fn overshoot(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        match state.mode {
            Mode::Stuck => {
                let limit = self.breakaway(by);
                self.excess(state, slip, by) / (LIMIT_TOLERANCE * limit + self.torque_resolution(slip))
            }
            mode => -mode.direction() * slip.speed / self.speed_tolerance(by),
        }
    }

    /// Returns the fraction of a step at which it must end to meet a switch. Returns `None` without a switch, or if the
    /// step ends within its tolerance.
    pub fn crossing(&self, state: &FrictionState, start: LoadedSlip, end: LoadedSlip) -> Option<f64> {
        if self.of.commanded && state.mode == Mode::Stuck {
            return self.crossing_of_command(state, start, end);
        }
        if !self.awaits_load(state, end.slip.speed) || self.of.limit(end.load) <= self.torque_resolution(end.slip) {
            return None;
        }
        let after = self.overshoot(state, end.slip, end.load);
        if after <= 1.0 {
            return None;
        }
        // aim at the middle of the tolerance; the tolerance of a sliding body depends on the loads at the end
        let by = if state.mode == Mode::Stuck { start.load } else { end.load };
        let before = self.overshoot(state, start.slip, by);
        if after <= before {
            return None;
        }
        let before = before.min(0.0);
        Some(((0.5 - before) / (after - before)).clamp(FRACTIONS.0, FRACTIONS.1))
    }

    /// Evaluates [`Self::crossing`] for a held body whose limit is commanded. The limit may fall within the step, even
    /// to zero.
    fn crossing_of_command(&self, state: &FrictionState, start: LoadedSlip, end: LoadedSlip) -> Option<f64> {
        let limit = self.breakaway(start.load).max(self.breakaway(end.load));
        let tolerance = LIMIT_TOLERANCE * limit + self.torque_resolution(end.slip);
        let [before, after] = [start, end].map(|at| self.excess(state, at.slip, at.load) / tolerance);
        let before = before.min(0.0);
        (after > 1.0).then(|| ((0.5 - before) / (after - before)).clamp(FRACTIONS.0, FRACTIONS.1))
    }

    /// Returns the state after the switch that is due, if any. An event of the host or a jump of an imposed speed may
    /// bring a sliding body to standstill. The body then sticks if `stops` is true, that is, if nothing accelerates it
    /// further in the direction of sliding, and if the damping torque at its small speed does not release it immediately.
    fn switched(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad, stops: bool) -> FrictionState {
        let mut after = *state;
        let torque = self.torque(state, slip, by);
        let at_standstill = Self::is_at_standstill(slip);
        // a body that has just stopped may have exactly the limit torque
        let breaks_away = |stuck: &FrictionState| {
            self.overshoot(stuck, slip, by) > if at_standstill { STANDSTILL_TOLERANCE } else { 0.0 }
        };
        let due = match state.mode {
            Mode::Stuck => breaks_away(state),
            mode => mode.direction() * slip.speed < 0.0 && (stops || !at_standstill),
        };
        let holds = !self.of.commanded || self.breakaway(by) > self.torque_resolution(slip);
        let stops = stops && at_standstill && !breaks_away(&FrictionState { mode: Mode::Stuck, ..*state });
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
            // a commanded torque of zero holds nothing
            mode if due => after.mode = mode.reversed(),
            _ => {}
        }
        after
    }

    /// Returns true if a switch is due; see [`Self::switched`] for `stops`.
    pub fn is_due(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad, stops: bool) -> bool {
        self.switched(state, slip, by, stops) != *state
    }

    /// Switches if a switch is due; see [`Self::switched`] for `stops`. The energy that the springs of `count` bodies
    /// lose becomes heat.
    pub fn settle(
        &self,
        state: &mut FrictionState,
        LoadedSlip { slip, load: by }: LoadedSlip,
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

    /// Anchor of a body that has slid to `position` [rad]. The spring, wound to the limit torque `limit` [N·m], drags
    /// the anchor along. If the limit rises faster than the motion winds the spring, the spring torque stays below the
    /// limit.
    pub fn drag(&self, anchor: f64, position: f64, limit: f64) -> f64 {
        let most = limit / self.of.stiffness;
        position - (position - anchor).max(-most).min(most)
    }

    /// Distance to the switch, positive before it: the remaining torque while stuck [N·m], the speed while sliding
    /// [rad/s].
    pub fn margin(&self, state: &FrictionState, slip: &Slip, by: &SurfaceLoad) -> f64 {
        match state.mode {
            Mode::Stuck => self.breakaway(by) - self.torque(state, slip, by).abs(),
            mode => mode.direction() * slip.speed,
        }
    }

    /// Adapts the state to the present stiffness. If the body had no friction before, friction starts at its present
    /// position.
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
            // a spring that becomes stiffer keeps its torque, and one that becomes softer keeps its twist, so neither
            // gains energy
            state.anchor = slip.position - wound * (state.stiffness / self.of.stiffness).min(1.0);
        } else {
            *state = FrictionState::default();
        }
        state.stiffness = self.of.stiffness;
        heat[self.heat_index()] += count * (before - self.energy(state, slip.position));
    }
}

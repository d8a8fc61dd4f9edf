//! Inputs and dry friction, which act on gears with and without teeth.

use std::iter::Chain;
use std::ops::Range;

use super::State;
use super::ledger_rates::LedgerRates;
use crate::integrate::{Matrix, Point, TimedPoint};
use crate::model::assembly::BodyEffects;
use crate::model::effect_kinds::dry_friction::{DryFriction, LoadedSlip, SPEED_TOLERANCE};
use crate::model::effect_kinds::{BodyMotion, Friction, FrictionSource, FrictionState, Mode, Slip, SurfaceLoad};
use crate::model::scene::{
    CARRIER, FRICTION_BODIES, FRICTION_PLANETS, FRICTION_WHEELS, InputDerivatives, Inputs, Layout, Plan, Viscosity,
};
use crate::model::thermal::NODES;

/// Derivatives of forces, written in place.
pub struct Jacobian<'a, const N: usize> {
    /// ∂force/∂position.
    pub by_position: &'a mut Matrix<N>,
    /// ∂force/∂(rate of position).
    pub by_rate: &'a mut Matrix<N>,
    /// ∂force/∂velocity.
    pub by_velocity: &'a mut Matrix<N>,
}

/// Inputs and dry friction that act in the equations.
#[derive(Clone, Copy)]
pub struct InputsAndFriction {
    /// Inputs.
    pub inputs: Inputs,
    /// Derivatives of the inputs.
    pub input_derivatives: InputDerivatives,
    /// True if inputs change with time.
    pub driven: bool,
    /// Changes of the load torques, left and right, and of the carrier torque within the pending step [N·m].
    pub change: [f64; 3],
    /// State of the dry friction.
    pub friction_state: [FrictionState; FRICTION_BODIES],
    friction: Option<Friction>,
    /// True if there is any dry friction.
    pub has_dry_friction: bool,
    /// Viscosity of the oil, if an effect needs it.
    pub oil_viscosity: Option<Viscosity>,
}

impl InputsAndFriction {
    /// Inputs that act at `state`. Always inlined, so that this large value is written in place.
    #[inline(always)]
    pub fn without_friction(inputs: &Inputs, state: &State) -> Self {
        Self {
            inputs: Inputs { carrier_speed: state.carrier_command, ..*inputs },
            input_derivatives: state.inputs.derivatives.unwrap_or(InputDerivatives::ZERO),
            driven: state.inputs.derivatives.is_some(),
            change: [0.0; 3],
            friction_state: state.friction,
            friction: None,
            has_dry_friction: false,
            oil_viscosity: None,
        }
    }

    /// Adds the contribution of effects on bodies at `state`: dry friction, if there may be any, and the viscosity of
    /// the oil.
    pub fn add(&mut self, body_effects: &BodyEffects, state: &State) {
        self.oil_viscosity = body_effects.oil_viscosity(&state.thermal.used);
        if body_effects.may_have_dry_friction(state) {
            let at = (state.lock, &state.thermal.used);
            let friction = body_effects.friction(at, &self.inputs, &self.input_derivatives);
            self.has_dry_friction = friction.is_any();
            self.friction = Some(friction);
        }
    }

    /// True if dry friction neither acts nor holds anything.
    pub fn is_free(&self) -> bool {
        self.friction.is_none()
    }

    /// Updates dry friction and oil viscosity to other `temperatures` [K].
    pub fn update_temperatures(&mut self, body_effects: &BodyEffects, lock: f64, temperatures: &[f64; NODES]) {
        self.friction = Some(body_effects.friction((lock, temperatures), &self.inputs, &self.input_derivatives));
        self.oil_viscosity = body_effects.oil_viscosity(temperatures);
    }

    /// Anchors of the springs of dry friction.
    pub fn anchors(&self) -> [f64; FRICTION_BODIES] {
        self.friction_state.map(|state| state.anchor)
    }

    /// Sets the anchors of the springs of dry friction.
    pub fn set_anchors(&mut self, anchors: &[f64; FRICTION_BODIES]) {
        self.friction_state.iter_mut().zip(anchors).for_each(|(state, &anchor)| state.anchor = anchor);
    }

    /// Dry friction on all bodies.
    #[inline]
    pub fn friction(&self) -> &Friction {
        self.friction.as_ref().unwrap_or(&Friction::NONE)
    }
}

/// Bodies on which friction acts.
fn bodies_with_friction<const N: usize>(of: &(impl FrictionEquations<N> + ?Sized)) -> impl Iterator<Item = usize> {
    // a loop over the set bits of a mask needs few branches
    let mut left = of.applied().friction().mask(of.sticking().len());
    std::iter::from_fn(move || {
        let body = left.trailing_zeros();
        (left != 0).then(|| {
            left &= left - 1;
            body as usize
        })
    })
}

/// Equations of gears with or without teeth, as far as inputs and dry friction need them.
pub trait FrictionEquations<const N: usize> {
    /// Inputs and dry friction that act.
    fn applied(&self) -> &InputsAndFriction;
    /// Mutable inputs and dry friction.
    fn applied_mut(&mut self) -> &mut InputsAndFriction;
    /// Sources of the dry friction.
    fn friction_sources(&self) -> &[FrictionSource];
    /// Scene plan.
    fn plan(&self) -> &Plan;
    /// Index of each degree of freedom.
    fn layout(&self) -> &Layout;
    /// True if there is dry friction.
    fn has_dry_friction(&self) -> bool;
    /// True if half-shafts have ends.
    fn has_ends(&self) -> bool;
    /// Number of planets in each group that dry friction may hold on their pins. Empty for ideal gears, because their
    /// planets stick together with the side gears.
    fn sticking(&self) -> &[f64];
    /// Loads of the meshes on the surfaces of side gears and planets at `at`, if friction depends on them.
    fn mesh_loads(&self, at: &Point<N>) -> [SurfaceLoad; FRICTION_BODIES];
    /// Accelerations at `at`, `time` [s] after the inputs were set.
    fn acceleration_at(&self, at: &Point<N>, time: f64) -> [f64; N];
    /// Accelerations from inputs and effects. Forces that do not depend on inputs may be left out.
    fn acceleration_by_inputs(&self, at: &Point<N>) -> [f64; N];

    /// Returns the equations under other inputs.
    fn under(&self, inputs: &Inputs, input_derivatives: &InputDerivatives) -> Self
    where
        Self: Copy,
    {
        let mut these = *self;
        let applied = these.applied_mut();
        (applied.inputs, applied.input_derivatives) = (*inputs, *input_derivatives);
        these
    }

    /// Returns the equations with the inputs `time` [s] later.
    fn later(&self, time: f64) -> Self
    where
        Self: Copy,
    {
        let (inputs, input_derivatives) = self.applied().input_derivatives.after(time, &self.applied().inputs);
        self.under(&inputs, &input_derivatives)
    }

    /// Contribution of `inputs` and their derivatives to the accelerations, which are linear in both.
    fn input_accelerations(&self, at: &Point<N>, inputs: &Inputs, input_derivatives: &InputDerivatives) -> [f64; N]
    where
        Self: Copy,
    {
        let with = self.under(inputs, input_derivatives).acceleration_by_inputs(at);
        let without = self.under(&Inputs::ZERO, &InputDerivatives::ZERO).acceleration_by_inputs(at);
        std::array::from_fn(|i| with[i] - without[i])
    }

    /// Partial derivative of the accelerations with respect to time, `time` [s] after the inputs were set.
    fn drift_at(&self, at: &Point<N>, time: f64) -> [f64; N]
    where
        Self: Copy,
    {
        let [first, second] = self.later(time).applied().input_derivatives.rates;
        self.input_accelerations(at, &first, &InputDerivatives { rates: [second, Inputs::ZERO] })
    }

    /// Positions, velocities and inputs, as passed to effects.
    fn body_motion<'b>(&'b self, at: &'b Point<N>) -> BodyMotion<'b> {
        let InputsAndFriction { inputs, input_derivatives, oil_viscosity, .. } = self.applied();
        BodyMotion {
            q: &at.q,
            v: &at.v,
            layout: self.layout(),
            inputs,
            input_rates: &input_derivatives.rates[0],
            oil_viscosity: *oil_viscosity,
        }
    }

    /// Converts ledger rates at `at` to those before the torques changed.
    fn undo_input_change(&self, at: &Point<N>, ledger_rates: &mut LedgerRates) {
        let (InputsAndFriction { inputs, change, .. }, plan) = (self.applied(), self.plan());
        for s in (0..2).filter(|&s| !plan.side_imposed[s]) {
            ledger_rates.input += change[s] * at.v[self.wheel(s)];
            if self.has_ends() && !plan.shafts[s] {
                ledger_rates.shaft[s] = inputs.load_torque[s] - change[s];
            }
        }
        if !plan.carrier_imposed {
            ledger_rates.input -= change[2] * at.v[CARRIER];
        }
    }

    /// Degree of freedom of wheel `s`: the end of its half-shaft, or the side gear if the half-shaft is rigid.
    #[inline]
    fn wheel(&self, s: usize) -> usize {
        if self.has_ends() && self.plan().shafts[s] { self.layout().end(s) } else { s }
    }

    /// Numbers of the bodies that may stick: side gears, planet groups, wheels.
    fn bodies_that_stick(&self) -> Chain<Range<usize>, Range<usize>> {
        (0..FRICTION_PLANETS + self.sticking().len()).chain(FRICTION_WHEELS..FRICTION_BODIES)
    }

    /// Degree of freedom on which the friction of body `i` acts.
    fn freedom_of(&self, i: usize) -> usize {
        match i {
            0..FRICTION_PLANETS => i,
            FRICTION_PLANETS..FRICTION_WHEELS => self.layout().planet(i - FRICTION_PLANETS),
            _ => self.wheel(i - FRICTION_WHEELS),
        }
    }

    /// Motion of body `i` relative to the surface on which it rubs: carrier, pin, or ground.
    fn slip(&self, at: &Point<N>, i: usize) -> Slip {
        let body = self.freedom_of(i);
        match i {
            0..FRICTION_PLANETS => Slip { position: at.q[i], speed: at.v[i] - at.v[CARRIER] },
            FRICTION_PLANETS..FRICTION_WHEELS => Slip { position: at.q[body], speed: at.v[body] },
            _ => {
                let s = i - FRICTION_WHEELS;
                let twist = if body == s { 0.0 } else { at.q[body] };
                Slip { position: at.q[CARRIER] + at.q[s] - twist, speed: at.v[body] }
            }
        }
    }

    /// Friction on body `i`, its state, and the number of identical bodies.
    fn friction_on(&self, i: usize) -> (DryFriction<'_>, &FrictionState, f64) {
        let planets = FRICTION_PLANETS..FRICTION_WHEELS;
        let count = if planets.contains(&i) { self.sticking()[i - FRICTION_PLANETS] } else { 1.0 };
        let applied = self.applied();
        (DryFriction::new(applied.friction().on(i), self.friction_sources()), &applied.friction_state[i], count)
    }

    /// Loads on all rubbing surfaces at `at`, `time` [s] after the inputs were set.
    fn surface_loads(&self, at: &Point<N>, time: f64) -> [SurfaceLoad; FRICTION_BODIES] {
        let (mut all, applied) = (self.mesh_loads(at), self.applied());
        let wheels = if applied.driven && time > 0.0 {
            applied.friction().wheel_loads(&applied.input_derivatives.after(time, &applied.inputs).0)
        } else {
            applied.friction().wheel_loads(&applied.inputs)
        };
        all[FRICTION_WHEELS..].copy_from_slice(&wheels);
        all
    }

    /// Adds the torques and the heat of dry friction under the loads on its surfaces.
    fn add_friction_torques(
        &self,
        at: &Point<N>,
        surface_loads: &[SurfaceLoad; FRICTION_BODIES],
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) {
        for i in bodies_with_friction(self) {
            let (friction, state, count) = self.friction_on(i);
            let torque = friction.act(state, &self.slip(at, i), &surface_loads[i], count, &mut ledger_rates.heat);
            ledger_rates.limit[i] = torque * state.mode.direction();
            sum[self.freedom_of(i)] -= torque;
            if i < FRICTION_PLANETS {
                sum[CARRIER] += torque;
            }
        }
    }

    /// Adds the derivatives of dry friction with respect to the motion of its bodies, under the loads on its surfaces.
    fn friction_slopes(&self, at: &Point<N>, surface_loads: &[SurfaceLoad; FRICTION_BODIES], j: &mut Jacobian<'_, N>) {
        for i in bodies_with_friction(self) {
            let (friction, state, _) = self.friction_on(i);
            let [k, c] = friction.torque_slopes(state, &self.slip(at, i), &surface_loads[i]);
            let body = self.freedom_of(i);
            if i >= FRICTION_WHEELS {
                // wheel angle = carrier angle + side gear angle − twist
                let s = i - FRICTION_WHEELS;
                j.by_position[body][CARRIER] -= k;
                j.by_position[body][s] -= k;
                if body != s {
                    j.by_position[body][body] += k;
                }
                j.by_velocity[body][body] -= c;
                continue;
            }
            j.by_position[body][body] -= k;
            j.by_rate[body][body] -= c;
            if i < FRICTION_PLANETS {
                j.by_position[CARRIER][i] += k;
                j.by_rate[CARRIER][i] += c;
            }
        }
    }

    /// Torques of the friction on the wheels [N·m].
    fn brake_torques(&self, at: &Point<N>) -> [f64; 2]
    where
        Self: Sized,
    {
        let surface_loads = self.applied().friction().wheel_loads(&self.applied().inputs);
        [0, 1].map(|s| {
            let (friction, state, _) = self.friction_on(FRICTION_WHEELS + s);
            let torque = || friction.torque(state, &self.slip(at, FRICTION_WHEELS + s), &surface_loads[s]);
            if friction.is_on() { torque() } else { 0.0 }
        })
    }

    /// Energy in the springs of stuck friction [J].
    fn friction_energy(&self, at: &Point<N>) -> f64 {
        let energy = |i: usize| {
            let (friction, state, count) = self.friction_on(i);
            count * friction.energy(state, self.slip(at, i).position)
        };
        self.bodies_that_stick().filter(|&i| self.applied().friction_state[i].stiffness > 0.0).map(energy).sum()
    }

    /// True if loads decide whether friction switches at `at`.
    fn awaits_load(&self, at: &Point<N>) -> bool {
        let awaits = |i: usize| self.friction_on(i).0.awaits_load(self.friction_on(i).1, &self.slip(at, i));
        self.has_dry_friction() && bodies_with_friction(self).any(awaits)
    }

    /// Fraction of a step after which friction switches, or `None` if it does not.
    fn friction_crossing(&self, start: TimedPoint<N>, end: TimedPoint<N>) -> Option<f64> {
        if !self.awaits_load(end.point) {
            return None;
        }
        let surface_loads = [start, end].map(|at| self.surface_loads(at.point, at.time));
        bodies_with_friction(self)
            .filter_map(|i| {
                let slips = [self.slip(start.point, i), self.slip(end.point, i)];
                let [start, end] = [0, 1].map(|k| LoadedSlip { slip: &slips[k], load: &surface_loads[k][i] });
                let (friction, state, _) = self.friction_on(i);
                friction.crossing(state, start, end)
            })
            .reduce(f64::min)
    }

    /// Distance of each friction from its switch, or `None` if it does not act.
    fn friction_margins(&self, at: &Point<N>) -> [Option<f64>; FRICTION_BODIES]
    where
        Self: Sized,
    {
        let mut margins = [None; FRICTION_BODIES];
        if self.has_dry_friction() {
            let surface_loads = self.surface_loads(at, 0.0);
            for i in bodies_with_friction(self) {
                let (friction, state, _) = self.friction_on(i);
                margins[i] = Some(friction.margin(state, &self.slip(at, i), &surface_loads[i]));
            }
        }
        margins
    }

    /// True if friction is due to switch at `at`, `time` [s] after the inputs were set.
    fn is_friction_due(&self, at: &Point<N>, time: f64) -> bool {
        if !self.awaits_load(at) {
            return false;
        }
        let surface_loads = self.surface_loads(at, time);
        bodies_with_friction(self).any(|i| {
            let (friction, state, _) = self.friction_on(i);
            friction.is_due(state, &self.slip(at, i), &surface_loads[i], self.stops(at, time, i))
        })
    }

    /// True if body `i` slides at a speed near zero and does not accelerate in its sliding direction. This is evaluated
    /// at `at`, `time` [s] after the inputs were set.
    fn stops(&self, at: &Point<N>, time: f64, i: usize) -> bool {
        let direction = self.applied().friction_state[i].mode.direction();
        if direction == 0.0 || self.slip(at, i).speed.abs() >= SPEED_TOLERANCE {
            return false;
        }
        let v = self.acceleration_at(at, time);
        direction * self.slip(&Point { q: at.q, v }, i).speed <= 0.0
    }

    /// Drags the anchors of sliding bodies to the point `at`. `ledger_rates` contain the limit torques at this point.
    #[inline]
    fn drag_anchors(&self, at: &Point<N>, ledger_rates: &LedgerRates, anchors: &mut [f64; FRICTION_BODIES]) {
        if !self.has_dry_friction() {
            return;
        }
        for i in bodies_with_friction(self).filter(|&i| self.applied().friction_state[i].mode != Mode::Stuck) {
            anchors[i] = self.friction_on(i).0.drag(anchors[i], self.slip(at, i).position, ledger_rates.limit[i]);
        }
    }

    /// Switches friction on `bodies` if it is due at `at`, `time` [s] after the inputs were set. Energy that its
    /// springs lose becomes heat.
    fn settle_friction(&mut self, at: &Point<N>, time: f64, bodies: Range<usize>, heat: &mut [f64]) {
        let surface_loads = self.surface_loads(at, time);
        for i in self.bodies_that_stick().filter(|i| bodies.contains(i)) {
            let (friction, &(mut state), count) = self.friction_on(i);
            if friction.is_on() {
                let stops = self.stops(at, time, i);
                friction.settle(
                    &mut state,
                    LoadedSlip { slip: &self.slip(at, i), load: &surface_loads[i] },
                    stops,
                    count,
                    heat,
                );
                self.applied_mut().friction_state[i] = state;
            }
        }
    }

    /// Adapts friction to changed stiffnesses. It starts on bodies without friction so far, or ends on others.
    fn adapt_friction(&mut self, at: &Point<N>, heat: &mut [f64])
    where
        Self: Sized,
    {
        for i in self.bodies_that_stick() {
            let (friction, &(mut state), count) = self.friction_on(i);
            friction.adapt(&mut state, &self.slip(at, i), heat, count);
            self.applied_mut().friction_state[i] = state;
        }
    }
}

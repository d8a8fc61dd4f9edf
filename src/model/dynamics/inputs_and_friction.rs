//! Inputs and dry friction, which act on gears with and without teeth.

use super::ledger_rates::LedgerRates;
use super::{InputsAndFriction, PinionLoss};
use crate::integrate::{Matrix, Point, TimedPoint};
use crate::model::assembly::BodyEffects;
use crate::model::effect_kinds::dry_friction::{DryFriction, LoadedSlip, SPEED_TOLERANCE};
use crate::model::effect_kinds::{BodyMotion, FrictionState, Mode, PairFriction, RubbingSurface, Slip, SurfaceLoad};
use crate::model::scene::{
    CARRIER, InputDerivatives, Inputs, Layout, PAIRS, PINION_PAIR, Plan, RubbingKind, RubbingPair,
};

/// Share of a change of inputs along which accelerations are compared.
const CHANGE: f64 = 1.0 / 1024.0;

/// Derivatives of forces, written in place.
pub struct Jacobian<'a, const N: usize> {
    /// ∂force/∂position.
    pub by_position: &'a mut Matrix<N>,
    /// ∂force/∂(rate of position).
    pub by_rate: &'a mut Matrix<N>,
    /// ∂force/∂velocity.
    pub by_velocity: &'a mut Matrix<N>,
}

/// Speed of the body of a pair relative to the surface on which it rubs [rad/s].
#[inline]
pub fn slip_speed<const N: usize>(at: &Point<N>, pair: &RubbingPair) -> f64 {
    at.v[pair.body] - pair.base.map_or(0.0, |base| pair.ratio * at.v[base])
}

/// Angle of the body of a pair relative to its base [rad].
#[inline]
fn slip_position<const N: usize>(at: &Point<N>, pair: &RubbingPair) -> f64 {
    pair.position().iter().map(|&(i, factor)| factor * at.q[i]).sum()
}

/// Motion of a pair.
#[inline]
pub fn slip<const N: usize>(at: &Point<N>, pair: &RubbingPair) -> Slip {
    Slip { position: slip_position(at, pair), speed: slip_speed(at, pair) }
}

/// Torque of dry friction against the motion of pair `number` under `load` [N·m]; 0 without friction.
fn friction_torque<const N: usize>(
    of: &(impl FrictionEquations<N> + ?Sized),
    number: usize,
    at: &Point<N>,
    load: impl FnOnce() -> SurfaceLoad,
) -> f64 {
    let Some(pair) = of.pair(number) else { return 0.0 };
    let (friction, state) = of.friction_on(pair);
    if friction.is_on() { friction.torque(state, &slip(at, pair), &load()) } else { 0.0 }
}

/// Pairs that may rub on each other.
#[inline]
fn pairs<const N: usize>(of: &(impl FrictionEquations<N> + ?Sized)) -> impl Iterator<Item = &RubbingPair> {
    of.body_effects().map_or(&[][..], |effects| &effects.pairs).iter().flatten()
}

/// Pairs on which friction acts.
#[inline]
fn rubbing_pairs<const N: usize>(of: &(impl FrictionEquations<N> + ?Sized)) -> impl Iterator<Item = &RubbingPair> {
    // a loop over the set bits of a mask needs few branches
    let mut left = of.applied().friction().mask;
    let pairs = of.body_effects().map_or(&[][..], |effects| &effects.pairs);
    std::iter::from_fn(move || {
        let number = left.trailing_zeros() as usize;
        left &= left.wrapping_sub(1);
        pairs.get(number)
    })
    .flatten()
}

/// Equations of gears with or without teeth, as far as inputs and dry friction need them.
pub trait FrictionEquations<const N: usize> {
    /// Inputs and dry friction that act.
    fn applied(&self) -> &InputsAndFriction;
    /// Mutable inputs and dry friction.
    fn applied_mut(&mut self) -> &mut InputsAndFriction;
    /// Effects on bodies. Shapes on which none act have none.
    fn body_effects(&self) -> Option<&BodyEffects>;
    /// Scene plan.
    fn plan(&self) -> &Plan;
    /// Index of each degree of freedom.
    fn layout(&self) -> &Layout;
    /// True if there is dry friction.
    fn has_dry_friction(&self) -> bool;
    /// True if half-shafts may have ends.
    fn may_have_ends(&self) -> bool;
    /// Loads of the meshes on the surfaces of all pairs at `at`, if friction depends on them.
    fn mesh_loads(&self, at: &Point<N>) -> [SurfaceLoad; PAIRS];
    /// Accelerations at `at`, `time` [s] after the inputs were set.
    fn acceleration_at(&self, at: &Point<N>, time: f64) -> [f64; N];
    /// Torque of the drive at the carrier's speed [N·m], `time` [s] after the inputs were set.
    fn drive_torque(&self, at: &Point<N>, time: f64) -> f64;
    /// ∂ω̇_c/∂(torque on the carrier) [1/(kg·m²)].
    fn carrier_mobility(&self) -> f64;
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
        let (inputs, input_derivatives) = self.applied().inputs_after(self.body_effects(), time);
        self.under(&inputs, &input_derivatives)
    }

    /// Contribution of `inputs` and their derivatives to the accelerations, which are linear in both.
    fn input_accelerations(&self, at: &Point<N>, inputs: &Inputs, input_derivatives: &InputDerivatives) -> [f64; N]
    where
        Self: Copy,
    {
        if let Some(changes) = self.changes_with_loss(at, inputs, input_derivatives) {
            return changes;
        }
        let with = self.under(inputs, input_derivatives).acceleration_by_inputs(at);
        let without = self.under(&Inputs::ZERO, &InputDerivatives::ZERO).acceleration_by_inputs(at);
        std::array::from_fn(|i| with[i] - without[i])
    }

    /// Evaluates [`Self::input_accelerations`] if the friction of a rigid pinion depends on its torque: the accelerations
    /// are then linear only as long as this torque keeps its sign.
    fn changes_with_loss(
        &self,
        at: &Point<N>,
        inputs: &Inputs,
        InputDerivatives { rates: [first, second] }: &InputDerivatives,
    ) -> Option<[f64; N]>
    where
        Self: Copy,
    {
        self.sliding_pinion()?;
        let InputsAndFriction { inputs: now, input_derivatives: InputDerivatives { rates: now_rates }, .. } =
            self.applied();
        let moved = |by: f64| {
            let rates = InputDerivatives { rates: [now_rates[0].plus(by, first), now_rates[1].plus(by, second)] };
            self.under(&now.plus(by, inputs), &rates).acceleration_at(at, 0.0)
        };
        let [ahead, behind] = [moved(CHANGE), moved(-CHANGE)];
        Some(std::array::from_fn(|i| (ahead[i] - behind[i]) / (2.0 * CHANGE)))
    }

    /// Partial derivative of the accelerations with respect to time, `time` [s] after the inputs were set.
    fn drift_at(&self, at: &Point<N>, time: f64) -> [f64; N]
    where
        Self: Copy,
    {
        let later = self.later(time);
        let [first, second] = later.applied().input_derivatives.rates;
        later.input_accelerations(at, &first, &InputDerivatives { rates: [second, Inputs::ZERO] })
    }

    /// Positions, velocities and inputs, as passed to effects.
    fn body_motion<'b>(&'b self, at: &'b Point<N>) -> BodyMotion<'b> {
        let InputsAndFriction { inputs, input_derivatives, dogs, oil_viscosity, .. } = self.applied();
        BodyMotion {
            q: &at.q,
            v: &at.v,
            layout: self.layout(),
            inputs,
            input_rates: &input_derivatives.rates[0],
            dogs,
            oil_viscosity: *oil_viscosity,
        }
    }

    /// Fraction of a step of `h` [s] from `at` after which the force of an effect has its first kink, if one is expected.
    fn kink_of_effects(&self, at: &Point<N>, h: f64) -> Option<f64> {
        let motion = self.body_motion(at);
        self.body_effects()?.forces.iter().filter_map(|effect| effect.kink(&motion, h)).reduce(f64::min)
    }

    /// Converts ledger rates at `at` to those before the torques changed.
    fn undo_input_change(&self, at: &Point<N>, ledger_rates: &mut LedgerRates) {
        let (InputsAndFriction { inputs, change, .. }, plan) = (self.applied(), self.plan());
        for s in (0..2).filter(|&s| !plan.side_imposed[s]) {
            ledger_rates.input += change[s] * at.v[self.wheel(s)];
            if self.may_have_ends() && !plan.shafts[s] {
                ledger_rates.shaft[s] = inputs.load_torque[s] - change[s];
            }
        }
        if !plan.drive_imposed {
            ledger_rates.input -= change[2] * at.v[self.layout().port];
        }
    }

    /// Degree of freedom of wheel `s`: the end of its half-shaft, or the side gear if the half-shaft is rigid.
    #[inline]
    fn wheel(&self, s: usize) -> usize {
        if self.may_have_ends() && self.plan().shafts[s] { self.layout().end(s) } else { s }
    }

    /// Pair with this number, if it exists.
    fn pair(&self, number: usize) -> Option<&RubbingPair> {
        self.body_effects()?.pairs[number].as_ref()
    }

    /// Friction of a pair, and its state.
    fn friction_on(&self, pair: &RubbingPair) -> (DryFriction<'_>, &FrictionState) {
        let (applied, surfaces) = (self.applied(), self.body_effects().map_or(&[][..], |effects| &effects.surfaces));
        let friction = DryFriction::new(applied.friction().on(pair.number), surfaces);
        (friction, &applied.friction_state[pair.number])
    }

    /// Loads on all rubbing surfaces at `at`, `time` [s] after the inputs were set.
    fn surface_loads(&self, at: &Point<N>, time: f64) -> [SurfaceLoad; PAIRS] {
        let (mut all, applied) = (self.mesh_loads(at), self.applied());
        if applied.driven && time > 0.0 {
            let (inputs, _) = applied.inputs_after(self.body_effects(), time);
            applied.friction().add_commands(&inputs, &mut all);
        } else {
            applied.friction().add_commands(&applied.inputs, &mut all);
        }
        if self.body_effects().is_some_and(|all| all.loss.is_some()) {
            all[PINION_PAIR] = self.pinion_load(at, time);
        }
        all
    }

    /// Load of a pair in the equations of motion. The load of a pinion with an elastic mesh follows from the state; that
    /// of a rigid pinion acts when all other torques are known.
    #[inline(always)]
    fn load_on(&self, pair: &RubbingPair, at: &Point<N>, surface_loads: &[SurfaceLoad; PAIRS]) -> SurfaceLoad {
        if pair.number == PINION_PAIR { self.load_on_pinion(at) } else { surface_loads[pair.number] }
    }

    #[cold]
    #[inline(never)]
    fn load_on_pinion(&self, at: &Point<N>) -> SurfaceLoad {
        if self.layout().pinion() == CARRIER { SurfaceLoad::default() } else { self.pinion_load(at, 0.0) }
    }

    /// Adds the torques and the heat of dry friction under the loads on its surfaces.
    fn add_friction_torques(
        &self,
        at: &Point<N>,
        surface_loads: &[SurfaceLoad; PAIRS],
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) {
        for pair in rubbing_pairs(self) {
            let ((friction, state), i) = (self.friction_on(pair), pair.number);
            let slips = (slip_speed(at, pair), || slip_position(at, pair));
            let load = self.load_on(pair, at, surface_loads);
            let torque = friction.act(state, slips, &load, pair.count, &mut ledger_rates.heat);
            ledger_rates.limit[i] = torque * state.mode.direction();
            sum[pair.body] -= torque;
            if let Some(base) = pair.base {
                sum[base] += pair.ratio * torque;
            }
        }
    }

    /// Adds the derivatives of dry friction with respect to the motion of its bodies, under the loads on its surfaces.
    fn friction_slopes(&self, at: &Point<N>, surface_loads: &[SurfaceLoad; PAIRS], j: &mut Jacobian<'_, N>) {
        for pair in rubbing_pairs(self) {
            let (friction, state) = self.friction_on(pair);
            let load = self.load_on(pair, at, surface_loads);
            let [k, c] = friction.torque_slopes(state, slip_speed(at, pair), &load);
            if pair.number == PINION_PAIR {
                self.add_slopes_by_mesh(at, pair, &load, j);
            }
            // friction that slides at a constant limit has no derivatives
            if k == 0.0 && c == 0.0 {
                continue;
            }
            for (row, sign) in [Some((pair.body, -1.0)), pair.base.map(|base| (base, pair.ratio))].into_iter().flatten()
            {
                for &(i, factor) in pair.position() {
                    j.by_position[row][i] += sign * factor * k;
                }
                // a common rotation of body and base causes no torque, not even by rounding
                match pair.base {
                    Some(_) => pair.position().iter().for_each(|&(i, factor)| j.by_rate[row][i] += sign * factor * c),
                    None => j.by_velocity[row][pair.body] += sign * c,
                }
            }
        }
    }

    /// Adds the derivatives of the friction of a sliding pinion with respect to the torque of its elastic mesh.
    #[cold]
    #[inline(never)]
    fn add_slopes_by_mesh(&self, at: &Point<N>, pair: &RubbingPair, load: &SurfaceLoad, j: &mut Jacobian<'_, N>) {
        let Some(all) = self.body_effects() else { return };
        let (friction, state) = self.friction_on(pair);
        let (direction, motion) = (state.mode.direction(), self.body_motion(at));
        let Some(loss) = all.loss.filter(|_| direction != 0.0) else {
            return;
        };
        for effect in all.forces.iter() {
            let Some(torque) = effect.mesh_torque(&motion) else { continue };
            let by_load = friction.limit_slopes(direction * slip_speed(at, pair), load)[1];
            let per_torque = -direction * by_load * loss.coefficient(torque) * torque.signum();
            for (i, [by_position, by_velocity]) in effect.mesh_slopes(&motion) {
                j.by_position[pair.body][i] += per_torque * by_position;
                j.by_velocity[pair.body][i] += per_torque * by_velocity;
            }
        }
    }

    /// Torques of commanded friction against the motion of the pairs of this `kind`, left and right [N·m].
    fn commanded_torques(&self, kind: RubbingKind, at: &Point<N>) -> [f64; 2] {
        let loads = self.applied().friction().commanded_loads(&self.applied().inputs);
        [0, 1].map(|s| friction_torque(self, kind.number(s), at, || loads[kind.number(s)]))
    }

    /// Torques of dry friction against the motion of all pairs, each for a single pair [N·m].
    fn friction_torques(&self, at: &Point<N>) -> [f64; PAIRS] {
        let (loads, mut torques) = (self.surface_loads(at, 0.0), [0.0; PAIRS]);
        for pair in rubbing_pairs(self) {
            let (friction, state) = self.friction_on(pair);
            torques[pair.number] = friction.torque(state, &slip(at, pair), &loads[pair.number]);
        }
        torques
    }

    /// Torque with which dry friction holds the pinion back, at the carrier's speed [N·m].
    fn pinion_friction(&self, at: &Point<N>) -> f64 {
        friction_torque(self, PINION_PAIR, at, || self.pinion_load(at, 0.0))
    }

    /// Energy in the springs of stuck friction [J].
    fn friction_energy(&self, at: &Point<N>) -> f64 {
        let energy = |pair: &RubbingPair| {
            let (friction, state) = self.friction_on(pair);
            pair.count * friction.energy(state, slip_position(at, pair))
        };
        pairs(self).filter(|pair| self.applied().friction_state[pair.number].stiffness > 0.0).map(energy).sum()
    }

    /// True if loads decide whether friction switches at `at`.
    fn awaits_load(&self, at: &Point<N>) -> bool {
        let awaits = |pair: &RubbingPair| {
            let (friction, state) = self.friction_on(pair);
            friction.awaits_load(state, slip_speed(at, pair))
        };
        self.has_dry_friction() && rubbing_pairs(self).any(awaits)
    }

    /// Fraction of a step after which friction switches, or `None` if it does not.
    fn friction_crossing(&self, start: TimedPoint<N>, end: TimedPoint<N>) -> Option<f64> {
        if !self.awaits_load(end.point) {
            return None;
        }
        let surface_loads = [start, end].map(|at| self.surface_loads(at.point, at.time));
        rubbing_pairs(self)
            .filter_map(|pair| {
                let slips = [start, end].map(|at| slip(at.point, pair));
                let [start, end] = [0, 1].map(|k| LoadedSlip { slip: &slips[k], load: &surface_loads[k][pair.number] });
                let (friction, state) = self.friction_on(pair);
                friction.crossing(state, start, end)
            })
            .reduce(f64::min)
    }

    /// Distance of each friction from its switch, or `None` if it does not act.
    fn friction_margins(&self, at: &Point<N>) -> [Option<f64>; PAIRS]
    where
        Self: Sized,
    {
        let mut margins = [None; PAIRS];
        if self.has_dry_friction() {
            let surface_loads = self.surface_loads(at, 0.0);
            for pair in rubbing_pairs(self) {
                let ((friction, state), i) = (self.friction_on(pair), pair.number);
                margins[i] = Some(friction.margin(state, &slip(at, pair), &surface_loads[i]));
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
        rubbing_pairs(self).any(|pair| {
            let (friction, state) = self.friction_on(pair);
            friction.is_due(state, &slip(at, pair), &surface_loads[pair.number], self.stops(at, time, pair))
        })
    }

    /// True if a pair slides at a speed near zero and does not accelerate in its sliding direction. This is evaluated
    /// at `at`, `time` [s] after the inputs were set.
    fn stops(&self, at: &Point<N>, time: f64, pair: &RubbingPair) -> bool {
        let direction = self.applied().friction_state[pair.number].mode.direction();
        if direction == 0.0 || slip_speed(at, pair).abs() >= SPEED_TOLERANCE {
            return false;
        }
        let v = self.acceleration_at(at, time);
        direction * slip_speed(&Point { q: at.q, v }, pair) <= 0.0
    }

    /// Drags the anchors of sliding bodies to the point `at`. `ledger_rates` contain the limit torques at this point.
    #[inline]
    fn drag_anchors(&self, at: &Point<N>, ledger_rates: &LedgerRates, anchors: &mut [f64; PAIRS]) {
        if !self.has_dry_friction() {
            return;
        }
        for pair in rubbing_pairs(self) {
            let ((friction, state), i) = (self.friction_on(pair), pair.number);
            if state.mode != Mode::Stuck {
                anchors[i] = friction.drag(anchors[i], slip_position(at, pair), ledger_rates.limit[i]);
            }
        }
    }

    /// Switches friction that is due at `at`, `time` [s] after the inputs were set: of all pairs, or only of those that
    /// inputs command. Energy that its springs lose becomes heat.
    fn settle_friction(&mut self, at: &Point<N>, time: f64, only_commanded: bool, heat: &mut [f64]) {
        let surface_loads = self.surface_loads(at, time);
        for i in (0..PAIRS).filter(|&i| !only_commanded || RubbingKind::of(i).0.is_commanded()) {
            let Some(&pair) = self.pair(i) else { continue };
            let (friction, &(mut state)) = self.friction_on(&pair);
            if friction.is_on() {
                let stops = self.stops(at, time, &pair);
                let at = LoadedSlip { slip: &slip(at, &pair), load: &surface_loads[i] };
                friction.settle(&mut state, at, stops, pair.count, heat);
                self.applied_mut().friction_state[i] = state;
            }
        }
    }

    /// Adapts friction to changed stiffnesses. It starts on bodies without friction so far, or ends on others.
    fn adapt_friction(&mut self, at: &Point<N>, heat: &mut [f64]) {
        for i in 0..PAIRS {
            let Some(&pair) = self.pair(i) else { continue };
            let (friction, &(mut state)) = self.friction_on(&pair);
            friction.adapt(&mut state, &slip(at, &pair), heat, pair.count);
            self.applied_mut().friction_state[i] = state;
        }
    }

    /// Winds up the springs of pairs at rest to their torques in `friction`, and lets those slide that begin to.
    fn wind_friction(&mut self, at: &Point<N>, friction: &PairFriction) {
        for i in 0..PAIRS {
            let (Some(pair), torque) = (self.pair(i), friction.torque[i]) else { continue };
            let (position, state) = (slip_position(at, pair), &mut self.applied_mut().friction_state[i]);
            if state.mode == Mode::Stuck && state.stiffness > 0.0 {
                state.anchor = position - torque / state.stiffness;
                if friction.begins[i] != 0.0 {
                    state.mode = if friction.begins[i] > 0.0 { Mode::Forward } else { Mode::Backward };
                }
            }
        }
    }

    /// Pressure times speed of each surface that slides at `at` [W/m²], with the number of its pair.
    fn each_pv(&self, at: &Point<N>, mut see: impl FnMut(&RubbingSurface, usize, f64))
    where
        Self: Sized,
    {
        let slides = |pair: &&RubbingPair| self.friction_on(pair).1.mode.direction() != 0.0;
        if !self.has_dry_friction() || !rubbing_pairs(self).any(|pair| slides(&pair)) {
            return;
        }
        let loads = self.surface_loads(at, 0.0);
        let surfaces = self.body_effects().map_or(&[][..], |effects| &effects.surfaces);
        for pair in rubbing_pairs(self).filter(slides) {
            let speed = self.friction_on(pair).1.mode.direction() * slip_speed(at, pair);
            let kind = RubbingKind::of(pair.number).0;
            for surface in surfaces.iter().filter(|surface| surface.kind == kind && surface.has_pressure()) {
                see(surface, pair.number, surface.pressed.at(&loads[pair.number]) * speed.max(0.0));
            }
        }
    }
}

//! The ideal differential with effects on bodies: Willis' equation stays a constraint, the rest is integrated.
//!
//! Accelerations are v̇ = W Q + f u̇_c (`assembly::ideal_with_effects`). The torque of the meshes on a side gear is the force of the
//! constraint, λ_s = J_s ω̇_s − Q_s.

use super::energy_floor::energy_floor;
use super::{Acted, Acting, Jacobian, State};
use crate::integrate::{Imbalance, Linearisation, Matrix, Point, SecondOrder};
use crate::model::assembly::ideal_with_effects::{IMPOSED, IdealWithEffects, MOST};
use crate::model::assembly::{Ideal, IdealMotion};
use crate::model::dynamics::ledger_rates::LedgerRates;
use crate::model::effect_kinds::{Action, FrictionSource, Slopes, SurfaceLoad};
use crate::model::scene::{CARRIER, FRICTION_BODIES, InputDerivatives, Inputs, Layout, PLANET, Plan};

/// Torques that follow from the constraint.
#[derive(Clone, Copy, Debug, Default)]
pub struct IdealTorques {
    /// Of the carrier's drive [N·m].
    pub carrier: f64,
    /// Of what imposes the spin [N·m].
    pub spin: f64,
    /// Of the meshes on each side gear [N·m].
    pub gears: [f64; 2],
}

/// The equations under given inputs.
#[derive(Clone, Copy)]
pub struct IdealEquations<'a> {
    /// Constants.
    pub ideal: &'a IdealWithEffects,
    pub(in crate::model) acting: Acting,
}

impl<'a> IdealEquations<'a> {
    /// Index of the end of the half-shaft of side `s`.
    fn end(&self, s: usize) -> usize {
        self.ideal.layout.end(s)
    }

    /// Degrees of freedom.
    fn count(&self) -> usize {
        self.ideal.layout.count()
    }

    /// Equations under `inputs` at `state`.
    pub fn new(ideal: &'a IdealWithEffects, inputs: &Inputs, state: &State) -> Self {
        Self { ideal, acting: Acting::new(Some(&ideal.body_effects), inputs, state) }
    }

    /// Forces, all commanded torques but those of imposed motions among them, and the accelerations of imposed motions.
    fn forces(&self, at: &Point<MOST>, ledger_rates: &mut LedgerRates) -> ([f64; MOST], [f64; IMPOSED]) {
        let rates = &self.acting.input_derivatives.rates[0];
        let (mut sum, mut imposed) = ([0.0; MOST], rates.carrier_speed);
        let mut out = Action {
            force: &mut sum,
            imposed: &mut imposed,
            drive: &mut ledger_rates.drive,
            heat: &mut ledger_rates.heat,
        };
        for effect in self.ideal.body_effects.forces.iter() {
            effect.act(&self.body_motion(at), &mut out);
        }
        let plan = &self.ideal.plan;
        if self.rubs() {
            self.rub(at, &self.surface_loads(at, 0.0), &mut sum, ledger_rates);
        }
        for s in 0..2 {
            ledger_rates.shaft[s] = self.acting.inputs.load_torque[s];
            if self.has_ends() && plan.shafts[s] {
                let end = self.end(s);
                ledger_rates.shaft[s] = self.ideal.body_effects.half_shafts.torque(s, at.q[end], at.v[s] - at.v[end]);
            }
            let wheel = self.wheel(s);
            if plan.side_imposed[s] {
                let inertial = self.ideal.inertia[wheel] * rates.side_speed[s];
                ledger_rates.input += (inertial - sum[wheel]) * at.v[wheel];
            } else {
                sum[wheel] -= self.acting.inputs.load_torque[s];
                ledger_rates.input -= self.acting.inputs.load_torque[s] * at.v[wheel];
            }
        }
        if !plan.carrier_imposed {
            let drive = self.acting.inputs.carrier_torque + ledger_rates.drive;
            sum[CARRIER] += drive;
            ledger_rates.input += drive * at.v[CARRIER];
        }
        (sum, [imposed, rates.planet_spin, rates.side_speed[0], rates.side_speed[1]])
    }

    fn accelerations(&self, sum: &[f64; MOST], imposed: &[f64; IMPOSED]) -> [f64; MOST] {
        let ideal = self.ideal;
        std::array::from_fn(|i| {
            let free: f64 = (0..self.count()).map(|j| ideal.mobility[i][j] * sum[j]).sum();
            free + (0..IMPOSED).map(|k| ideal.follow[k][i] * imposed[k]).sum::<f64>()
        })
    }

    fn torques_of(&self, sum: &[f64; MOST], a: &[f64; MOST], excess: f64) -> IdealTorques {
        let ideal = self.ideal;
        let lack: [f64; MOST] = std::array::from_fn(|i| ideal.inertia[i] * a[i] - sum[i]);
        let plan = &ideal.plan;
        IdealTorques {
            carrier: if plan.carrier_imposed {
                lack[0] + lack[1] + lack[CARRIER]
            } else {
                self.acting.inputs.carrier_torque + excess
            },
            spin: if plan.spin_imposed { ideal.ratio * (lack[0] - lack[1]) + lack[PLANET] } else { 0.0 },
            gears: [lack[0], lack[1]],
        }
    }

    /// Torques that follow from the constraint.
    pub fn torques(&self, at: &Point<MOST>) -> IdealTorques {
        let mut ledger_rates = LedgerRates::default();
        let (sum, imposed) = self.forces(at, &mut ledger_rates);
        self.torques_of(&sum, &self.accelerations(&sum, &imposed), ledger_rates.drive)
    }

    /// Kinetic energy [J].
    fn kinetic_energy(&self, at: &Point<MOST>) -> f64 {
        0.5 * (0..self.count()).map(|i| self.ideal.inertia[i] * at.v[i] * at.v[i]).sum::<f64>()
    }

    /// Energy of half-shafts and stuck friction [J].
    fn stored_energy(&self, at: &Point<MOST>) -> f64 {
        let bodies: f64 = self.ideal.body_effects.forces.iter().map(|e| e.energy(&self.body_motion(at))).sum();
        bodies + self.friction_energy(at)
    }
}

impl Acted<MOST> for IdealEquations<'_> {
    fn acting(&self) -> &Acting {
        &self.acting
    }

    fn acting_mut(&mut self) -> &mut Acting {
        &mut self.acting
    }

    fn friction_sources(&self) -> &[FrictionSource] {
        &self.ideal.body_effects.friction
    }

    fn plan(&self) -> &Plan {
        &self.ideal.plan
    }

    fn layout(&self) -> &Layout {
        &self.ideal.layout
    }

    fn rubs(&self) -> bool {
        self.acting.rubs
    }

    fn has_ends(&self) -> bool {
        self.ideal.layout.has_ends()
    }

    /// None: planets stick with the side gears.
    fn sticking(&self) -> &[f64] {
        &[]
    }

    fn mesh_loads(&self, _: &Point<MOST>) -> [SurfaceLoad; FRICTION_BODIES] {
        [SurfaceLoad::default(); FRICTION_BODIES]
    }

    fn acceleration_at(&self, at: &Point<MOST>, time: f64) -> [f64; MOST] {
        self.accelerate_at(at, time)
    }

    fn acceleration_by_inputs(&self, at: &Point<MOST>) -> [f64; MOST] {
        let (sum, imposed) = self.forces(at, &mut LedgerRates::default());
        self.accelerations(&sum, &imposed)
    }
}

impl SecondOrder<MOST> for IdealEquations<'_> {
    type Rates = LedgerRates;

    fn degrees_of_freedom(&self) -> usize {
        self.count()
    }

    fn energy(&self, at: &Point<MOST>) -> [f64; 2] {
        [self.kinetic_energy(at), self.stored_energy(at)]
    }

    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, ledger_rates: &[LedgerRates; 3]) -> Imbalance {
        LedgerRates::imbalance::<true>(energies, h, ledger_rates)
    }

    fn energy_floor(&self, ends: [&Point<MOST>; 2], tolerance: f64, residual: f64) -> f64 {
        let spring_forces = || {
            let rest = Point { q: ends[1].q, v: [0.0; MOST] };
            let free = self.under(&Inputs::ZERO, &InputDerivatives::ZERO);
            let (force, _) = free.forces(&rest, &mut LedgerRates::default());
            std::array::from_fn(|i| force.get(i).copied().unwrap_or(0.0))
        };
        energy_floor(self, ends, tolerance, residual, spring_forces, |at| self.kinetic_energy(at))
    }

    fn rates(&self, v: &[f64; MOST]) -> [f64; MOST] {
        let mut rates = *v;
        for s in 0..2 {
            rates[s] -= v[CARRIER];
        }
        self.ideal.layout.set_twist_rates(v, &mut rates);
        rates
    }

    fn times_rates(&self, m: &mut Matrix<MOST>) {
        for row in m.iter_mut() {
            row[CARRIER] -= row[0] + row[1];
            self.ideal.layout.turn_twist_rates(row);
        }
    }

    fn evaluate(&self, at: &Point<MOST>) -> ([f64; MOST], LedgerRates) {
        let mut ledger_rates = LedgerRates::default();
        let (sum, imposed) = self.forces(at, &mut ledger_rates);
        let a = self.accelerations(&sum, &imposed);
        let torques = self.torques_of(&sum, &a, ledger_rates.drive);
        if self.ideal.plan.carrier_imposed {
            ledger_rates.input += torques.carrier * at.v[CARRIER];
        }
        ledger_rates.input += torques.spin * at.v[PLANET];
        (a, ledger_rates)
    }

    fn linearise(&self, at: &Point<MOST>) -> Linearisation<MOST, LedgerRates> {
        let (acceleration, ledger_rates) = self.evaluate(at);
        let zero = [[0.0; MOST]; MOST];
        let (mut by_position, mut by_rate, mut by_velocity) = (zero, zero, zero);
        let j = &mut Jacobian { by_position: &mut by_position, by_rate: &mut by_rate, by_velocity: &mut by_velocity };
        let mut imposed = [[0.0; MOST]; 2];
        let mut out = Slopes::new([&mut *j.by_position, &mut *j.by_velocity], &mut imposed);
        for effect in self.ideal.body_effects.forces.iter() {
            effect.slopes(&self.body_motion(at), &mut out);
        }
        if self.rubs() {
            self.friction_slopes(at, &self.surface_loads(at, 0.0), j);
        }
        self.times_rates(&mut by_rate);
        let ideal = self.ideal;
        let follow = ideal.follow[0];
        let moved = |m: &Matrix<MOST>, imposed: &[f64; MOST]| -> Matrix<MOST> {
            let mut product = [[0.0; MOST]; MOST];
            for (i, row) in product.iter_mut().enumerate() {
                for k in 0..self.count() {
                    for j in 0..MOST {
                        row[j] += ideal.mobility[i][k] * m[k][j];
                    }
                }
                for j in 0..MOST {
                    row[j] += follow[i] * imposed[j];
                }
            }
            product
        };
        for i in 0..MOST {
            for j in 0..MOST {
                by_velocity[i][j] += by_rate[i][j];
            }
        }
        Linearisation {
            acceleration,
            by_position: moved(&by_position, &imposed[0]),
            by_velocity: moved(&by_velocity, &imposed[1]),
            ledger_rates,
        }
    }

    fn is_driven(&self) -> bool {
        self.acting.driven
    }

    fn evaluate_at(&self, at: &Point<MOST>, time: f64) -> ([f64; MOST], LedgerRates) {
        if self.acting.driven { self.later(time).evaluate(at) } else { self.evaluate(at) }
    }

    fn linearise_at(&self, at: &Point<MOST>, time: f64) -> Linearisation<MOST, LedgerRates> {
        if self.acting.driven { self.later(time).linearise(at) } else { self.linearise(at) }
    }

    fn drift(&self, at: &Point<MOST>, time: f64) -> [f64; MOST] {
        self.drift_at(at, time)
    }

    fn weights(&self, at: &Point<MOST>) -> Point<MOST> {
        let carrier = 1.0 + 2.0 * at.v[CARRIER].abs();
        let mut weights = Point { q: [1.0; MOST], v: [1.0 / (carrier + at.v[PLANET].abs()); MOST] };
        if self.rubs() {
            // a stuck clutch or wheel turns by milliradians
            (weights.q[0], weights.q[1]) = (1e3, 1e3);
        }
        for (i, _) in self.ideal.layout.attached() {
            weights.q[i] = 1.0 / (1e-3 + at.q[i].abs());
        }
        weights
    }

    fn crossing(&self, start: (&Point<MOST>, f64), end: (&Point<MOST>, f64)) -> Option<f64> {
        self.friction_crossing(start, end)
    }
}

impl Ideal {
    /// Exact motion over `h` [s] under constant inputs.
    pub fn advance(&self, state: &mut State, inputs: &Inputs, h: f64) {
        let m = self.motion(inputs);
        let v = state.v;
        let turn = |speed: f64, acceleration: f64| h * (speed + 0.5 * h * acceleration);
        let (carrier, spin) = (turn(v[CARRIER], m.carrier), turn(v[PLANET], m.spin));
        let relative = self.ratio * spin;
        state.q[0] += relative;
        state.q[1] -= relative;
        state.q[CARRIER] += carrier;
        for g in 0..self.plan.groups().len() {
            state.q[PLANET + g] += spin;
        }
        let [left, right] = inputs.load_torque;
        state.work += m.carrier_torque * carrier + m.spin_torque * spin
            - left * (carrier + relative)
            - right * (carrier - relative);
        state.v[CARRIER] += h * m.carrier;
        state.v[PLANET] += h * m.spin;
        self.constrain(&mut state.v);
    }

    /// Exact motion over `h` [s] under inputs that are parabolas of time, with the accelerations and torques of `course` and their
    /// derivatives.
    #[inline]
    pub fn advance_along(&self, state: &mut State, course: &[IdealMotion; 3], h: f64) {
        let carrier = Course { speed: state.v[CARRIER], acceleration: course.each_ref().map(|m| m.carrier) };
        let spin = Course { speed: state.v[PLANET], acceleration: course.each_ref().map(|m| m.spin) };
        let (by_carrier, by_spin) = (carrier.moments(h), spin.moments(h));
        for (k, m) in course.iter().enumerate() {
            state.work += m.net[0] * by_carrier[k] + m.net[1] * by_spin[k];
        }
        let (turned, spun) = (by_carrier[0], by_spin[0]);
        let relative = self.ratio * spun;
        state.q[0] += relative;
        state.q[1] -= relative;
        state.q[CARRIER] += turned;
        for g in 0..self.plan.groups().len() {
            state.q[PLANET + g] += spun;
        }
        (state.v[CARRIER], state.v[PLANET]) = (carrier.speed_at(h), spin.speed_at(h));
    }

    /// Gives imposed speeds the values of their `inputs`, and side gears the speeds by Willis' equation.
    pub fn impose(&self, state: &mut State, inputs: &Inputs) {
        if self.plan.carrier_imposed {
            state.v[CARRIER] = inputs.carrier_speed;
        }
        if self.plan.spin_imposed {
            state.v[PLANET] = inputs.planet_spin;
        }
        self.constrain(&mut state.v);
    }
}

/// Motion whose acceleration is a parabola of time: ω = ω₀ + a t + ȧ t²/2 + ä t³/6.
struct Course {
    /// Speed at the start, ω₀ [rad/s].
    speed: f64,
    /// Acceleration at the start and its derivatives: a, ȧ, ä [rad/s², rad/s³, rad/s⁴].
    acceleration: [f64; 3],
}

impl Course {
    /// Speed after `h` [s].
    fn speed_at(&self, h: f64) -> f64 {
        let [a, b, c] = self.acceleration;
        self.speed + h * (a + h * (0.5 * b + h * (c * (1.0 / 6.0))))
    }

    /// ∫ω dt, ∫ω t dt and ∫ω t²/2 dt from 0 to `h` [s]: the turned angle, and the factors of the derivatives of a torque in its
    /// work.
    fn moments(&self, h: f64) -> [f64; 3] {
        let (v, [a, b, c]) = (self.speed, self.acceleration);
        [
            h * (v + h * (0.5 * a + h * ((1.0 / 6.0) * b + h * ((1.0 / 24.0) * c)))),
            h * h * (0.5 * v + h * ((1.0 / 3.0) * a + h * (0.125 * b + h * ((1.0 / 30.0) * c)))),
            h * h * h * ((1.0 / 6.0) * v + h * (0.125 * a + h * (0.05 * b + h * ((1.0 / 72.0) * c)))),
        ]
    }
}

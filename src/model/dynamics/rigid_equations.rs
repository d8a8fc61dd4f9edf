//! The ideal differential with effects on bodies: Willis' equation stays a constraint, the rest is integrated.
//!
//! Accelerations are v̇ = W Q + f u̇_c (`assembly::rigid`). The torque of the meshes on a side gear is the force of the
//! constraint, λ_s = J_s ω̇_s − Q_s.

use crate::integrate::{Linearisation, Matrix, Point, SecondOrder};
use crate::model::assembly::rigid::{IMPOSED, MOST, Rigid};
use crate::model::dynamics::power::Power;
use crate::model::dynamics::state::State;
use crate::model::effect_kinds::body_effect::{Action, Bodies, Slopes};
use crate::model::effect_kinds::friction::Friction;
use crate::model::effect_kinds::friction_state::FrictionState;
use crate::model::scene::layout::{CARRIER, FRICTION_BODIES, FRICTION_WHEELS, PLANET};
use crate::model::scene::{InputDerivatives, Inputs};

/// Torques that follow from the constraint.
#[derive(Clone, Copy, Debug, Default)]
pub struct RigidTorques {
    /// Of the carrier's drive [N·m].
    pub carrier: f64,
    /// Of what imposes the spin [N·m].
    pub spin: f64,
    /// Of the meshes on each side gear [N·m].
    pub gears: [f64; 2],
}

/// The equations under given inputs.
#[derive(Clone, Copy)]
pub struct RigidEquations<'a> {
    /// Constants.
    pub rigid: &'a Rigid,
    pub(super) inputs: Inputs,
    pub(super) input_derivatives: InputDerivatives,
    pub(super) driven: bool,
    /// State of the dry friction.
    pub friction_state: [FrictionState; FRICTION_BODIES],
    pub(super) friction: Friction,
}

impl<'a> RigidEquations<'a> {
    /// Whether half-shafts have ends.
    fn ends(&self) -> bool {
        self.rigid.layout.ends
    }

    /// Index of the end of the half-shaft of side `s`.
    fn end(&self, s: usize) -> usize {
        self.rigid.layout.end(s)
    }

    /// Degrees of freedom.
    fn count(&self) -> usize {
        self.rigid.layout.count()
    }

    /// Equations under `inputs` at `state`.
    pub fn new(rigid: &'a Rigid, inputs: &Inputs, state: &State) -> Self {
        let inputs = Inputs { carrier_speed: state.carrier_command, ..*inputs };
        let (input_derivatives, driven) =
            (state.input_derivatives.unwrap_or(InputDerivatives::ZERO), state.input_derivatives.is_some());
        let friction = rigid.bodies.friction(state.lock, &inputs, &input_derivatives);
        Self { rigid, inputs, input_derivatives, driven, friction_state: state.friction, friction }
    }

    fn bodies<'b>(&'b self, at: &'b Point<MOST>) -> Bodies<'b> {
        let Self { inputs, input_derivatives, .. } = self;
        Bodies { q: &at.q, v: &at.v, layout: &self.rigid.layout, inputs, input_rates: &input_derivatives.rates[0] }
    }

    pub(super) fn wheel(&self, s: usize) -> usize {
        if self.ends() && self.rigid.plan.shafts[s] { self.end(s) } else { s }
    }

    /// The equations `time` [s] later, as far as inputs go.
    fn later(&self, time: f64) -> Self {
        let (inputs, input_derivatives) = self.input_derivatives.after(time, &self.inputs);
        self.under(&inputs, &input_derivatives)
    }

    /// The same equations under other inputs.
    pub(in crate::model) fn under(&self, inputs: &Inputs, input_derivatives: &InputDerivatives) -> Self {
        Self { inputs: *inputs, input_derivatives: *input_derivatives, ..*self }
    }

    /// Forces, all commanded torques but those of imposed motions among them, and the accelerations of imposed motions.
    fn forces(&self, at: &Point<MOST>, power: &mut Power) -> ([f64; MOST], [f64; IMPOSED]) {
        let rates = &self.input_derivatives.rates[0];
        let (mut sum, mut imposed) = ([0.0; MOST], rates.carrier_speed);
        let mut out = Action { force: &mut sum, imposed: &mut imposed, drive: &mut power.drive, heat: &mut power.heat };
        for effect in self.rigid.bodies.forces.iter() {
            effect.act(&self.bodies(at), &mut out);
        }
        let plan = &self.rigid.plan;
        let surface_loads = self.surface_loads(0.0);
        for i in self.bodies_with_friction() {
            let (friction, state, slip) = (self.friction.on(i), &self.friction_state[i], self.slip(at, i));
            let torque = friction.act(state, &slip, &surface_loads[i], 1.0, &mut power.heat);
            power.limit[i] = torque * state.mode.direction();
            sum[self.freedom_of(i)] -= torque;
            if i < FRICTION_WHEELS {
                sum[CARRIER] += torque;
            }
        }
        for s in 0..2 {
            power.shaft[s] = self.inputs.load_torque[s];
            if self.ends() && plan.shafts[s] {
                let end = self.end(s);
                power.shaft[s] = self.rigid.bodies.half_shafts.torque(s, at.q[end], at.v[s] - at.v[end]);
            }
            let wheel = self.wheel(s);
            if plan.side_imposed[s] {
                let inertial = self.rigid.inertia[wheel] * rates.side_speed[s];
                power.input += (inertial - sum[wheel]) * at.v[wheel];
            } else {
                sum[wheel] -= self.inputs.load_torque[s];
                power.input -= self.inputs.load_torque[s] * at.v[wheel];
            }
        }
        if !plan.carrier_imposed {
            let drive = self.inputs.carrier_torque + power.drive;
            sum[CARRIER] += drive;
            power.input += drive * at.v[CARRIER];
        }
        (sum, [imposed, rates.planet_spin, rates.side_speed[0], rates.side_speed[1]])
    }

    fn accelerations(&self, sum: &[f64; MOST], imposed: &[f64; IMPOSED]) -> [f64; MOST] {
        let rigid = self.rigid;
        std::array::from_fn(|i| {
            let free: f64 = (0..self.count()).map(|j| rigid.mobility[i][j] * sum[j]).sum();
            free + (0..IMPOSED).map(|k| rigid.follow[k][i] * imposed[k]).sum::<f64>()
        })
    }

    /// The part of the accelerations that follows from `inputs` and their derivatives: accelerations are linear in both.
    pub(in crate::model) fn forced(
        &self,
        at: &Point<MOST>,
        inputs: &Inputs,
        input_derivatives: &InputDerivatives,
    ) -> [f64; MOST] {
        let part = |inputs: &Inputs, input_derivatives: &InputDerivatives| {
            let these = self.under(inputs, input_derivatives);
            let (sum, imposed) = these.forces(at, &mut Power::default());
            these.accelerations(&sum, &imposed)
        };
        let (with, without) = (part(inputs, input_derivatives), part(&Inputs::ZERO, &InputDerivatives::ZERO));
        std::array::from_fn(|i| with[i] - without[i])
    }

    fn torques_of(&self, sum: &[f64; MOST], a: &[f64; MOST], excess: f64) -> RigidTorques {
        let rigid = self.rigid;
        let lack: [f64; MOST] = std::array::from_fn(|i| rigid.inertia[i] * a[i] - sum[i]);
        let plan = &rigid.plan;
        RigidTorques {
            carrier: if plan.carrier_imposed {
                lack[0] + lack[1] + lack[CARRIER]
            } else {
                self.inputs.carrier_torque + excess
            },
            spin: if plan.spin_imposed { rigid.ratio * (lack[0] - lack[1]) + lack[PLANET] } else { 0.0 },
            gears: [lack[0], lack[1]],
        }
    }

    /// Torques that follow from the constraint.
    pub fn torques(&self, at: &Point<MOST>) -> RigidTorques {
        let mut power = Power::default();
        let (sum, imposed) = self.forces(at, &mut power);
        self.torques_of(&sum, &self.accelerations(&sum, &imposed), power.drive)
    }

    /// Energy of half-shafts and stuck friction [J].
    fn stored(&self, at: &Point<MOST>) -> f64 {
        let bodies: f64 = self.rigid.bodies.forces.iter().map(|e| e.energy(&self.bodies(at))).sum();
        let energy = |i: usize| self.friction.on(i).energy(&self.friction_state[i], self.slip(at, i).position);
        let held = Self::bodies_that_stick().filter(|&i| self.friction_state[i].stiffness > 0.0);
        bodies + held.map(energy).sum::<f64>()
    }
}

impl SecondOrder<MOST> for RigidEquations<'_> {
    type Power = Power;

    fn freedoms(&self) -> usize {
        self.count()
    }

    fn energy(&self, at: &Point<MOST>) -> [f64; 2] {
        let kinetic: f64 = (0..self.count()).map(|i| self.rigid.inertia[i] * at.v[i] * at.v[i]).sum();
        [0.5 * kinetic, self.stored(at)]
    }

    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, power: &[Power; 3]) -> f64 {
        Power::imbalance::<true>(energies, h, power)
    }

    fn rates(&self, v: &[f64; MOST]) -> [f64; MOST] {
        let mut rates = *v;
        for s in 0..2 {
            rates[s] -= v[CARRIER];
            if self.ends() {
                rates[self.end(s)] = v[s] - v[self.end(s)];
            }
        }
        rates
    }

    fn times_rates(&self, m: &mut Matrix<MOST>) {
        for row in m.iter_mut() {
            row[CARRIER] -= row[0] + row[1];
            if self.ends() {
                for s in 0..2 {
                    row[s] += row[self.end(s)];
                    row[self.end(s)] = -row[self.end(s)];
                }
            }
        }
    }

    fn evaluate(&self, at: &Point<MOST>) -> ([f64; MOST], Power) {
        let mut power = Power::default();
        let (sum, imposed) = self.forces(at, &mut power);
        let a = self.accelerations(&sum, &imposed);
        let torques = self.torques_of(&sum, &a, power.drive);
        if self.rigid.plan.carrier_imposed {
            power.input += torques.carrier * at.v[CARRIER];
        }
        power.input += torques.spin * at.v[PLANET];
        (a, power)
    }

    fn linearise(&self, at: &Point<MOST>) -> Linearisation<MOST, Power> {
        let (acceleration, power) = self.evaluate(at);
        let (mut by_position, mut by_velocity, mut by_rate) =
            ([[0.0; MOST]; MOST], [[0.0; MOST]; MOST], [[0.0; MOST]; MOST]);
        let mut imposed = [[0.0; MOST]; 2];
        let mut out = Slopes {
            n: MOST,
            by_position: by_position.as_flattened_mut(),
            by_velocity: by_velocity.as_flattened_mut(),
            imposed: imposed.each_mut().map(|row| row.as_mut_slice()),
        };
        for effect in self.rigid.bodies.forces.iter() {
            effect.slopes(&self.bodies(at), &mut out);
        }
        for i in self.bodies_with_friction() {
            let [k, c] = self.friction.on(i).torque_slopes(&self.friction_state[i]);
            let body = self.freedom_of(i);
            if i < FRICTION_WHEELS {
                for (row, sign) in [(i, -1.0), (CARRIER, 1.0)] {
                    by_position[row][i] += sign * k;
                    by_rate[row][i] += sign * c;
                }
                continue;
            }
            // the angle of a wheel is that of the carrier, plus that of the side gear, less the twist
            let s = i - FRICTION_WHEELS;
            by_position[body][CARRIER] -= k;
            by_position[body][s] -= k;
            if body != s {
                by_position[body][body] += k;
            }
            by_velocity[body][body] -= c;
        }
        self.times_rates(&mut by_rate);
        let rigid = self.rigid;
        let follow = rigid.follow[0];
        let moved = |m: &Matrix<MOST>, imposed: &[f64; MOST]| -> Matrix<MOST> {
            let mut product = [[0.0; MOST]; MOST];
            for (i, row) in product.iter_mut().enumerate() {
                for k in 0..self.count() {
                    for j in 0..MOST {
                        row[j] += rigid.mobility[i][k] * m[k][j];
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
            power,
        }
    }

    fn is_driven(&self) -> bool {
        self.driven
    }

    fn evaluate_at(&self, at: &Point<MOST>, time: f64) -> ([f64; MOST], Power) {
        if self.driven { self.later(time).evaluate(at) } else { self.evaluate(at) }
    }

    fn linearise_at(&self, at: &Point<MOST>, time: f64) -> Linearisation<MOST, Power> {
        if self.driven { self.later(time).linearise(at) } else { self.linearise(at) }
    }

    fn drift(&self, at: &Point<MOST>, time: f64) -> [f64; MOST] {
        let [first, second] = self.later(time).input_derivatives.rates;
        self.forced(at, &first, &InputDerivatives { rates: [second, Inputs::ZERO] })
    }

    fn weights(&self, at: &Point<MOST>) -> Point<MOST> {
        let carrier = 1.0 + 2.0 * at.v[CARRIER].abs();
        let mut weights = Point { q: [1.0; MOST], v: [1.0 / (carrier + at.v[PLANET].abs()); MOST] };
        if self.friction.is_any() {
            // a stuck clutch or wheel turns by milliradians
            (weights.q[0], weights.q[1]) = (1e3, 1e3);
        }
        if self.ends() {
            for s in 0..2 {
                weights.q[self.end(s)] = 1.0 / (1e-3 + at.q[self.end(s)].abs());
            }
        }
        weights
    }

    fn crossing(&self, start: (&Point<MOST>, f64), end: (&Point<MOST>, f64)) -> Option<f64> {
        let surface_loads = [start, end].map(|(_, time)| self.surface_loads(time));
        self.bodies_with_friction()
            .filter_map(|i| {
                let slips = [self.slip(start.0, i), self.slip(end.0, i)];
                let ends = [(&slips[0], &surface_loads[0][i]), (&slips[1], &surface_loads[1][i])];
                self.friction.on(i).crossing(&self.friction_state[i], ends[0], ends[1])
            })
            .reduce(f64::min)
    }
}

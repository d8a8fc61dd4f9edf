//! The ideal differential with effects on bodies: Willis' equation stays a constraint, the rest is integrated.
//!
//! All speeds follow from those that the constraint leaves free: v = P u with u = (ω_c, ψ̇, ends). Forces Q then give
//! u̇ = (P_fᵀ M P_f)⁻¹ P_fᵀ (Q − M P_c u̇_c) for the free ones under the accelerations u̇_c of imposed ones, so that
//! v̇ = W Q + f u̇_c with constant W = P_f (P_fᵀ M P_f)⁻¹ P_fᵀ and f = (1 − W M) P_c. The torque of the meshes on a side
//! gear is the force of the constraint, λ_s = J_s ω̇_s − Q_s.

use std::sync::Arc;

use super::causes::CAUSES;
use super::course::Course;
use super::dry::{Clamp, Hold, Mode, Pressing, Turn};
use super::effect_specs::HalfShaftSpec;
use super::effects::{Action, Bodies, BodyEffect, Setting, Slopes, body_effects, grips, lock_grip};
use super::grip::Grip;
use super::ideal::Ideal;
use super::layout::{CARRIER, HOLDS, Layout, PLANET};
use super::parameters::Inputs;
use super::plan::Plan;
use super::power::Power;
use super::state::State;
use crate::integrate::{Linearisation, Matrix, Point, SecondOrder};

/// Degrees of freedom with ends of half-shafts.
const MOST: usize = 6;

/// Motions that may be imposed: carrier, spin, left and right end.
const IMPOSED: usize = 4;

/// Constants of an ideal differential with effects.
#[derive(Clone, Debug)]
pub struct Rigid {
    /// Scene plan.
    pub plan: Plan,
    layout: Layout,
    inertia: [f64; MOST],
    /// Inertias of ends that are rigid on their side gears [kg·m²].
    pub rigid_end: [f64; 2],
    ratio: f64,
    mobility: [[f64; MOST]; MOST],
    /// Columns of f: for the carrier, the spin and both ends; zero where the motion is not imposed.
    follow: [[f64; MOST]; IMPOSED],
    bodies: Arc<Vec<Box<dyn BodyEffect>>>,
    /// Dry friction that is always there.
    pub grips: Vec<Grip>,
    lock: Option<Grip>,
    /// The half-shafts.
    pub half_shaft: HalfShaftSpec,
    /// Whether there are effects; without any, a lock may still be commanded.
    pub always: bool,
}

impl Rigid {
    /// Constants of the scene.
    pub fn new(setting: &Setting, ideal: &Ideal) -> Self {
        let plan = *setting.plan;
        let layout = plan.layout();
        let (by_freedom, rigid_end) = ideal.inertia.by_freedom(&plan);
        let mut inertia: [f64; MOST] = std::array::from_fn(|i| by_freedom[i]);
        inertia[PLANET] = ideal.inertia.planets * ideal.inertia.planet;
        let n = layout.count();
        let r = ideal.ratio;
        // columns of P
        let carrier = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
        let end = |s: usize| std::array::from_fn(|i| f64::from(plan.shafts[s] && i == layout.end(s)));
        let columns = [carrier, [r, -r, 0.0, 1.0, 0.0, 0.0], end(0), end(1)];
        let imposed = [plan.carrier_imposed, plan.spin_imposed, plan.side_imposed[0], plan.side_imposed[1]];
        let moves = [true, true, plan.shafts[0], plan.shafts[1]];
        let free: Vec<[f64; MOST]> = (0..IMPOSED).filter(|&k| moves[k] && !imposed[k]).map(|k| columns[k]).collect();
        let p = nalgebra::DMatrix::from_fn(n, free.len(), |i, j| free[j][i]);
        let m = nalgebra::DMatrix::from_fn(n, n, |i, j| if i == j { inertia[i] } else { 0.0 });
        // inertias are positive, so that the reduced matrix has an inverse
        let reduced = (p.transpose() * &m * &p).try_inverse();
        let w = reduced.map_or_else(|| nalgebra::DMatrix::zeros(n, n), |inverse| &p * inverse * p.transpose());
        let c = nalgebra::DMatrix::from_fn(n, IMPOSED, |i, k| if imposed[k] { columns[k][i] } else { 0.0 });
        let follow = &c - &w * &m * &c;
        let bodies = body_effects(setting);
        let grips = grips(setting);
        let mut this = Self {
            plan,
            layout,
            inertia,
            rigid_end,
            ratio: r,
            mobility: [[0.0; MOST]; MOST],
            follow: [[0.0; MOST]; IMPOSED],
            always: !bodies.is_empty() || !grips.is_empty(),
            bodies: Arc::new(bodies),
            grips,
            lock: lock_grip(&setting.parameters.specs),
            half_shaft: setting.parameters.specs.half_shaft,
        };
        for i in 0..n {
            for k in 0..IMPOSED {
                this.follow[k][i] = follow[(i, k)];
            }
            for j in 0..n {
                this.mobility[i][j] = w[(i, j)];
            }
        }
        this
    }

    /// Sets the speeds of the side gears by Willis' equation: rounding may have moved them off it.
    pub fn constrain(&self, state: &mut State) {
        let (carrier, spin) = (state.v[CARRIER], state.v[PLANET]);
        state.v[0] = carrier + self.ratio * spin;
        state.v[1] = carrier - self.ratio * spin;
    }

    fn clamp(&self, lock: f64) -> Clamp {
        let lock = self.lock.filter(|_| lock > 0.0).map(|g| g.scaled(lock));
        Clamp::of(self.grips.iter().chain(&lock))[0]
    }

    /// Whether effects act: those of the scene, a lock that is commanded, or inputs on their way.
    pub fn acts(&self, state: &State) -> bool {
        self.always || state.lock > 0.0 || state.course.is_some()
    }

    /// Speed that an imposed carrier has instead of its command.
    pub fn carrier_speed(&self, state: &State, command: f64) -> f64 {
        self.bodies.iter().fold(command, |speed, effect| effect.carrier_speed(&state.q, speed))
    }
}

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
pub struct RigidEquations<'a, const N: usize> {
    /// Constants.
    pub rigid: &'a Rigid,
    inputs: Inputs,
    course: Course,
    driven: bool,
    /// What dry friction holds.
    pub holds: [Hold; HOLDS],
    clamp: Clamp,
}

impl<'a, const N: usize> RigidEquations<'a, N> {
    /// Whether half-shafts have ends.
    const ENDS: bool = N > PLANET + 1;

    /// Equations under `inputs` at `state`.
    pub fn new(rigid: &'a Rigid, inputs: &Inputs, state: &State) -> Self {
        let inputs = Inputs { carrier_speed: state.carrier_command, ..*inputs };
        let (course, driven) = (state.course.unwrap_or(Course::STILL), state.course.is_some());
        Self { rigid, inputs, course, driven, holds: state.holds, clamp: rigid.clamp(state.lock) }
    }

    fn bodies<'b>(&'b self, at: &'b Point<N>) -> Bodies<'b> {
        let Self { inputs, course, .. } = self;
        Bodies { q: &at.q, v: &at.v, layout: &self.rigid.layout, inputs, input_rates: &course.rates[0] }
    }

    fn turn(&self, at: &Point<N>, s: usize) -> Turn {
        Turn { position: at.q[s], speed: at.v[s] - at.v[CARRIER] }
    }

    fn wheel(&self, s: usize) -> usize {
        if Self::ENDS && self.rigid.plan.shafts[s] { N - 2 + s } else { s }
    }

    /// The equations `time` [s] later, as far as inputs go.
    fn later(&self, time: f64) -> Self {
        let (inputs, course) = self.course.after(time, &self.inputs);
        self.under(&inputs, &course)
    }

    /// The same equations under other inputs.
    pub(super) fn under(&self, inputs: &Inputs, course: &Course) -> Self {
        Self { inputs: *inputs, course: *course, ..*self }
    }

    /// Forces, all commanded torques but those of imposed motions among them, and the accelerations of imposed motions.
    fn forces(&self, at: &Point<N>, power: &mut Power) -> ([f64; N], [f64; IMPOSED]) {
        let rates = &self.course.rates[0];
        let (mut sum, mut imposed) = ([0.0; N], rates.carrier_speed);
        let mut out = Action { force: &mut sum, imposed: &mut imposed, drive: &mut power.drive, heat: &mut power.heat };
        for effect in self.rigid.bodies.iter() {
            effect.act(&self.bodies(at), &mut out);
        }
        let plan = &self.rigid.plan;
        let by = Pressing::default();
        for s in 0..2 {
            if self.clamp.is_on() {
                let turn = self.turn(at, s);
                let torque = self.clamp.torque(&self.holds[s], &turn, &by);
                sum[s] -= torque;
                sum[CARRIER] += torque;
                self.clamp.heat(&self.holds[s], &turn, &by, 1.0, &mut power.heat);
            }
            power.shaft[s] = self.inputs.load_torque[s];
            if Self::ENDS && plan.shafts[s] {
                let end = N - 2 + s;
                power.shaft[s] = self.rigid.half_shaft.stiffness[s] * at.q[end]
                    + self.rigid.half_shaft.damping[s] * (at.v[s] - at.v[end]);
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

    fn accelerations(&self, sum: &[f64; N], imposed: &[f64; IMPOSED]) -> [f64; N] {
        let rigid = self.rigid;
        std::array::from_fn(|i| {
            let free: f64 = (0..N).map(|j| rigid.mobility[i][j] * sum[j]).sum();
            free + (0..IMPOSED).map(|k| rigid.follow[k][i] * imposed[k]).sum::<f64>()
        })
    }

    /// The part of the accelerations that inputs `inputs` on the course `course` have, for accelerations are linear in both.
    pub(super) fn forced(&self, at: &Point<N>, inputs: &Inputs, course: &Course) -> [f64; N] {
        let part = |inputs: &Inputs, course: &Course| {
            let these = self.under(inputs, course);
            let (sum, imposed) = these.forces(at, &mut Power::default());
            these.accelerations(&sum, &imposed)
        };
        let (with, without) = (part(inputs, course), part(&Inputs::ZERO, &Course::STILL));
        std::array::from_fn(|i| with[i] - without[i])
    }

    fn torques_of(&self, sum: &[f64; N], a: &[f64; N], excess: f64) -> RigidTorques {
        let rigid = self.rigid;
        let lack: [f64; N] = std::array::from_fn(|i| rigid.inertia[i] * a[i] - sum[i]);
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
    pub fn torques(&self, at: &Point<N>) -> RigidTorques {
        let mut power = Power::default();
        let (sum, imposed) = self.forces(at, &mut power);
        self.torques_of(&sum, &self.accelerations(&sum, &imposed), power.drive)
    }

    /// Energy of half-shafts and holds [J].
    fn stored(&self, at: &Point<N>) -> f64 {
        let bodies: f64 = self.rigid.bodies.iter().map(|e| e.energy(&self.bodies(at))).sum();
        bodies + (0..2).map(|s| self.clamp.energy(&self.holds[s], at.q[s])).sum::<f64>()
    }

    /// How far each hold is from its switch, where there is one.
    pub(super) fn margins(&self, at: &Point<N>) -> [Option<f64>; HOLDS] {
        let margin = |s: usize| self.clamp.margin(&self.holds[s], &self.turn(at, s), &Pressing::default());
        std::array::from_fn(|i| (i < 2 && self.clamp.is_on()).then(|| margin(i)))
    }

    /// Whether a hold is due to switch.
    pub fn hold_is_due(&self, at: &Point<N>) -> bool {
        let due = |s: usize| self.clamp.is_due(&self.holds[s], &self.turn(at, s), &Pressing::default());
        self.clamp.is_on() && (due(0) || due(1))
    }

    /// Drags the anchors of sides that slide along to `at`.
    pub fn drag_anchors(&self, at: &Point<N>, anchors: &mut [f64; HOLDS]) {
        for s in (0..2).filter(|&s| self.holds[s].mode != Mode::Stuck) {
            anchors[s] = self.clamp.drag(anchors[s], &self.turn(at, s), &Pressing::default());
        }
    }

    /// Switches holds that are due and books what their springs give up.
    pub fn settle_holds(&mut self, at: &Point<N>, heat: &mut [f64; CAUSES]) {
        for s in (0..2).filter(|_| self.clamp.is_on()) {
            let turn = self.turn(at, s);
            self.clamp.settle(&mut self.holds[s], &turn, &Pressing::default(), 1.0, heat);
        }
    }

    /// Takes holds over from another stiffness.
    pub fn take_over(&mut self, at: &Point<N>, heat: &mut [f64; CAUSES]) {
        for s in 0..2 {
            let turn = self.turn(at, s);
            self.clamp.take_over(&mut self.holds[s], &turn, heat, 1.0);
        }
    }
}

impl<const N: usize> SecondOrder<N> for RigidEquations<'_, N> {
    type Power = Power;

    fn energy(&self, at: &Point<N>) -> [f64; 2] {
        let kinetic: f64 = (0..N).map(|i| self.rigid.inertia[i] * at.v[i] * at.v[i]).sum();
        [0.5 * kinetic, self.stored(at)]
    }

    fn imbalance(&self, energies: [[f64; 2]; 2], h: f64, power: &[Power; 3]) -> f64 {
        Power::imbalance::<true>(energies, h, power)
    }

    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        let mut rates = *v;
        for s in 0..2 {
            rates[s] -= v[CARRIER];
            if Self::ENDS {
                rates[N - 2 + s] = v[s] - v[N - 2 + s];
            }
        }
        rates
    }

    fn times_rates(&self, m: &mut Matrix<N>) {
        for row in m.iter_mut() {
            row[CARRIER] -= row[0] + row[1];
            if Self::ENDS {
                for s in 0..2 {
                    row[s] += row[N - 2 + s];
                    row[N - 2 + s] = -row[N - 2 + s];
                }
            }
        }
    }

    fn evaluate(&self, at: &Point<N>) -> ([f64; N], Power) {
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

    fn linearise(&self, at: &Point<N>) -> Linearisation<N, Power> {
        let (acceleration, power) = self.evaluate(at);
        let (mut by_position, mut by_velocity, mut by_rate) = ([[0.0; N]; N], [[0.0; N]; N], [[0.0; N]; N]);
        let mut imposed = [[0.0; N]; 2];
        let mut out = Slopes {
            n: N,
            by_position: by_position.as_flattened_mut(),
            by_velocity: by_velocity.as_flattened_mut(),
            imposed: imposed.each_mut().map(|row| row.as_mut_slice()),
        };
        for effect in self.rigid.bodies.iter() {
            effect.slopes(&self.bodies(at), &mut out);
        }
        for s in (0..2).filter(|_| self.clamp.is_on()) {
            let [k, c] = self.clamp.torque_slopes(&self.holds[s]);
            for (row, sign) in [(s, -1.0), (CARRIER, 1.0)] {
                by_position[row][s] += sign * k;
                by_rate[row][s] += sign * c;
            }
        }
        self.times_rates(&mut by_rate);
        let rigid = self.rigid;
        let follow = rigid.follow[0];
        let moved = |m: &Matrix<N>, imposed: &[f64; N]| -> Matrix<N> {
            std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    (0..N).map(|k| rigid.mobility[i][k] * m[k][j]).sum::<f64>() + follow[i] * imposed[j]
                })
            })
        };
        for i in 0..N {
            for j in 0..N {
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

    fn evaluate_at(&self, at: &Point<N>, time: f64) -> ([f64; N], Power) {
        if self.driven { self.later(time).evaluate(at) } else { self.evaluate(at) }
    }

    fn linearise_at(&self, at: &Point<N>, time: f64) -> Linearisation<N, Power> {
        if self.driven { self.later(time).linearise(at) } else { self.linearise(at) }
    }

    fn drift(&self, at: &Point<N>, time: f64) -> [f64; N] {
        let [first, second] = self.later(time).course.rates;
        self.forced(at, &first, &Course { rates: [second, Inputs::ZERO] })
    }

    fn weights(&self, at: &Point<N>) -> Point<N> {
        let carrier = 1.0 + 2.0 * at.v[CARRIER].abs();
        let mut weights = Point { q: [1.0; N], v: [1.0 / (carrier + at.v[PLANET].abs()); N] };
        if self.clamp.is_on() {
            // a stuck clutch turns by milliradians
            (weights.q[0], weights.q[1]) = (1e3, 1e3);
        }
        if Self::ENDS {
            for s in 0..2 {
                weights.q[N - 2 + s] = 1.0 / (1e-3 + at.q[N - 2 + s].abs());
            }
        }
        weights
    }

    fn crossing(&self, start: &Point<N>, end: &Point<N>) -> Option<f64> {
        if !self.clamp.is_on() {
            return None;
        }
        let by = Pressing::default();
        (0..2)
            .filter_map(|s| {
                let turns = [self.turn(start, s), self.turn(end, s)];
                self.clamp.crossing(&self.holds[s], (&turns[0], &by), (&turns[1], &by))
            })
            .reduce(f64::min)
    }
}

//! Equations of motion with tooth contact.
//!
//! Degrees of freedom: α_L, α_R (side gears relative to the carrier), θ_c, and the spin ψ of each group of planets;
//! velocities ω_L, ω_R, ω_c (absolute) and ψ̇, in which the kinetic energy is diagonal:
//!
//!   J_s ω̇_s = Σ Q_α − T_s,   J_c ω̇_c = T_c − Σ_s Σ Q_α,   I_p ψ̈ = Q_ψL + Q_ψR,   α̇_s = ω_s − ω_c
//!
//! with q = sinδ_bs α − σ sinδ_bp ψ and x = σ sinδ_bp ψ + h of every mesh, σ = +1 left, −1 right, and the mesh forces
//! Q_α = sinδ_bs F_q, Q_ψ = σ sinδ_bp (F_x − F_q). Imposed motions have zero acceleration.

use super::bodies::Inertias;
use super::parameters::Inputs;
use super::plan::Plan;
use super::state::{CARRIER, LEFT, MAX_DOF, PLANET, State};
use crate::contact::mesh::{Mesh, MeshForce, MeshState};
use crate::geometry::Pair;
use crate::integrate::{Linearisation, Matrix, Point, Power, SecondOrder};

/// Sign σ of the left and right side.
pub const SIGMA: [f64; 2] = [1.0, -1.0];

/// Approach below which positions are resolved absolutely rather than relatively [rad on the unit sphere].
const APPROACH_FLOOR: f64 = 1e-4;
/// Speed below which velocities are resolved absolutely rather than relatively [rad/s].
const SPEED_FLOOR: f64 = 1.0;

/// A differential with teeth: constants of the equations of motion.
#[derive(Clone, Debug)]
pub struct Teeth {
    /// The mesh, alike for all planets and both sides.
    pub mesh: Mesh,
    /// Scene plan.
    pub plan: Plan,
    /// Inertias.
    pub inertia: Inertias,
    /// Reciprocal inertias by degree of freedom, 0 where the motion is imposed [1/(kg·m²)].
    inverse_inertia: [f64; MAX_DOF],
    /// sinδ_b of planet and side gear.
    pub lever: [f64; 2],
    /// Base pitch on the unit sphere [rad].
    pub base_pitch: f64,
    /// Approach beyond which a tooth would jump [rad].
    pub jump: f64,
}

impl Teeth {
    /// Constants of the scene `plan` with the meshes `mesh` of `pair`.
    pub fn new(pair: &Pair, mesh: Mesh, plan: Plan, inertia: Inertias, jump: f64) -> Self {
        let imposed = |imposed: bool, inertia: f64| if imposed { 0.0 } else { 1.0 / inertia };
        let mut inverse_inertia = [imposed(plan.spin_imposed, inertia.planet); MAX_DOF];
        inverse_inertia[0] = 1.0 / inertia.side[0];
        inverse_inertia[1] = 1.0 / inertia.side[1];
        inverse_inertia[CARRIER] = imposed(plan.carrier_imposed, inertia.carrier);
        Self { mesh, plan, inertia, inverse_inertia, lever: pair.lever(), base_pitch: pair.base_pitch, jump }
    }
}

/// The equations under given inputs, for `N` degrees of freedom: `N` − 3 groups of planets.
pub struct Equations<'a, const N: usize> {
    /// Constants.
    pub teeth: &'a Teeth,
    inputs: Inputs,
    /// Relative position taken out by wrapping, by group and side [rad].
    offset: [[f64; 2]; MAX_DOF - PLANET],
}

impl<'a, const N: usize> Equations<'a, N> {
    /// Groups of planets.
    const GROUPS: usize = N - PLANET;

    /// Equations at `state`'s wrapping under `inputs`.
    pub fn new(teeth: &'a Teeth, inputs: &Inputs, state: &State) -> Self {
        let mut offset = [[0.0; 2]; MAX_DOF - PLANET];
        for (g, pair) in offset.iter_mut().enumerate().take(Self::GROUPS) {
            for s in 0..2 {
                let spin = if s == 0 { state.turns[PLANET + g] } else { -state.turns[PLANET + g] };
                pair[s] = teeth.base_pitch * (state.turns[LEFT + s] - spin) as f64;
            }
        }
        Self { teeth, inputs: *inputs, offset }
    }

    /// State of the mesh of group `g` with side `s`.
    #[inline]
    pub fn mesh_state(&self, at: &Point<N>, g: usize, s: usize) -> MeshState {
        let [planet, side] = self.teeth.lever;
        let turn = SIGMA[s] * planet;
        let (travel, travel_rate) = (turn * at.q[PLANET + g], turn * at.v[PLANET + g]);
        MeshState {
            position: [side * at.q[s] - travel + self.offset[g][s], travel + self.teeth.plan.group(g).phase[s]],
            rate: [side * (at.v[s] - at.v[CARRIER]) - travel_rate, travel_rate],
        }
    }

    /// Turns the sums of tooth torques in `sum` into accelerations; `heat` goes into the ledger rates.
    #[inline]
    pub fn finish(&self, at: &Point<N>, sum: &mut [f64; N], heat: f64) -> Power {
        let (plan, inverse) = (&self.teeth.plan, &self.teeth.inverse_inertia);
        let mut input = 0.0;
        for s in 0..2 {
            input -= self.inputs.load_torque[s] * at.v[s];
            sum[s] = (sum[s] - self.inputs.load_torque[s]) * inverse[s];
        }
        let drive = if plan.carrier_imposed { -sum[CARRIER] } else { self.inputs.carrier_torque };
        input += drive * at.v[CARRIER];
        sum[CARRIER] = (sum[CARRIER] + drive) * inverse[CARRIER];
        for g in 0..Self::GROUPS {
            let torque = &mut sum[PLANET + g];
            if plan.spin_imposed {
                input -= plan.group(g).members * *torque * at.v[PLANET + g];
            }
            *torque *= inverse[PLANET + g];
        }
        Power { input, heat }
    }

    #[inline]
    fn add_forces(&self, load: &MeshForce, g: usize, s: usize, sum: &mut [f64; N]) {
        let [planet, side] = self.teeth.lever;
        let members = self.teeth.plan.group(g).members;
        let on_side = members * side * load.force[0];
        sum[s] += on_side;
        sum[CARRIER] -= on_side;
        sum[PLANET + g] += SIGMA[s] * planet * (load.force[1] - load.force[0]);
    }

    /// Adds `by` = ∂(F_q, F_x)/∂(q, x) as ∂(sums)/∂(α_s, ψ_g).
    #[inline]
    fn add_jacobian(&self, by: &[[f64; 2]; 2], g: usize, s: usize, m: &mut Matrix<N>) {
        let [planet, side] = self.teeth.lever;
        let members = self.teeth.plan.group(g).members;
        let turn = SIGMA[s] * planet;
        // columns: by α, by ψ
        let of_q = [side * by[0][0], turn * (by[0][1] - by[0][0])];
        let of_x = [side * by[1][0], turn * (by[1][1] - by[1][0])];
        for (column, c) in [s, PLANET + g].into_iter().enumerate() {
            let on_side = members * side * of_q[column];
            m[s][c] += on_side;
            m[CARRIER][c] -= on_side;
            m[PLANET + g][c] += turn * (of_x[column] - of_q[column]);
        }
    }

    fn divide_by_inertia(&self, m: &mut Matrix<N>) {
        for (row, inverse) in m.iter_mut().zip(&self.teeth.inverse_inertia) {
            row.iter_mut().for_each(|x| *x *= inverse);
        }
    }

    /// Sums of tooth torques on side gears, carrier and each planet, and the heat, without any input.
    pub fn tooth_torques(&self, at: &Point<N>) -> ([f64; N], f64) {
        let (mut sum, mut heat) = ([0.0; N], 0.0);
        self.each_mesh(|g, s| {
            let load = self.teeth.mesh.force(&self.mesh_state(at, g, s));
            heat += self.teeth.plan.group(g).members * load.heat;
            self.add_forces(&load, g, s, &mut sum);
        });
        (sum, heat)
    }

    /// ∂(tooth torques)/∂q, for the static equilibrium.
    pub fn tooth_stiffness(&self, at: &Point<N>) -> Matrix<N> {
        let mut m = [[0.0; N]; N];
        self.each_mesh(|g, s| {
            let mut state = self.mesh_state(at, g, s);
            state.rate = [0.0; 2];
            self.add_jacobian(&self.teeth.mesh.linearise(&state).1.by_position, g, s, &mut m);
        });
        m
    }

    /// Elastic energy of all meshes [J].
    pub fn elastic_energy(&self, at: &Point<N>) -> f64 {
        let mut energy = 0.0;
        self.each_mesh(|g, s| {
            let position = self.mesh_state(at, g, s).position;
            energy += self.teeth.plan.group(g).members * self.teeth.mesh.energy(position);
        });
        energy
    }

    /// Kinetic energy [J].
    fn kinetic_energy(&self, at: &Point<N>) -> f64 {
        let inertia = &self.teeth.inertia;
        let v = &at.v;
        let mut twice = inertia.side[0] * v[0] * v[0] + inertia.side[1] * v[1] * v[1];
        twice += inertia.carrier * v[CARRIER] * v[CARRIER];
        for g in 0..Self::GROUPS {
            twice += self.teeth.plan.group(g).members * inertia.planet * v[PLANET + g] * v[PLANET + g];
        }
        0.5 * twice
    }

    /// Kinetic and elastic energy [J].
    pub fn energy(&self, at: &Point<N>) -> f64 {
        self.kinetic_energy(at) + self.elastic_energy(at)
    }

    /// Largest approach of any flank pair [rad], negative inside the lash, with its group and side. Groups
    /// are numbered in the order of their first planets, which are the first planets of all.
    #[inline]
    pub fn deepest(&self, at: &Point<N>) -> (f64, usize, usize) {
        let mut deepest = (f64::NEG_INFINITY, 0, 0);
        self.each_mesh(|g, s| {
            let approach = self.teeth.mesh.approach(self.mesh_state(at, g, s).position[0]);
            if approach > deepest.0 {
                deepest = (approach, g, s);
            }
        });
        // groups are numbered in the order of their first planets, which are neighbours
        deepest
    }

    #[inline]
    fn each_mesh(&self, mut visit: impl FnMut(usize, usize)) {
        for g in 0..Self::GROUPS {
            for s in 0..2 {
                visit(g, s);
            }
        }
    }
}

impl<const N: usize> SecondOrder<N> for Equations<'_, N> {
    #[inline]
    fn rates(&self, v: &[f64; N]) -> [f64; N] {
        let mut rates = *v;
        rates[0] -= v[CARRIER];
        rates[1] -= v[CARRIER];
        rates
    }

    #[inline]
    fn times_rates(&self, m: &mut Matrix<N>) {
        for row in m.iter_mut() {
            row[CARRIER] -= row[0] + row[1];
        }
    }

    #[inline]
    fn evaluate(&self, at: &Point<N>) -> ([f64; N], Power) {
        let (mut sum, heat) = self.tooth_torques(at);
        let power = self.finish(at, &mut sum, heat);
        (sum, power)
    }

    fn linearise(&self, at: &Point<N>) -> Linearisation<N> {
        let (mut acceleration, mut heat) = ([0.0; N], 0.0);
        let (mut by_position, mut by_velocity) = ([[0.0; N]; N], [[0.0; N]; N]);
        self.each_mesh(|g, s| {
            let (load, jacobian) = self.teeth.mesh.linearise(&self.mesh_state(at, g, s));
            heat += self.teeth.plan.group(g).members * load.heat;
            self.add_forces(&load, g, s, &mut acceleration);
            self.add_jacobian(&jacobian.by_position, g, s, &mut by_position);
            self.add_jacobian(&jacobian.by_rate, g, s, &mut by_velocity);
        });
        self.divide_by_inertia(&mut by_position);
        self.divide_by_inertia(&mut by_velocity);
        // α̇ = ω_s − ω_c
        self.times_rates(&mut by_velocity);
        let power = self.finish(at, &mut acceleration, heat);
        Linearisation { acceleration, by_position, by_velocity, power }
    }

    #[inline]
    fn weights(&self, at: &Point<N>) -> Point<N> {
        let per_approach = 1.0 / (self.deepest(at).0.max(0.0) + APPROACH_FLOOR);
        let [planet, side] = self.teeth.lever.map(|lever| lever * per_approach);
        let mut q = [planet; N];
        (q[0], q[1], q[CARRIER]) = (side, side, 1.0);
        // speeds by what the gears roll with: blows between teeth add to a gear's speed, not to the error it may have
        let carrier = SPEED_FLOOR + 2.0 * at.v[CARRIER].abs();
        let spin = at.v[PLANET..].iter().fold(0.0, |fastest: f64, v| fastest.max(v.abs()));
        let side = 1.0 / (carrier + spin * self.teeth.lever[0] / self.teeth.lever[1]);
        let mut v = [1.0 / (carrier + spin); N];
        (v[0], v[1], v[CARRIER]) = (side, side, 1.0 / carrier);
        Point { q, v }
    }
}

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
use super::state::{CARRIER, LEFT, PLANET, State};
use crate::contact::mesh::{Mesh, MeshLoad, MeshState};
use crate::integrate::{Linearisation, MAX_DOF, Matrix, Point, Power, SecondOrder, Vector, ZERO};

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
    /// sinδ_b of planet and side gear.
    pub lever: [f64; 2],
    /// Base pitch on the unit sphere [rad].
    pub base_pitch: f64,
    /// Approach beyond which a tooth would jump [rad].
    pub jump: f64,
}

/// The equations under given inputs.
pub struct Equations<'a> {
    /// Constants.
    pub teeth: &'a Teeth,
    inputs: Inputs,
    /// Relative position taken out by wrapping, by group and side [rad].
    offset: [[f64; 2]; MAX_DOF - PLANET],
}

impl<'a> Equations<'a> {
    /// Equations at `state`'s wrapping under `inputs`.
    pub fn new(teeth: &'a Teeth, inputs: &Inputs, state: &State) -> Self {
        let mut offset = [[0.0; 2]; MAX_DOF - PLANET];
        for (g, pair) in offset.iter_mut().enumerate().take(teeth.plan.groups().len()) {
            for s in 0..2 {
                let spin = if s == 0 { state.turns[PLANET + g] } else { -state.turns[PLANET + g] };
                pair[s] = teeth.base_pitch * (state.turns[LEFT + s] - spin) as f64;
            }
        }
        Self { teeth, inputs: *inputs, offset }
    }

    /// State of the mesh of group `g` with side `s`.
    #[inline]
    pub fn mesh_state(&self, at: &Point, g: usize, s: usize) -> MeshState {
        let [planet, side] = self.teeth.lever;
        let spin = |psi: f64| SIGMA[s] * planet * psi;
        let travel = spin(at.q[PLANET + g]);
        let travel_rate = spin(at.v[PLANET + g]);
        MeshState {
            position: [side * at.q[s] - travel + self.offset[g][s], travel + self.teeth.plan.groups()[g].phase[s]],
            rate: [side * (at.v[s] - at.v[CARRIER]) - travel_rate, travel_rate],
        }
    }

    /// Turns the sums of tooth torques in `sum` into accelerations.
    #[inline]
    fn finish(&self, at: &Point, sum: &mut Vector, heat: f64) -> Power {
        let (plan, inertia) = (&self.teeth.plan, &self.teeth.inertia);
        let mut input = 0.0;
        for s in 0..2 {
            input -= self.inputs.load_torque[s] * at.v[s];
            sum[s] = (sum[s] - self.inputs.load_torque[s]) / inertia.side[s];
        }
        let drive = if plan.carrier_imposed { -sum[CARRIER] } else { self.inputs.carrier_torque };
        input += drive * at.v[CARRIER];
        sum[CARRIER] = if plan.carrier_imposed { 0.0 } else { (sum[CARRIER] + drive) / inertia.carrier };
        for (g, group) in plan.groups().iter().enumerate() {
            let torque = &mut sum[PLANET + g];
            if plan.spin_imposed {
                input -= group.members * *torque * at.v[PLANET + g];
                *torque = 0.0;
            } else {
                *torque /= inertia.planet;
            }
        }
        Power { input, heat }
    }

    #[inline]
    fn add_forces(&self, load: &MeshLoad, g: usize, s: usize, sum: &mut Vector) {
        let [planet, side] = self.teeth.lever;
        let members = self.teeth.plan.groups()[g].members;
        let on_side = members * side * load.force[0];
        sum[s] += on_side;
        sum[CARRIER] -= on_side;
        sum[PLANET + g] += SIGMA[s] * planet * (load.force[1] - load.force[0]);
    }

    /// Adds `by` = ∂(F_q, F_x)/∂(q, x) as ∂(sums)/∂(α_s, ψ_g).
    #[inline]
    fn add_jacobian(&self, by: &[[f64; 2]; 2], g: usize, s: usize, m: &mut Matrix) {
        let [planet, side] = self.teeth.lever;
        let members = self.teeth.plan.groups()[g].members;
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

    fn divide_by_inertia(&self, m: &mut Matrix) {
        let (plan, inertia) = (&self.teeth.plan, &self.teeth.inertia);
        let n = self.dof();
        let mut scale = |row: usize, factor: f64| m[row].iter_mut().take(n).for_each(|x| *x *= factor);
        for s in 0..2 {
            scale(s, 1.0 / inertia.side[s]);
        }
        scale(CARRIER, if plan.carrier_imposed { 0.0 } else { 1.0 / inertia.carrier });
        for g in 0..plan.groups().len() {
            scale(PLANET + g, if plan.spin_imposed { 0.0 } else { 1.0 / inertia.planet });
        }
    }

    /// Sums of tooth torques on side gears, carrier and each planet, and the heat, without any input.
    pub fn tooth_torques(&self, at: &Point) -> (Vector, f64) {
        let (mut sum, mut heat) = (ZERO, 0.0);
        self.each_mesh(|g, s| {
            let load = self.teeth.mesh.load::<false>(&self.mesh_state(at, g, s));
            heat += self.teeth.plan.groups()[g].members * load.heat;
            self.add_forces(&load, g, s, &mut sum);
        });
        (sum, heat)
    }

    /// ∂(tooth torques)/∂q, for the static equilibrium.
    pub fn tooth_stiffness(&self, at: &Point) -> Matrix {
        let mut m = [ZERO; MAX_DOF];
        self.each_mesh(|g, s| {
            let mut state = self.mesh_state(at, g, s);
            state.rate = [0.0; 2];
            self.add_jacobian(&self.teeth.mesh.load::<true>(&state).by_position, g, s, &mut m);
        });
        m
    }

    /// Elastic energy of all meshes [J].
    pub fn elastic_energy(&self, at: &Point) -> f64 {
        let mut energy = 0.0;
        self.each_mesh(|g, s| {
            let position = self.mesh_state(at, g, s).position;
            energy += self.teeth.plan.groups()[g].members * self.teeth.mesh.energy(position);
        });
        energy
    }

    /// Kinetic energy [J].
    pub fn kinetic_energy(&self, at: &Point) -> f64 {
        let inertia = &self.teeth.inertia;
        let v = &at.v;
        let mut twice = inertia.side[0] * v[0] * v[0] + inertia.side[1] * v[1] * v[1];
        twice += inertia.carrier * v[CARRIER] * v[CARRIER];
        for (g, group) in self.teeth.plan.groups().iter().enumerate() {
            twice += group.members * inertia.planet * v[PLANET + g] * v[PLANET + g];
        }
        0.5 * twice
    }

    /// Largest approach of any flank pair [rad]; negative inside the lash.
    #[inline]
    pub fn largest_approach(&self, at: &Point) -> f64 {
        let mut largest = f64::NEG_INFINITY;
        self.each_mesh(|g, s| {
            largest = largest.max(self.teeth.mesh.approach(self.mesh_state(at, g, s).position[0]));
        });
        largest
    }

    #[inline]
    fn each_mesh(&self, mut visit: impl FnMut(usize, usize)) {
        for g in 0..self.teeth.plan.groups().len() {
            for s in 0..2 {
                visit(g, s);
            }
        }
    }
}

impl SecondOrder for Equations<'_> {
    fn dof(&self) -> usize {
        PLANET + self.teeth.plan.groups().len()
    }

    fn rates(&self, v: &Vector) -> Vector {
        let mut rates = *v;
        rates[0] -= v[CARRIER];
        rates[1] -= v[CARRIER];
        rates
    }

    fn times_rates(&self, m: &mut Matrix) {
        for row in m.iter_mut().take(self.dof()) {
            row[CARRIER] -= row[0] + row[1];
        }
    }

    fn evaluate(&self, at: &Point, acceleration: &mut Vector) -> Power {
        let (sum, heat) = self.tooth_torques(at);
        *acceleration = sum;
        self.finish(at, acceleration, heat)
    }

    fn linearise(&self, at: &Point, out: &mut Linearisation) {
        let mut heat = 0.0;
        self.each_mesh(|g, s| {
            let load = self.teeth.mesh.load::<true>(&self.mesh_state(at, g, s));
            heat += self.teeth.plan.groups()[g].members * load.heat;
            self.add_forces(&load, g, s, &mut out.acceleration);
            self.add_jacobian(&load.by_position, g, s, &mut out.by_position);
            self.add_jacobian(&load.by_rate, g, s, &mut out.by_velocity);
        });
        self.divide_by_inertia(&mut out.by_position);
        self.divide_by_inertia(&mut out.by_velocity);
        // α̇ = ω_s − ω_c
        self.times_rates(&mut out.by_velocity);
        out.power = self.finish(at, &mut out.acceleration, heat);
    }

    fn scales(&self, at: &Point) -> Point {
        let approach = self.largest_approach(at).max(0.0) + APPROACH_FLOOR;
        let [planet, side] = self.teeth.lever;
        let carrier = at.v[CARRIER].abs() + SPEED_FLOOR;
        let mut scale = Point { q: [approach / planet; MAX_DOF], v: [carrier; MAX_DOF] };
        for s in 0..2 {
            scale.q[s] = approach / side;
        }
        scale.q[CARRIER] = 1.0;
        for i in 0..self.dof() {
            scale.v[i] += at.v[i].abs();
        }
        scale
    }
}

//! Ideal differential: no teeth, Willis' equation as a constraint, two degrees of freedom ω_c and ψ̇.
//!
//! With ω_L,R = ω_c ± r ψ̇, r = z_p/z_s, the kinetic energy gives M (ω̇_c, ψ̈)ᵀ = (T_c − T_L − T_R, r (T_R − T_L) +
//! T_ψ)ᵀ, M = [[J_c + J_L + J_R, r (J_L − J_R)], [·, r² (J_L + J_R) + N I_p]]. Inputs are constants or parabolas of
//! time between communication points, so speeds and angles are polynomials of time, and each step is exact.

use super::Inertias;
use crate::model::scene::{CARRIER, InputDerivatives, Inputs, PLANET, Plan};

/// Constants of the ideal differential.
#[derive(Clone, Copy, Debug)]
pub struct Ideal {
    /// Scene plan.
    pub plan: Plan,
    /// Inertias.
    pub inertia: Inertias,
    /// r = z_p/z_s.
    pub ratio: f64,
}

/// Accelerations and the torques of the drives, or their derivatives with respect to time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IdealMotion {
    /// ω̇_c [rad/s²].
    pub carrier: f64,
    /// ψ̈ [rad/s²].
    pub spin: f64,
    /// Torque on the carrier [N·m].
    pub carrier_torque: f64,
    /// Torque that imposes the spin, summed over all planets [N·m].
    pub spin_torque: f64,
    /// Sums of all torques that work at ω_c and at ψ̇ [N·m].
    pub net: [f64; 2],
}

impl Ideal {
    /// M of the equations of motion: m₁₁, m₁₂, m₂₂ [kg·m²].
    fn mass(&self) -> [f64; 3] {
        let (r, j) = (self.ratio, &self.inertia);
        let [left, right] = self.side_inertia();
        [j.carrier + left + right, r * (left - right), r * r * (left + right) + j.planets * j.planet]
    }

    /// Inertias of the side gears with their rigid ends [kg·m²]. An end behind a shaft that twists does not move with
    /// its gear.
    fn side_inertia(&self) -> [f64; 2] {
        let j = &self.inertia;
        [0, 1].map(|s| j.side[s] - if self.plan.shafts[s] { j.end[s] } else { 0.0 })
    }

    /// Ratios Δψ̇/Δω_c and Δω_c/Δψ̇ of the jump of a free speed to the jump of an imposed speed. A ratio is 0 unless
    /// only its denominator is imposed. Sides of unequal inertia couple both speeds.
    pub fn impulse(&self) -> [f64; 2] {
        let [m11, m12, m22] = self.mass();
        let plan = &self.plan;
        let carrier = plan.drive_imposed && plan.drives_carrier();
        [
            if carrier && !plan.spin_imposed { -m12 / m22 } else { 0.0 },
            if plan.spin_imposed && !carrier { -m12 / m11 } else { 0.0 },
        ]
    }

    /// Accelerations of the side gears [rad/s²].
    pub fn side_accelerations(&self, m: &IdealMotion) -> [f64; 2] {
        [m.carrier + self.ratio * m.spin, m.carrier - self.ratio * m.spin]
    }

    /// Accelerations under constant `inputs`.
    pub fn motion(&self, inputs: &Inputs) -> IdealMotion {
        self.motion_along(self.mass(), inputs, &Inputs::ZERO)
    }

    /// Accelerations under inputs that are parabolas of time, and their derivatives with respect to time, by order.
    #[inline]
    pub fn motion_by_order(&self, inputs: &Inputs, derivatives: &InputDerivatives) -> [IdealMotion; 3] {
        let mass = self.mass();
        let [first, second] = &derivatives.rates;
        // accelerations are linear in inputs and their rates; most hosts give lines, which have no second derivatives
        let [left, right] = second.load_torque;
        let all = [second.drive_speed, second.planet_spin, second.drive_torque, left, right];
        let is_line = all.iter().fold(0, |bits, x| bits | x.to_bits()) << 1 == 0;
        [
            self.motion_along(mass, inputs, first),
            self.motion_along(mass, first, second),
            if is_line { IdealMotion::default() } else { self.motion_along(mass, second, &Inputs::ZERO) },
        ]
    }

    /// Accelerations under `inputs`. The accelerations of imposed speeds are the `rates` of the inputs [per s].
    #[inline]
    fn motion_along(&self, [m11, m12, m22]: [f64; 3], inputs: &Inputs, rates: &Inputs) -> IdealMotion {
        let r = self.ratio;
        let [left, right] = inputs.load_torque;
        let (f1, f2) = (inputs.drive_torque - left - right, r * (right - left));
        let (carrier, spin) = match (self.plan.drive_imposed, self.plan.spin_imposed) {
            (true, true) => (rates.drive_speed, rates.planet_spin),
            (true, false) => (rates.drive_speed, (f2 - m12 * rates.drive_speed) / m22),
            (false, true) => ((f1 - m12 * rates.planet_spin) / m11, rates.planet_spin),
            (false, false) => {
                let determinant = m11 * m22 - m12 * m12;
                ((f1 * m22 - f2 * m12) / determinant, (f2 * m11 - f1 * m12) / determinant)
            }
        };
        let carrier_torque =
            if self.plan.drive_imposed { m11 * carrier + m12 * spin + left + right } else { inputs.drive_torque };
        let spin_torque = if self.plan.spin_imposed { m12 * carrier + m22 * spin - f2 } else { 0.0 };
        let net = [carrier_torque - (left + right), spin_torque + f2];
        IdealMotion { carrier, spin, carrier_torque, spin_torque, net }
    }

    /// Sets the side gear speeds by Willis' equation.
    pub fn constrain(&self, v: &mut [f64]) {
        let (carrier, spin) = (v[CARRIER], v[PLANET]);
        v[0] = carrier + self.ratio * spin;
        v[1] = carrier - self.ratio * spin;
    }

    /// Kinetic energy at the velocities `v` [J].
    pub fn kinetic_energy(&self, v: &[f64]) -> f64 {
        let j = &self.inertia;
        let [left, right] = self.side_inertia();
        0.5 * (j.carrier * v[CARRIER] * v[CARRIER]
            + left * v[0] * v[0]
            + right * v[1] * v[1]
            + j.planets * j.planet * v[PLANET] * v[PLANET])
    }
}

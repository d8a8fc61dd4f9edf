//! Loads of a mesh, summed over its pairs, with derivatives if requested.

use super::directions::NormalComponents;
use super::sums::{PairFriction, Sums};
use super::{DetailedLoad, LOCAL, PairMotion};
use crate::contact::Spot;
use crate::numeric::Dual;

/// Indices of the sums: forces conjugate to q, x and w, then the forces under which gears slide.
const Q: usize = 0;
const X: usize = 1;
const W: usize = 2;
const PLANET: usize = 3;
const SIDE: usize = 4;
const TANGENTIAL: usize = 5;
/// Number of sums.
pub const SUMS: usize = 6;

/// Sums over tooth pairs. `ROWS` of them have derivatives with respect to `WIDE` variables: all or none.
#[derive(Clone, Copy, Debug)]
pub struct Totals<const ROWS: usize, const WIDE: usize> {
    value: [f64; SUMS],
    slopes: [[f64; WIDE]; ROWS],
    heat: [f64; 2],
    energy: f64,
}

impl<const ROWS: usize, const WIDE: usize> Default for Totals<ROWS, WIDE> {
    fn default() -> Self {
        Self { value: [0.0; SUMS], slopes: [[0.0; WIDE]; ROWS], heat: [0.0; 2], energy: 0.0 }
    }
}

impl<const ROWS: usize, const WIDE: usize> Totals<ROWS, WIDE> {
    /// Adds `factor` times `slopes` to the derivatives of sum `i`.
    #[inline(always)]
    fn slope(&mut self, i: usize, factor: f64, slopes: &[f64; WIDE]) {
        for (sum, slope) in self.slopes[i].iter_mut().zip(slopes) {
            *sum += factor * slope;
        }
    }

    /// Adds the elastic and damping forces of a pair.
    #[inline(always)]
    pub fn add_teeth<const OPEN: bool>(&mut self, motion: &PairMotion<OPEN>, sums: &Sums) {
        let (torque, normal) = (sums.torque, sums.normal);
        let ([aq, ax], [ex, ew]) = (motion.slope, motion.opening);
        self.value[Q] -= torque * aq;
        self.value[X] -= torque * ax + sums.by_s * motion.s_slope;
        if OPEN {
            self.value[X] += normal * ex;
            self.value[W] += normal * ew;
        }
        self.heat[0] += sums.heat;
        if ROWS == 0 {
            return;
        }
        self.energy += sums.energy;
        let [by_torque, by_s] = [0, 2].map(|i| motion.slopes(&sums.by[i]));
        self.slope(Q, -aq, &by_torque);
        self.slope(X, -ax, &by_torque);
        self.slope(X, -motion.s_slope, &by_s);
        let [qq, xx] = motion.curvature;
        self.slopes[Q][0] -= torque * qq;
        self.slopes[Q][1] -= torque * qq;
        self.slopes[X][0] -= torque * qq;
        self.slopes[X][1] -= torque * xx;
        if OPEN {
            let by_normal = motion.slopes(&sums.by[1]);
            self.slope(X, ex, &by_normal);
            self.slope(W, ew, &by_normal);
            let [exx, exw] = motion.opening_twice;
            self.slopes[X][1] += normal * exx;
            self.slopes[X][2] += normal * exw;
            self.slopes[W][1] += normal * exw;
        }
    }

    /// Adds friction along the flanks of a pair: −h N along the planet's flank has the lever arms R cotδ_b sinψ.
    #[inline(always)]
    pub fn add_friction<const OPEN: bool>(
        &mut self,
        motion: &PairMotion<OPEN>,
        sums: &Sums,
        pair_friction: &PairFriction,
    ) {
        let ([planet, side], sign) = (pair_friction.geometry.arm, motion.sign);
        let levers = [-sign * side, -sign * (side - planet)];
        self.value[Q] += levers[0] * sums.friction;
        self.value[X] += levers[1] * sums.friction;
        self.heat[1] += sums.friction * pair_friction.speeds[0];
        if ROWS == 0 {
            return;
        }
        let mut by = motion.slopes(&sums.by[3]);
        let [sliding, sum_speed, radius] = sums.friction_by;
        let [by_sliding, by_sum_speed] = motion.speed_slopes(&pair_friction.geometry);
        for (i, index) in [1, 3, 4].into_iter().enumerate() {
            by[index] += sliding * by_sliding[i] + sum_speed * by_sum_speed[i];
        }
        by[1] += radius * pair_friction.geometry.radius_slope * motion.s_slope;
        let [planet_slope, side_slope] = pair_friction.geometry.arm_slope.map(|slope| slope * motion.s_slope);
        self.slope(Q, levers[0], &by);
        self.slope(X, levers[1], &by);
        self.slopes[Q][1] -= sign * side_slope * sums.friction;
        self.slopes[X][1] -= sign * (side_slope - planet_slope) * sums.friction;
    }

    /// Adds the components of a pair's normal force along the axes and the rotation.
    #[inline(always)]
    pub fn add_thrust<const OPEN: bool>(
        &mut self,
        motion: &PairMotion<OPEN>,
        sums: &Sums,
        normal: &NormalComponents,
        spot: Spot,
    ) {
        let [planet, side, forward] = normal.components;
        let components = [(PLANET, planet), (SIDE, side), (TANGENTIAL, -motion.sign * forward)];
        for (i, component) in components {
            self.value[i] += sums.normal * component;
        }
        if ROWS == 0 {
            return;
        }
        let by = motion.slopes(&sums.by[1]);
        let moves = spot.moves(motion.sign, motion.s_slope);
        for (i, component) in components {
            self.slope(i, component, &by);
        }
        let [planet, side, forward] = normal.slopes;
        for (i, slope) in [(PLANET, planet), (SIDE, side), (TANGENTIAL, -motion.sign * forward)] {
            self.slopes[i][0] += sums.normal * slope * moves[0];
            self.slopes[i][1] += sums.normal * slope * moves[1];
        }
    }

    /// Adds the effect of a pair's position on its couplings with other pairs: a force along x, its derivatives with
    /// respect to the positions of its own mesh and the other mesh, and an energy.
    #[inline(always)]
    pub fn add_moving(&mut self, force: f64, [own, other]: [[f64; 3]; 2], energy: f64) {
        self.value[X] += force;
        self.energy += energy;
        if ROWS > 0 {
            for i in 0..3 {
                self.slopes[X][i] += own[i];
                self.slopes[X][LOCAL + i] += other[i];
            }
        }
    }

    /// Returns the loads without derivatives.
    pub fn load(&self) -> DetailedLoad<f64> {
        self.of(|i| self.value[i])
    }

    #[inline(always)]
    fn of<T: Copy>(&self, sum: impl Fn(usize) -> T) -> DetailedLoad<T> {
        DetailedLoad {
            force: [sum(Q), sum(X), sum(W)],
            planet_axial: sum(PLANET),
            side_axial: sum(SIDE),
            tangential: sum(TANGENTIAL),
            heat: self.heat,
            energy: self.energy,
        }
    }
}

impl<const WIDE: usize> Totals<SUMS, WIDE> {
    /// Returns the loads with their derivatives.
    pub fn linearised(&self) -> DetailedLoad<Dual<WIDE>> {
        self.of(|i| Dual { v: self.value[i], d: self.slopes[i] })
    }
}

//! Dry friction of gears with teeth: under the loads of their meshes, with derivatives by these.

use super::in_detail::Local;
use super::ledger_rates::LedgerRates;
use super::{Acted, Equations, Jacobian};
use crate::contact::detailed::{DetailedLoad, LOCAL, WITH_OTHER};
use crate::integrate::{Matrix, Point};
use crate::model::assembly::SIGMA;
use crate::model::effect_kinds::SurfaceLoad;
use crate::model::scene::{CARRIER, FRICTION_BODIES, FRICTION_PLANETS, FRICTION_WHEELS};

/// Loads on the surfaces of side gears and planets.
pub(super) type MeshLoads<const G: usize> = ([SurfaceLoad; 2], [SurfaceLoad; G]);

/// The same by body; none where meshes press nothing.
#[inline(always)]
pub(super) fn by_body<const G: usize>(loads: Option<&MeshLoads<G>>) -> [SurfaceLoad; FRICTION_BODIES] {
    let mut all = [SurfaceLoad::default(); FRICTION_BODIES];
    if let Some((sides, planets)) = loads {
        all[..FRICTION_PLANETS].copy_from_slice(sides);
        all[FRICTION_PLANETS..FRICTION_PLANETS + G].copy_from_slice(planets);
    }
    all
}

impl<const N: usize, const G: usize, const WITH_EFFECTS: bool> Equations<'_, N, G, WITH_EFFECTS> {
    /// Adds the torques and the heat of dry friction, where there is any, under given loads on the surfaces of side gears and
    /// planets.
    #[inline(always)]
    pub(in crate::model) fn add_friction(
        &self,
        at: &Point<N>,
        loads: Option<&MeshLoads<G>>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) {
        if self.rubs() {
            self.rub_under(at, loads, sum, ledger_rates);
        }
    }

    fn rub_under(
        &self,
        at: &Point<N>,
        loads: Option<&MeshLoads<G>>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) {
        self.rub(at, &self.all_surface_loads(loads), sum, ledger_rates);
    }

    /// Loads on all surfaces, those of side gears and planets as given.
    fn all_surface_loads(&self, loads: Option<&MeshLoads<G>>) -> [SurfaceLoad; FRICTION_BODIES] {
        let mut all = by_body(loads);
        all[FRICTION_WHEELS..].copy_from_slice(&self.acting.friction().wheel_loads(&self.acting.inputs));
        all
    }

    /// Derivatives of dry friction by the motion of the bodies on which it acts, under given loads on the surfaces of side gears
    /// and planets.
    pub(in crate::model) fn friction_slopes_under(
        &self,
        at: &Point<N>,
        loads: Option<&MeshLoads<G>>,
        j: &mut Jacobian<'_, N>,
    ) {
        if self.rubs() {
            self.friction_slopes(at, &self.all_surface_loads(loads), j);
        }
    }

    /// Adds the torques of brakes that slide, which follow from inputs and speeds alone.
    pub(in crate::model) fn add_brakes(&self, at: &Point<N>, sum: &mut [f64; N]) {
        let surface_loads = self.acting.friction().wheel_loads(&self.acting.inputs);
        for s in 0..2 {
            let (friction, state, _) = self.friction_on(FRICTION_WHEELS + s);
            if friction.is_on() {
                let direction = state.mode.direction();
                let speed = direction * self.slip(at, FRICTION_WHEELS + s).speed;
                sum[self.wheel(s)] -= direction * friction.sliding_limit(speed, &surface_loads[s])[0];
            }
        }
    }

    /// Derivatives of dry friction by the loads of the meshes.
    pub(in crate::model) fn friction_slopes_by_loads<T: Local>(
        &self,
        at: &Point<N>,
        loads: &[[DetailedLoad<T>; 2]; G],
        (sides, planets): &MeshLoads<G>,
        j: &mut Jacobian<'_, N>,
    ) {
        let side = self.teeth.sin_base[1];
        for s in 0..2 {
            let Some((direction, of_side)) = self.slopes_of_sliding(at, s, &sides[s]) else { continue };
            let torque = self.sum(|g| self.members(g) * side * loads[g][s].force[0].value());
            let slopes: [[f64; WITH_OTHER]; G] = self.by_group(|g| {
                let (axial, force) = (loads[g][s].side_axial.slopes(), loads[g][s].force[0].slopes());
                std::array::from_fn(|k| {
                    self.members(g) * (of_side[0] * axial[k] + of_side[1] * torque.signum() * side * force[k])
                })
            });
            for (row, sign) in [(s, -direction), (CARRIER, direction)] {
                self.spread::<T>(row, sign, s, &slopes, j);
            }
        }
        for g in 0..self.groups() {
            let Some((direction, of_planet)) = self.slopes_of_sliding(at, FRICTION_PLANETS + g, &planets[g]) else {
                continue;
            };
            let [l, r] = &loads[g];
            let across = l.tangential.value() + r.tangential.value();
            let along = l.side_axial.value() - r.side_axial.value();
            let per = if planets[g].load > 0.0 { of_planet[1] / planets[g].load } else { 0.0 };
            for s in 0..2 {
                let load = &loads[g][s];
                let (t, a, p) = (load.tangential.slopes(), load.side_axial.slopes(), load.planet_axial.slopes());
                let mut slopes = [[0.0; WITH_OTHER]; G];
                slopes[g] =
                    std::array::from_fn(|k| of_planet[0] * p[k] + per * (across * t[k] + SIGMA[s] * along * a[k]));
                self.spread::<T>(self.planet(g), -direction, s, &slopes, j);
            }
        }
    }

    /// Direction in which body `i` slides, and the slopes of its limit torque by thrust and load, under the loads `by`; none
    /// where it does not slide.
    fn slopes_of_sliding(&self, at: &Point<N>, i: usize, by: &SurfaceLoad) -> Option<(f64, [f64; 2])> {
        let (friction, state, _) = self.friction_on(i);
        let direction = state.mode.direction();
        let slides = direction != 0.0 && friction.is_on();
        slides.then(|| (direction, friction.limit_slopes(direction * self.slip(at, i).speed, by)))
    }

    /// Derivatives of the planets' dry friction by the speeds that throw them outward.
    pub(in crate::model) fn friction_slopes_by_orbit(
        &self,
        at: &Point<N>,
        planets: &[SurfaceLoad; G],
        j: &mut Jacobian<'_, N>,
    ) {
        for g in 0..self.groups() {
            let slopes = self.slopes_of_sliding(at, FRICTION_PLANETS + g, &planets[g]);
            let Some((direction, [per_thrust, _])) = slopes else { continue };
            j.by_velocity[self.planet(g)][self.orbit(g)] -= direction * per_thrust * self.centrifugal(at, g)[1];
        }
    }

    /// Adds to row `row` the slopes of something by the variables of all meshes of side `s`, and of the planets' other meshes
    /// where those matter.
    fn spread<T: Local>(
        &self,
        row: usize,
        sign: f64,
        s: usize,
        slopes: &[[f64; WITH_OTHER]; G],
        j: &mut Jacobian<'_, N>,
    ) {
        self.spread_positions(row, sign, s, |g, k| slopes[g][k], j.by_position);
        self.spread_positions(row, sign, s, |g, k| slopes[g][3 + k], &mut j.by_rate);
        if T::BY_OTHER {
            self.spread_positions(row, sign, 1 - s, |g, k| slopes[g][LOCAL + k], j.by_position);
        }
    }

    /// Adds to row `row` the slopes of something by q, x, w, or their rates, of all meshes of side `s`.
    #[inline]
    fn spread_positions(
        &self,
        row: usize,
        sign: f64,
        s: usize,
        slopes: impl Fn(usize, usize) -> f64,
        m: &mut Matrix<N>,
    ) {
        let [planet, side] = self.teeth.sin_base;
        let turn = SIGMA[s] * planet;
        m[row][s] += sign * self.sum(|g| side * slopes(g, 0));
        for g in 0..self.groups() {
            m[row][self.planet(g)] += sign * turn * (slopes(g, 1) - slopes(g, 0));
            if self.has_pins() {
                m[row][self.pin(g)] -= sign * side * slopes(g, 0);
            }
        }
        if self.has_pins() {
            m[row][self.seat(s)] += sign * self.sum(|g| slopes(g, 2));
        }
    }
}

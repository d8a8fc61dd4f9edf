//! Dry friction of gears with teeth under the loads of their meshes, with its derivatives with respect to these loads.

use super::inputs_and_friction::slip_speed;
use super::ledger_rates::LedgerRates;
use super::shape::{ByGroup, Shape};
use super::{Equations, FrictionEquations, Jacobian};
use crate::contact::detailed::{LOCAL, WITH_OTHER};
use crate::contact::planet::{COORDINATES, LinearisedLoad, Q};
use crate::integrate::Point;
use crate::model::assembly::SIGMA;
use crate::model::effect_kinds::SurfaceLoad;
use crate::model::effect_kinds::dry_friction::DryFriction;
use crate::model::scene::{CARRIER, PAIRS, RubbingKind};

/// Loads on the surfaces of side gears, and of planets by group.
pub(super) type MeshLoads<S, const N: usize> = ([SurfaceLoad; 2], <S as Shape<N>>::ByGroup<SurfaceLoad>);

impl<const N: usize, S: Shape<N>> Equations<'_, S, N> {
    /// Loads by body; zero without mesh loads.
    #[inline(always)]
    pub(super) fn by_body(&self, loads: Option<&MeshLoads<S, N>>) -> [SurfaceLoad; PAIRS] {
        let mut all = [SurfaceLoad::default(); PAIRS];
        if let Some((sides, planets)) = loads {
            all[RubbingKind::Side.numbers()].copy_from_slice(sides);
            for g in 0..self.groups() {
                all[RubbingKind::Planet.number(g)] = planets[g];
            }
        }
        all
    }

    /// Adds the torques and the heat of dry friction, if there is any, under given loads on the surfaces of side gears
    /// and planets.
    #[inline(always)]
    pub(super) fn add_friction(
        &self,
        at: &Point<N>,
        loads: Option<&MeshLoads<S, N>>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) {
        if self.has_dry_friction() {
            self.add_friction_under(at, loads, sum, ledger_rates);
        }
    }

    fn add_friction_under(
        &self,
        at: &Point<N>,
        loads: Option<&MeshLoads<S, N>>,
        sum: &mut [f64; N],
        ledger_rates: &mut LedgerRates,
    ) {
        self.add_friction_torques(at, &self.all_surface_loads(loads), sum, ledger_rates);
    }

    /// Loads on all rubbing surfaces. `loads` contains the loads on side gears and planets.
    fn all_surface_loads(&self, loads: Option<&MeshLoads<S, N>>) -> [SurfaceLoad; PAIRS] {
        let mut all = self.by_body(loads);
        self.applied.friction().add_commands(&self.applied.inputs, &mut all);
        all
    }

    /// Adds the derivatives of dry friction with respect to the motion of its bodies, under given loads on the surfaces
    /// of side gears and planets.
    pub(super) fn friction_slopes_under(
        &self,
        at: &Point<N>,
        loads: Option<&MeshLoads<S, N>>,
        j: &mut Jacobian<'_, N>,
    ) {
        if self.has_dry_friction() {
            self.friction_slopes(at, &self.all_surface_loads(loads), j);
        }
    }

    /// Adds the torques of sliding brakes and clutches, which depend only on inputs and speeds.
    pub(super) fn add_commanded(&self, at: &Point<N>, sum: &mut [f64; N]) {
        let surface_loads = self.applied.friction().commanded_loads(&self.applied.inputs);
        for number in (0..PAIRS).filter(|&number| RubbingKind::of(number).0.is_commanded()) {
            if let (Some(pair), Some((friction, direction, speed))) = (self.pair(number), self.sliding(at, number)) {
                let torque = direction * friction.sliding_limit(speed, &surface_loads[number])[0];
                sum[pair.body] -= torque;
                if let Some(base) = pair.base {
                    sum[base] += pair.ratio * torque;
                }
            }
        }
    }

    /// Adds the derivatives of dry friction that result from the loads of the meshes.
    pub(super) fn friction_slopes_by_loads<L: LinearisedLoad>(
        &self,
        at: &Point<N>,
        loads: &S::ByGroup<[L; 2]>,
        (sides, planets): &MeshLoads<S, N>,
        j: &mut Jacobian<'_, N>,
    ) {
        let side = self.teeth.sin_base[1];
        let ramps = self.applied.friction().ramps;
        let torques = [0, 1].map(|s| self.sum(|g| self.members(g) * side * loads[g][s].force()[Q]));
        for s in 0..2 {
            let Some((direction, of_side)) = self.slopes_of_sliding(at, s, &sides[s]) else { continue };
            let by_torque = ramps.slopes(torques, s);
            for t in (0..2).filter(|&t| t == s || ramps.both_sides) {
                let by_thrust = if t == s { of_side[0] } else { 0.0 };
                let slopes = self.by_group([0.0; WITH_OTHER], |g| {
                    let by = loads[g][t].pressing_slopes();
                    std::array::from_fn(|k| {
                        self.members(g)
                            * (by_thrust * by.side_axial[k] + of_side[1] * by_torque[t] * side * by.force[k])
                    })
                });
                for row in [(s, -direction), (CARRIER, direction)] {
                    self.spread_all::<L>(row, t, &slopes, j);
                }
            }
        }
        for g in 0..self.groups() {
            let Some((direction, of_planet)) = self.slopes_of_sliding(at, RubbingKind::Planet.number(g), &planets[g])
            else {
                continue;
            };
            let [l, r] = [loads[g][0].pressing(), loads[g][1].pressing()];
            let across = l.tangential + r.tangential;
            let along = l.side_axial - r.side_axial;
            let per = if planets[g].load > 0.0 { of_planet[1] / planets[g].load } else { 0.0 };
            for s in 0..2 {
                let by = loads[g][s].pressing_slopes();
                let mut slopes = S::ByGroup::filled([0.0; WITH_OTHER]);
                slopes[g] = std::array::from_fn(|k| {
                    of_planet[0] * by.planet_axial[k]
                        + per * (across * by.tangential[k] + SIGMA[s] * along * by.side_axial[k])
                });
                self.spread_all::<L>((self.planet(g), -direction), s, &slopes, j);
            }
        }
    }

    /// Friction of the pair with this `number`, the direction in which it slides, and its speed in this direction
    /// [rad/s]. Returns `None` if the pair does not slide.
    fn sliding(&self, at: &Point<N>, number: usize) -> Option<(DryFriction<'_>, f64, f64)> {
        let pair = self.pair(number)?;
        let (friction, state) = self.friction_on(pair);
        let direction = state.mode.direction();
        let slides = direction != 0.0 && friction.is_on();
        slides.then(|| (friction, direction, direction * slip_speed(at, pair)))
    }

    /// Direction in which the pair with this `number` slides, and the derivatives of its limit torque with respect to
    /// thrust and load, under the loads `by`. Returns `None` if it does not slide.
    fn slopes_of_sliding(&self, at: &Point<N>, number: usize, by: &SurfaceLoad) -> Option<(f64, [f64; 2])> {
        let (friction, direction, speed) = self.sliding(at, number)?;
        Some((direction, friction.limit_slopes(speed, by)))
    }

    /// Adds the derivatives of the planets' dry friction that result from their centrifugal force.
    pub(super) fn friction_slopes_by_orbit(
        &self,
        at: &Point<N>,
        planets: &S::ByGroup<SurfaceLoad>,
        j: &mut Jacobian<'_, N>,
    ) {
        for g in 0..self.groups() {
            let slopes = self.slopes_of_sliding(at, RubbingKind::Planet.number(g), &planets[g]);
            let Some((direction, [per_thrust, _])) = slopes else { continue };
            j.by_velocity[self.planet(g)][self.orbit(g)] -= direction * per_thrust * self.centrifugal(at, g)[1];
        }
    }

    /// Adds derivatives with respect to the variables of all meshes of side `s` to a row. If the meshes of a planet are
    /// coupled, it adds derivatives with respect to the other meshes as well.
    fn spread_all<L: LinearisedLoad>(
        &self,
        row: (usize, f64),
        s: usize,
        slopes: &S::ByGroup<[f64; WITH_OTHER]>,
        j: &mut Jacobian<'_, N>,
    ) {
        self.spread(row, s, (slopes, 0), j.by_position);
        self.spread(row, s, (slopes, COORDINATES), j.by_rate);
        if L::COUPLED {
            self.spread(row, 1 - s, (slopes, LOCAL), j.by_position);
        }
    }
}

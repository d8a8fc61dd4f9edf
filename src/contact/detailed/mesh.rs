//! The mesh itself: constants, and the sum of loads over tooth pairs and slices.

use super::super::damping::Damping;
use super::super::pairs::{Engagement, Flank, Spot, ToothPair};
use super::super::spring::Spring;
use super::super::tooth_friction::ToothFriction;
use super::forces::{Directions, damped};
use super::{DetailedLoad, DetailedState, Gaps, PairName, Slice, SliceLoad};
use crate::geometry::Pair;
use crate::numeric::{Scalar, cos};

/// Constants of a detailed mesh.
#[derive(Clone, Debug)]
pub struct Detailed<S> {
    /// Specific elastic law.
    pub spring: S,
    /// Damping.
    pub damping: Damping,
    /// Slices of the face.
    pub slices: Vec<Slice>,
    /// One spring per mesh instead of tooth pairs.
    pub single: bool,
    /// Friction along the flanks.
    pub friction: Option<ToothFriction>,
    directions: Directions,
    pub(super) whole: f64,
    /// Cone distance of the resultant of error-free teeth [m]: damping is that of the whole face, distributed over the slices.
    resultant: f64,
}

impl<S: Spring> Detailed<S> {
    /// A detailed mesh of `pair`.
    pub fn new(
        pair: &Pair,
        spring: S,
        damping: Damping,
        slices: Vec<Slice>,
        single: bool,
        friction: Option<ToothFriction>,
    ) -> Self {
        Self {
            spring,
            damping,
            whole: slices.iter().map(|s| s.weight).sum(),
            resultant: slices.iter().map(|s| s.weight).sum::<f64>()
                / slices.iter().map(|s| s.weight / s.cone).sum::<f64>(),
            slices,
            single,
            friction,
            directions: Directions::new(pair),
        }
    }

    /// Width over which the force of a whole face is spread [m].
    pub fn whole_width(&self) -> f64 {
        let moment: f64 = self.slices.iter().map(|s| s.width * s.cone).sum();
        moment / self.resultant
    }

    /// Loads at `state`; calls `look` with each loaded slice.
    #[inline(always)]
    pub fn load<T: Scalar>(
        &self,
        engagement: &Engagement,
        gaps: Option<&dyn Gaps>,
        (planet, side): (usize, usize),
        state: &DetailedState<T>,
        mut look: impl FnMut(&SliceLoad),
    ) -> DetailedLoad<T> {
        let zero = T::constant(0.0);
        let mut out = DetailedLoad {
            force: [zero; 3],
            normal: zero,
            planet_axial: zero,
            side_axial: zero,
            tangential: zero,
            heat: [0.0; 2],
        };
        let [q, x, w] = state.position;
        // closes gaps beyond the approach of error-free teeth
        let slack = gaps.map_or(0.0, |g| -g.least()) + (-w.value()).max(0.0);
        let inner = self.slices[0].cone;
        for (flank, sign) in [(Flank::Drive, -1.0), (Flank::Coast, 1.0)] {
            let approach = q * sign - engagement.half_backlash();
            let excess = slack / inner;
            let reach = approach.value() + excess;
            if reach <= 0.0 {
                continue;
            }
            let mut visit = |pair: &ToothPair| {
                let tooth = match flank {
                    Flank::Drive => pair.number - state.wrapped,
                    Flank::Coast => -(pair.number + state.wrapped),
                };
                let name = PairName { planet, side, flank, tooth };
                // without tooth pairs the place does not move
                let s = (x - x.value()) * pair.s_slope + pair.s;
                self.add_pair(&mut out, engagement, gaps, name, pair, (s, approach, w), state, &mut look);
            };
            if self.single {
                visit(&ToothPair::single(flank, approach.value()));
            } else {
                engagement.near(flank, x.value(), reach, excess, visit);
            }
        }
        out
    }

    /// Elastic energy V [J].
    pub fn energy(
        &self,
        engagement: &Engagement,
        gaps: Option<&dyn Gaps>,
        names: (usize, usize),
        state: &DetailedState<f64>,
    ) -> f64 {
        let mut energy = 0.0;
        self.load(engagement, gaps, names, state, |slice| energy += slice.energy);
        energy
    }

    #[allow(clippy::too_many_arguments)]
    #[inline(always)]
    fn add_pair<T: Scalar>(
        &self,
        out: &mut DetailedLoad<T>,
        engagement: &Engagement,
        gaps: Option<&dyn Gaps>,
        name: PairName,
        pair: &ToothPair,
        (s, approach, w): (T, T, T),
        state: &DetailedState<T>,
        look: &mut impl FnMut(&SliceLoad),
    ) {
        let (sign, s_slope) = (if name.flank == Flank::Drive { -1.0 } else { 1.0 }, pair.s_slope);
        // gap of the tip corner with its slope, as functions of the state
        let (spot, delta) = match pair.spot {
            Spot::PlanetTip => (Spot::PlanetTip, s - engagement.corner[0].end),
            Spot::SideTip => {
                let delta = approach - s - engagement.corner[1].end;
                (if delta.value() > 0.0 { Spot::SideTip } else { Spot::Path }, delta)
            }
            Spot::Path => (Spot::Path, s),
        };
        let (gap, by_q, by_x) = match spot {
            Spot::Path => (T::constant(0.0), T::constant(sign), T::constant(0.0)),
            Spot::PlanetTip => {
                let g = engagement.corner[0].at(delta.value());
                (delta.chain(g.v, g.d), T::constant(sign), delta.chain(g.d, g.dd) * sign)
            }
            Spot::SideTip => {
                let g = engagement.corner[1].at(delta.value());
                let slope = delta.chain(g.d, g.dd);
                (delta.chain(g.v, g.d), (slope * -1.0 + 1.0) * sign, slope * -sign)
            }
        };
        let arc = approach - gap;
        let [planet_part, side_part, forward] = self.directions.parts(engagement, spot, s, delta);
        // axial part of the normal as the side gear's displacement sees it, with its slope by s
        let psi = s * -1.0 + self.directions.pitch_arc[1];
        let nu = psi.sin() * cos(self.directions.base[1]);
        let nu_slope = psi.cos() * -cos(self.directions.base[1]);
        for (j, slice) in self.slices.iter().enumerate() {
            let r = slice.cone;
            let mut opening = w * nu;
            let mut opening_by_s = w * nu_slope;
            if let Some(gaps) = gaps {
                let [e, e1, e2] = gaps.at(name, j, s.value(), T::HAS_SLOPES);
                opening = opening + s.chain(e, e1);
                opening_by_s = opening_by_s + s.chain(e1, e2);
            }
            let p = arc - opening * (1.0 / r);
            if p.value() <= 0.0 {
                continue;
            }
            // ∂p/∂(q, x, w)
            let slope = [by_q, by_x - opening_by_s * (s_slope / r), nu * (-1.0 / r)];
            let elastic = self.spring.at(p.value(), s.value());
            let (dp, ds) = (p - p.value(), s - s.value());
            let torque = (dp * elastic.stiffness + ds * elastic.torque_by_place + elastic.torque) * slice.weight;
            let by_place =
                (dp * elastic.torque_by_place + ds * elastic.by_place_twice + elastic.by_place) * slice.weight;
            let rate = slope[0] * state.rate[0] + slope[1] * state.rate[1] + slope[2] * state.rate[2];
            // as if the whole face were in this state: its force at the cone distance of the resultant
            let (share, cone) = (slice.weight / self.whole, self.resultant);
            let damped = damped(&self.damping, torque * (1.0 / (share * cone)), p * cone, rate * cone) * (share * cone);
            for i in 0..3 {
                out.force[i] = out.force[i] - damped * slope[i];
            }
            out.force[1] = out.force[1] - by_place * s_slope;
            out.heat[0] += (damped.value() - torque.value()) * rate.value();
            let total = damped * (1.0 / r);
            let (mut friction_force, mut how) = (0.0, None);
            if let Some(friction) = &self.friction {
                let (force, heat, sliding) = self.directions.friction_force(friction, slice, s, total, sign, state);
                how = Some(sliding);
                friction_force = force[2].value();
                out.force[0] = out.force[0] + force[0];
                out.force[1] = out.force[1] + force[1];
                out.heat[1] += heat;
            }
            out.normal = out.normal + total;
            out.planet_axial = out.planet_axial + total * planet_part;
            out.side_axial = out.side_axial + total * side_part;
            out.tangential = out.tangential - total * forward * sign;
            look(&SliceLoad {
                pair,
                spot,
                place: if spot == Spot::Path { s.value() } else { delta.value() },
                cone: r,
                share,
                line_load: total.value() / slice.width,
                arc: p.value(),
                s: s.value(),
                energy: elastic.energy * slice.weight,
                name,
                normal: total.value(),
                friction: friction_force,
                sliding: how,
                parts: [planet_part.value(), side_part.value(), -sign * forward.value()],
            });
        }
    }
}

//! Forces of one loaded slice: its direction in space, damping, and friction along the flanks.

use super::super::damping::Damping;
use super::super::pairs::{Engagement, Spot};
use super::super::tooth_friction::{Sliding, ToothFriction};
use super::{DetailedState, Slice};
use crate::geometry::Pair;
use crate::numeric::{Scalar, cos};

/// Constants of the line of action, of which flank directions are made.
#[derive(Clone, Copy, Debug)]
pub struct Directions {
    /// Base angles δ_b of planet and side gear [rad].
    pub base: [f64; 2],
    /// Arcs ψ from their tangent points to the pitch point [rad].
    pub pitch_arc: [f64; 2],
    /// sinδ_b.
    sin_base: [f64; 2],
}

impl Directions {
    /// Constants of `pair`.
    pub fn new(pair: &Pair) -> Self {
        Self { base: pair.gears.map(|g| g.base), pitch_arc: pair.pitch_arc, sin_base: pair.sin_base() }
    }

    /// Parts of a unit normal force along both axes, away from the apex, and along the rotation.
    #[inline(always)]
    pub fn parts<T: Scalar>(&self, engagement: &Engagement, spot: Spot, s: T, delta: T) -> [T; 3] {
        let along = |sin_squared: T, lever: T| {
            let square = sin_squared - lever * lever;
            if square.value() > 1e-30 { square.sqrt() } else { T::constant(0.0) }
        };
        let [sin_base_p, sin_base_s] = self.sin_base;
        let (planet, side) = match spot {
            Spot::Path => (
                (s + self.pitch_arc[0]).sin() * cos(self.base[0]),
                (s * -1.0 + self.pitch_arc[1]).sin() * cos(self.base[1]),
            ),
            Spot::PlanetTip => {
                let corner = &engagement.corner[0];
                let g = corner.at(delta.value());
                let lever = (delta.chain(g.d, g.dd) * -1.0 + 1.0) * sin_base_p;
                let [own, mate] = corner.sines_squared(delta);
                (along(own, lever), along(mate, T::constant(sin_base_s)))
            }
            Spot::SideTip => {
                let corner = &engagement.corner[1];
                let g = corner.at(delta.value());
                let lever = (delta.chain(g.d, g.dd) * -1.0 + 1.0) * sin_base_s;
                let [own, mate] = corner.sines_squared(delta);
                (along(mate, T::constant(sin_base_p)), along(own, lever))
            }
        };
        // the axes of a differential are perpendicular; the rest is along the rotation
        let rest = (planet * planet + side * side) * -1.0 + 1.0;
        [planet, side, if rest.value() > 1e-30 { rest.sqrt() } else { T::constant(0.0) }]
    }

    /// Forces conjugate to q and x of friction in a slice, the force itself, heat, and how the flanks slide.
    #[inline(always)]
    pub fn friction_force<T: Scalar>(
        &self,
        friction: &ToothFriction,
        slice: &Slice,
        s: T,
        normal: T,
        sign: f64,
        state: &DetailedState<T>,
    ) -> ([T; 3], f64, Sliding<f64>) {
        let [q_rate, x_rate, _] = state.rate;
        // cotδ_b sinψ of both gears, and the travels of their flanks
        let psi = [s + self.pitch_arc[0], s * -1.0 + self.pitch_arc[1]];
        let arm = [0, 1].map(|i| psi[i].sin() * (cos(self.base[i]) / self.sin_base[i]));
        let travel = [x_rate * -sign, (x_rate + q_rate) * -sign];
        let r = slice.cone;
        let own = [0, 1].map(|i| arm[i] * travel[i] * r);
        let sliding = own[0] - own[1];
        let curvature = [0, 1].map(|i| {
            let tangent = psi[i].sin() / psi[i].cos();
            if tangent.value() > 1e-6 { tangent * r } else { T::constant(1e-6 * r) }
        });
        // speeds of the flanks relative to the contact point, which moves across the profile
        let rolling = own[0] + own[1];
        let load = normal * (1.0 / slice.width);
        let mu = friction.signed(&Sliding { sliding, rolling, load, curvature });
        let force = normal * mu * -1.0;
        let on = [force * arm[0] * r, force * arm[1] * -r];
        let heat = -(force.value() * sliding.value());
        let seen = Sliding {
            sliding: sliding.value(),
            rolling: rolling.value(),
            load: load.value(),
            curvature: curvature.map(Scalar::value),
        };
        ([on[1] * -sign, (on[0] + on[1]) * -sign, force], heat, seen)
    }
}

/// Force of `elastic` with damping at penetration `d` and its rate; flanks never pull.
#[inline(always)]
pub fn damped<T: Scalar>(damping: &Damping, elastic: T, d: T, rate: T) -> T {
    let total = match *damping {
        Damping::Step { coefficient, per_full_depth } => {
            let u = d * per_full_depth;
            let step = if u.value() < 1.0 { u * u * (u * -2.0 + 3.0) } else { T::constant(1.0) };
            elastic + step * rate * coefficient
        }
        Damping::HuntCrossley { lambda } => elastic * (rate * lambda + 1.0),
    };
    if total.value() > 0.0 { total } else { T::constant(0.0) }
}

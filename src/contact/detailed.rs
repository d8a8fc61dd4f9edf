//! A mesh in full detail: tooth errors slice by slice, friction along the flanks, gears that give way along their axes,
//! and the loads that bearings see. Written once for values and for values with exact derivatives.
//!
//! A slice at cone distance R_j penetrates by d_j = R_j (a − g) − e_j(s) − w ν(s): w is what the side gear has moved away
//! from the apex, ν = cosδ_bs sin(ψ_s − s) the part of the flank's normal along its axis. V = Σ_k Σ_j J_j Φ(d_j/R_j, s)
//! over tooth pairs k and slices j. Friction μ F along the flank has the lever arms R cosδ_b sinψ about both axes and is
//! opposed to the sliding speed v = R (u_p cotδ_bp sinψ_p − u_s cotδ_bs sinψ_s), where u are the travels of both flanks
//! along the line of action.

use super::damping::Damping;
use super::pairs::{Engagement, Flank, Spot, ToothPair};
use super::spring::Spring;
use super::tooth_friction::{Sliding, ToothFriction};
use crate::geometry::Pair;
use crate::numeric::{Scalar, cos};

/// Position and motion of a mesh with the axial displacement w of its side gear.
#[derive(Clone, Copy, Debug)]
pub struct DetailedState<T> {
    /// q, x [rad] and w [m].
    pub position: [T; 3],
    /// Their rates.
    pub rate: [T; 3],
    /// Pairs by which the planet has been wrapped, in the sense of x.
    pub wrapped: i64,
}

/// Loads of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct DetailedLoad<T> {
    /// Forces conjugate to q, x [N·m] and w [N].
    pub force: [T; 3],
    /// Sum of normal forces [N].
    pub normal: T,
    /// Thrust on the planet along its axis away from the apex [N].
    pub planet_axial: T,
    /// Thrust on the side gear along its axis away from the apex [N].
    pub side_axial: T,
    /// Force on the side gear along the carrier's direction of rotation [N].
    pub tangential: T,
    /// Heat of contact damping and of tooth friction [W].
    pub heat: [f64; 2],
}

/// One loaded slice of one tooth pair, for those who look at loads one by one.
#[derive(Clone, Copy, Debug)]
pub struct SliceLoad<'a> {
    /// The pair.
    pub pair: &'a ToothPair,
    /// Kind of contact, and the arc Δ past the end of the path or the place on it [rad].
    pub spot: Spot,
    /// See `spot`.
    pub place: f64,
    /// Cone distance [m].
    pub cone: f64,
    /// Part of the face that the slice stands for, by its share of J.
    pub share: f64,
    /// Normal force per width [N/m].
    pub line_load: f64,
    /// Its penetration arc [rad].
    pub arc: f64,
    /// Place on the path [rad].
    pub s: f64,
    /// Elastic energy [J].
    pub energy: f64,
    /// Number of the planet's tooth, of the unrolled sequence.
    pub name: PairName,
    /// Normal force [N].
    pub normal: f64,
    /// Friction force along the flank, positive toward the planet's root on the planet [N].
    pub friction: f64,
    /// How the flanks slide, where friction is looked at.
    pub sliding: Option<Sliding<f64>>,
    /// Direction parts of the normal: along the planet's axis, along the side gear's axis, along the rotation.
    pub parts: [f64; 3],
}

/// A slice of the face.
#[derive(Clone, Copy, Debug)]
pub struct Slice {
    /// Cone distance R_j [m].
    pub cone: f64,
    /// J_j, its share of ∫R² dR [m³] (of the whole where the law is one for the face).
    pub weight: f64,
    /// Width over which its force is spread [m].
    pub width: f64,
}

/// What tooth errors add to the gap of a pair, slice by slice [m].
pub trait Gaps: Send + Sync + std::fmt::Debug {
    /// Gap e with its first and, where it is asked for, second derivative by s.
    fn at(&self, pair: PairName, slice: usize, s: f64, twice: bool) -> [f64; 3];
    /// A gap that no pair falls below (zero or negative).
    fn least(&self) -> f64;
}

/// Which teeth, of the unrolled sequence, meet in which mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairName {
    /// Planet.
    pub planet: usize,
    /// Side, 0 left and 1 right.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Number of the planet's tooth, counted from the mesh's own line at the start and in the sense of x.
    pub tooth: i64,
}

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
    base: [f64; 2],
    pitch_arc: [f64; 2],
    lever: [f64; 2],
    whole: f64,
    /// Cone distance of the resultant of error-free teeth [m]: damping is that of the whole face, shared out.
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
        let base = pair.gears.map(|g| g.base);
        Self {
            spring,
            damping,
            whole: slices.iter().map(|s| s.weight).sum(),
            resultant: slices.iter().map(|s| s.weight).sum::<f64>()
                / slices.iter().map(|s| s.weight / s.cone).sum::<f64>(),
            slices,
            single,
            friction,
            base,
            pitch_arc: pair.pitch_arc,
            lever: pair.lever(),
        }
    }

    /// Width over which the force of a whole face is spread [m].
    pub fn whole_width(&self) -> f64 {
        let moment: f64 = self.slices.iter().map(|s| s.width * s.cone).sum();
        moment / self.resultant
    }

    /// Loads at `state`; each loaded slice is shown to `look`.
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
        // what may close a gap beyond the approach of error-free teeth
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
                // the place of a mesh that knows no pairs stays
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
        let [planet_part, side_part, forward] = self.parts(engagement, spot, s, delta);
        // axial part of the normal as the side gear's displacement sees it, with its slope by s
        let psi = s * -1.0 + self.pitch_arc[1];
        let nu = psi.sin() * cos(self.base[1]);
        let nu_slope = psi.cos() * -cos(self.base[1]);
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
            let damped = self.damped(torque * (1.0 / (share * cone)), p * cone, rate * cone) * (share * cone);
            for i in 0..3 {
                out.force[i] = out.force[i] - damped * slope[i];
            }
            out.force[1] = out.force[1] - by_place * s_slope;
            out.heat[0] += (damped.value() - torque.value()) * rate.value();
            let total = damped * (1.0 / r);
            let (mut friction_force, mut how) = (0.0, None);
            if let Some(friction) = &self.friction {
                let (force, heat, sliding) = self.friction_force(friction, slice, s, total, sign, state);
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

    /// Parts of a unit normal force along both axes, away from the apex, and along the rotation.
    #[inline(always)]
    fn parts<T: Scalar>(&self, engagement: &Engagement, spot: Spot, s: T, delta: T) -> [T; 3] {
        let along = |sin_squared: T, lever: T| {
            let square = sin_squared - lever * lever;
            if square.value() > 1e-30 { square.sqrt() } else { T::constant(0.0) }
        };
        let [lever_p, lever_s] = self.lever;
        let (planet, side) = match spot {
            Spot::Path => (
                (s + self.pitch_arc[0]).sin() * cos(self.base[0]),
                (s * -1.0 + self.pitch_arc[1]).sin() * cos(self.base[1]),
            ),
            Spot::PlanetTip => {
                let corner = &engagement.corner[0];
                let g = corner.at(delta.value());
                let lever = (delta.chain(g.d, g.dd) * -1.0 + 1.0) * lever_p;
                let [own, mate] = corner.sines_squared(delta);
                (along(own, lever), along(mate, T::constant(lever_s)))
            }
            Spot::SideTip => {
                let corner = &engagement.corner[1];
                let g = corner.at(delta.value());
                let lever = (delta.chain(g.d, g.dd) * -1.0 + 1.0) * lever_s;
                let [own, mate] = corner.sines_squared(delta);
                (along(mate, T::constant(lever_p)), along(own, lever))
            }
        };
        // the axes of a differential are perpendicular; the rest is along the rotation
        let rest = (planet * planet + side * side) * -1.0 + 1.0;
        [planet, side, if rest.value() > 1e-30 { rest.sqrt() } else { T::constant(0.0) }]
    }

    #[inline(always)]
    fn damped<T: Scalar>(&self, elastic: T, d: T, rate: T) -> T {
        let total = match self.damping {
            Damping::Step { coefficient, per_full_depth } => {
                let u = d * per_full_depth;
                let step = if u.value() < 1.0 { u * u * (u * -2.0 + 3.0) } else { T::constant(1.0) };
                elastic + step * rate * coefficient
            }
            Damping::HuntCrossley { lambda } => elastic * (rate * lambda + 1.0),
        };
        if total.value() > 0.0 { total } else { T::constant(0.0) }
    }

    /// Forces conjugate to q and x of friction in a slice, the force itself, heat, and how the flanks slide.
    #[inline(always)]
    fn friction_force<T: Scalar>(
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
        let arm = [0, 1].map(|i| psi[i].sin() * (cos(self.base[i]) / self.lever[i]));
        let travel = [x_rate * -sign, (x_rate + q_rate) * -sign];
        let r = slice.cone;
        let own = [0, 1].map(|i| arm[i] * travel[i] * r);
        let sliding = own[0] - own[1];
        let curvature = [0, 1].map(|i| {
            let tangent = psi[i].sin() / psi[i].cos();
            if tangent.value() > 1e-6 { tangent * r } else { T::constant(1e-6 * r) }
        });
        // the contact point moves across the profile, so that these are the flanks' own speeds along it
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

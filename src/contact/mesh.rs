//! The elastic potential of one mesh, and the force, Jacobian, energy and heat derived from it.
//!
//! V(q, x) = Σ U(d, s) over the tooth pairs. Forces are −∇V with ∂V/∂x included, so that an undamped scene conserves
//! energy. Damping acts through the same ∂d/∂q and ∂d/∂x.

use super::impact::Force;
use super::spring::{Response, Resultant, depends_on_position, with_spring};
pub use super::state::{MeshForce, MeshJacobian, MeshState};
use super::{AnySpring, Damping, Engagement, Flank, Spot, Spring, ToothPair};
use crate::geometry::Pair;

/// A planet meshing with a side gear, with flanks that fit each other.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Elastic law of a pair.
    pub spring: AnySpring,
    /// Damping of a pair.
    pub damping: Damping,
    /// Resultant of a pair's force over the whole face.
    pub whole: Resultant,
    /// True if the mesh has one spring instead of tooth pairs.
    pub is_single: bool,
    /// Tooth pairs.
    pub engagement: Engagement,
}

/// Evaluates an expression with `spring` bound to the law in use, and `pairs` to the loaded pairs at a position (q, x).
/// A mesh with one spring has at most one loaded pair, at s = 0.
macro_rules! with_pairs {
    ($of:expr, $position:expr, ($spring:ident, $pairs:ident) => $body:expr) => {
        with_spring!(
            &$of.spring,
            $spring => with_pairs!(@ $of.engagement.pairs($position), $pairs, $body),
            if $of.is_single => with_pairs!(@ $of.single($position), $pairs, $body)
        )
    };
    (@ $found:expr, $pairs:ident, $body:expr) => {{
        let $pairs = $found.into_iter();
        $body
    }};
}

impl Mesh {
    /// Mesh of `pair`, for approaches up to `reach` [rad]. The law of a tooth pair is `spring` with `damping`, and its
    /// force acts at the resultant `whole`.
    pub fn new(
        pair: &Pair,
        (spring, damping): (AnySpring, Damping),
        whole: Resultant,
        corner_contact: bool,
        reach: f64,
    ) -> Self {
        Self { spring, damping, whole, is_single: false, engagement: Engagement::new(pair, corner_contact, reach) }
    }

    /// Half the normal backlash [rad].
    #[inline(always)]
    pub fn half_backlash(&self) -> f64 {
        self.engagement.half_backlash()
    }

    /// Approach of the drive flanks a_d at relative position `q` [rad].
    #[inline(always)]
    pub fn drive_approach(&self, q: f64) -> f64 {
        self.engagement.drive_approach(q)
    }

    /// Approach of the flank pair that can be loaded, negative inside the backlash [rad].
    #[inline(always)]
    pub fn approach(&self, q: f64) -> f64 {
        self.engagement.approach(q)
    }

    /// Fraction of the motion of `h` [s] from `state` at which the force of error-free teeth has its first kink, or
    /// `None`. A mesh with one spring has a kink when flanks touch or separate.
    #[inline(always)]
    pub fn kink(&self, state: &MeshState, h: f64) -> Option<f64> {
        let change = state.rate.map(|rate| h * rate);
        if self.is_single {
            return self.engagement.kink_of_touch(state.position[0], change[0]);
        }
        self.engagement.kink::<false>(state.position, change, |_, _, _| 0.0)
    }

    /// Fraction of the motion of `h` [s] from `state` at which the force of teeth with gaps or excess material has its
    /// first kink, or `None`. [`Engagement::kink`] describes `opening`.
    #[inline(always)]
    pub fn kink_of_open(&self, state: &MeshState, h: f64, opening: impl Fn(Flank, i64, f64) -> f64) -> Option<f64> {
        self.engagement.kink::<true>(state.position, state.rate.map(|rate| h * rate), opening)
    }

    /// The pair of a mesh with one spring at position (q, x), or `None` if it is not loaded.
    #[inline(always)]
    fn single(&self, position: [f64; 2]) -> Option<ToothPair> {
        let depth = self.approach(position[0]);
        (depth > 0.0).then(|| ToothPair::single(if position[0] < 0.0 { Flank::Drive } else { Flank::Coast }, depth))
    }

    /// Rate ḋ of a pair [m/s].
    #[inline(always)]
    pub fn rate(&self, pair: &ToothPair, state: &MeshState) -> f64 {
        self.whole.cone * (pair.slope[0] * state.rate[0] + pair.slope[1] * state.rate[1])
    }

    /// Rate ḋ [m/s] and response of a pair.
    #[inline(always)]
    fn respond<const WITH_ENERGY: bool>(
        &self,
        spring: &impl Spring,
        pair: &ToothPair,
        state: &MeshState,
    ) -> (f64, Response) {
        let (rate, local, law) = (self.rate(pair, state), spring.local(pair.s), (&self.whole, &self.damping));
        (rate, spring.respond_whole::<WITH_ENERGY>(&local, law, self.whole.cone * pair.depth, rate))
    }

    /// Calls `visit` with each loaded pair and its force. A pair is on the path of contact, or at a tip corner past its
    /// ends.
    pub fn loaded(&self, state: &MeshState, mut visit: impl FnMut(&ToothPair, &Force)) {
        with_pairs!(self, state.position, (spring, pairs) => for pair in pairs {
            visit(&pair, &self.respond::<false>(spring, &pair, state).1.force);
        });
    }

    /// Adds the force of a pair and the heat of its damping.
    #[inline(always)]
    fn add<S: Spring>(&self, _: &S, sum: &mut MeshForce, pair: &ToothPair, rate: f64, response: &Response) {
        let torque = self.whole.cone * response.force.total;
        sum.force[0] -= torque * pair.slope[0];
        sum.force[1] -= torque * pair.slope[1];
        if S::DEPENDS_ON_POSITION {
            sum.force[1] -= response.by_s * pair.s_slope;
        }
        sum.heat += (response.force.total - response.force.elastic) * rate;
    }

    /// Forces and heat.
    #[inline(always)]
    pub fn force(&self, state: &MeshState) -> MeshForce {
        let mut force = MeshForce::default();
        self.write_force(state, &mut force);
        force
    }

    /// Writes forces and heat to `to`, number by number. A wide store followed by the load of a single number could
    /// stall, because store-to-load forwarding may fail.
    #[inline(always)]
    pub fn write_force(&self, state: &MeshState, to: &mut MeshForce) {
        with_pairs!(self, state.position, (spring, pairs) => {
            let mut sum = MeshForce::default();
            for pair in pairs {
                let (rate, response) = self.respond::<false>(spring, &pair, state);
                self.add(spring, &mut sum, &pair, rate, &response);
            }
            (to.force[0], to.force[1], to.heat) = (sum.force[0], sum.force[1], sum.heat);
        })
    }

    /// Forces, heat and the forces' exact derivatives.
    #[inline(always)]
    pub fn linearise(&self, state: &MeshState) -> (MeshForce, MeshJacobian) {
        with_pairs!(self, state.position, (spring, pairs) => {
            let (mut sum, mut jacobian) = (MeshForce::default(), MeshJacobian::default());
            let r = self.whole.cone;
            for pair in pairs {
                let (rate, response) = self.respond::<true>(spring, &pair, state);
                self.add(spring, &mut sum, &pair, rate, &response);
                jacobian.energy += response.energy;
                let f = &response.force;
                let (stiffness, damping, torque) = (r * r * f.by_depth, r * r * f.by_rate, r * f.total);
                if pair.spot == Spot::Path {
                    // the approach depends only on q
                    jacobian.by_position[0][0] -= stiffness;
                    jacobian.by_rate[0][0] -= damping;
                } else {
                    let [qq, xx] = pair.curvature;
                    let turn = [qq * (state.rate[0] + state.rate[1]), qq * state.rate[0] + xx * state.rate[1]];
                    let hessian = [[qq, qq], [qq, xx]];
                    for b in 0..2 {
                        for a in 0..2 {
                            // (a, b) and (b, a) use the same product, so the Hessian is exactly symmetric
                            let slopes = pair.slope[a] * pair.slope[b];
                            let elastic = stiffness * slopes + torque * hessian[a][b];
                            jacobian.by_position[a][b] -= elastic + damping * turn[b] * pair.slope[a];
                            jacobian.by_rate[a][b] -= damping * slopes;
                        }
                    }
                }
                if depends_on_position(spring) {
                    // the position on the path moves only with x
                    let m = &mut jacobian.by_position;
                    m[0][1] -= r * response.total_by_s * pair.s_slope * pair.slope[0];
                    m[1][0] -= r * response.elastic_by_s * pair.s_slope * pair.slope[0];
                    m[1][1] -= pair.s_slope
                        * (r * (response.total_by_s + response.elastic_by_s) * pair.slope[1]
                            + response.by_s_twice * pair.s_slope);
                }
            }
            (sum, jacobian)
        })
    }

    /// Calls [`Self::write_force`] but is never inlined, so that callers other than the steps of plain teeth share one
    /// copy.
    #[inline(never)]
    pub fn write_force_not_inlined(&self, state: &MeshState, to: &mut MeshForce) {
        self.write_force(state, to);
    }

    /// Calls [`Self::linearise`] but is never inlined, so that other callers share one copy.
    #[inline(never)]
    pub fn linearise_not_inlined(&self, state: &MeshState) -> (MeshForce, MeshJacobian) {
        self.linearise(state)
    }

    /// Elastic energy V [J] at the position of `state`.
    pub fn energy(&self, state: &MeshState) -> f64 {
        with_pairs!(self, state.position, (spring, pairs) => {
            let mut energy = 0.0;
            for pair in pairs {
                energy += self.respond::<true>(spring, &pair, state).1.energy;
            }
            energy
        })
    }
}

//! Sums over the face of one tooth pair, from which its forces and their derivatives are computed.
//!
//! The arc of a slice p = A − E/R − turn − bend R depends only on the pair's approach A and opening E. The forces are
//! therefore sums of the slices' torques T with the weights 1 and 1/R:
//!
//! Q_A = −ΣT, Q_E = ΣT/R, Q_s = −ΣU_s
//!
//! The derivatives of the forces are sums of the same kind. T/R is the normal force of a slice.
//!
//! If the points of a part move with its ends ([`Moves`]), sums over f(R) dR also change by f dR·(stretch of the part)
//! and by f′(R) dR·(motion of the point). Loads vanish at moving ends, so both changes together equal the quadrature
//! error. Including them makes the derivatives exact for the sums, to the last digit.

use super::face::Part;
use super::loaded_span::Moves;
use super::{Node, Opening, SlidingGeometry};
use crate::contact::{Damping, Elastic, Sliding, Spring, ToothFriction};
use crate::numeric::Dual;

/// Approach and opening rates of a pair.
#[derive(Clone, Copy, Debug)]
pub struct Approach {
    /// A [rad].
    pub arc: f64,
    /// Ȧ [rad/s].
    pub rate: f64,
    /// Ė [m/s].
    pub opening_rate: f64,
}

/// Friction of a pair.
#[derive(Clone, Copy, Debug)]
pub struct PairFriction<'a> {
    /// The law.
    pub law: &'a ToothFriction,
    /// Geometry of sliding.
    pub geometry: SlidingGeometry,
    /// Sliding speed over R, and sum of both flanks' speeds over R [rad/s].
    pub speeds: [f64; 2],
    /// Points of the whole face, if one point represents its load. Sliding, and with it the coefficient of friction,
    /// differs over a face whose load per arc is uniform.
    pub whole: Option<&'a [Node]>,
}

/// Derivatives of a sum with respect to A, E, s, Ȧ, Ė.
pub type By = [f64; 5];

/// The sums of one pair.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sums {
    /// ΣT [N·m].
    pub torque: f64,
    /// ΣT/R [N].
    pub normal: f64,
    /// ΣU_s [N·m].
    pub by_s: f64,
    /// Σh T with the signed coefficient of friction h [N·m].
    pub friction: f64,
    /// Heat of contact damping [W].
    pub heat: f64,
    /// Elastic energy [J], summed only together with derivatives.
    pub energy: f64,
    /// Derivatives of `torque`, `normal`, `by_s` and `friction`.
    pub by: [By; 4],
    /// Derivatives of `friction` with respect to both speeds and to the relative radius of curvature over R.
    pub friction_by: [f64; 3],
}

/// One point of the face with its load.
pub struct LoadedNode<'a> {
    /// The point.
    pub node: &'a Node,
    /// Arc of the point [rad].
    pub arc: f64,
    /// Elastic response of the point per unit of weight.
    pub elastic: Elastic,
    /// Torque per unit of weight, including damping.
    pub torque: f64,
    /// Signed coefficient of friction and sliding of the flanks. If the point represents a whole face, the coefficient
    /// is a mean weighted by the torque.
    pub friction: Option<(f64, Sliding<f64>)>,
}

impl Sums {
    /// Adds the loads of `part` of the face; calls `look` with each loaded point.
    #[inline(always)]
    pub fn add<S: Spring, const SLOPES: bool, const OPEN: bool>(
        &mut self,
        part: &Part,
        (spring, local, damping): (&S, &S::Local, &Damping),
        at: &Approach,
        opening: &Opening,
        pair_friction: Option<&PairFriction>,
        mut look: impl FnMut(&LoadedNode),
    ) {
        for node in part.nodes {
            let opened = opening.turn + part.even * node.per_cone + opening.bend * node.cone;
            let arc = if OPEN { at.arc - opened } else { at.arc };
            // the arc can be rounded to zero at an end of the loaded part
            if arc <= 0.0 {
                continue;
            }
            let rate = if OPEN { at.rate - at.opening_rate * node.per_cone } else { at.rate };
            let elastic = spring.respond(local, arc);
            let damped = damping.apply(elastic.torque, elastic.stiffness, arc, rate);
            let (weight, per_cone) = (node.weight, node.per_cone);
            let torque = weight * damped.total;
            self.torque += torque;
            self.normal += torque * per_cone;
            self.by_s += weight * elastic.by_s;
            self.heat += weight * (damped.total - elastic.torque) * rate;
            let mut by = [0.0; 3];
            if SLOPES {
                self.energy += weight * elastic.energy;
                // damping is either added to the elastic torque or scales it
                let by_s = match *damping {
                    _ if damped.total <= 0.0 => 0.0,
                    Damping::Step { .. } => elastic.torque_by_s,
                    Damping::HuntCrossley { lambda } => elastic.torque_by_s * (1.0 + lambda * rate),
                };
                by = [damped.by_depth, by_s, damped.by_rate];
                add::<OPEN>(&mut self.by[0], weight, per_cone, by);
                add::<OPEN>(&mut self.by[1], weight * per_cone, per_cone, by);
                add::<OPEN>(&mut self.by[2], weight, per_cone, [elastic.torque_by_s, elastic.by_s_twice, 0.0]);
            }
            // derivatives along the face, for points that move
            let moving = if SLOPES && !spring.is_linear() { part.moves.as_ref() } else { None };
            let along = moving.map(|moves| {
                let closing = (part.even * per_cone) * per_cone - opening.bend;
                let along = by[0] * closing + by[2] * at.opening_rate * per_cone * per_cone;
                let by_cone = elastic.torque_by_s * closing + 2.0 * elastic.by_s * per_cone;
                let along = [along + 2.0 * damped.total * per_cone, along + damped.total * per_cone];
                move_with(&mut self.by[0], moves, node, weight * damped.total, weight * along[0]);
                move_with(&mut self.by[1], moves, node, torque * per_cone, weight * per_cone * along[1]);
                move_with(&mut self.by[2], moves, node, weight * elastic.by_s, weight * by_cone);
                (moves, along)
            });
            let friction = pair_friction.map(|pair_friction| {
                self.add_friction::<SLOPES, OPEN>(pair_friction, (node, damped.total), by, along.as_ref())
            });
            look(&LoadedNode { node, arc, elastic, torque: damped.total, friction });
        }
    }

    /// Adds the friction at a `node` whose torque per unit of weight is `total`. `by` contains the derivatives of this
    /// torque with respect to depth, s and rate. `along` contains the motion of the node, and the derivatives of torque
    /// and load along the face. Returns the signed coefficient of friction and the sliding of the flanks.
    #[inline(always)]
    fn add_friction<const SLOPES: bool, const OPEN: bool>(
        &mut self,
        pair_friction: &PairFriction,
        (node, total): (&Node, f64),
        by: [f64; 3],
        along: Option<&(&Moves, [f64; 2])>,
    ) -> (f64, Sliding<f64>) {
        let (mut share, mut coefficient) = (0.0, 0.0);
        for point in pair_friction.whole.unwrap_or(std::slice::from_ref(node)) {
            let (sliding, torque) = (pair_friction.at(point, total), point.weight * total);
            let h = if SLOPES {
                let h = pair_friction.law.signed(&sliding.with_slopes());
                let [by_sliding, by_sum_speed, by_load, by_radius] = h.d;
                let per_load = point.weight / (point.width * point.cone);
                let factor = point.weight * (h.v + total * by_load * per_load);
                add::<OPEN>(&mut self.by[3], factor, node.per_cone, by);
                let lever = torque * point.cone;
                self.friction_by[0] += lever * by_sliding;
                self.friction_by[1] += lever * by_sum_speed;
                self.friction_by[2] += lever * by_radius;
                if let Some(&(moves, [along, load])) = along {
                    // sliding, rolling and radius are proportional to R, the load per width to R T
                    let turning = by_sliding * pair_friction.speeds[0] + by_sum_speed * pair_friction.speeds[1];
                    let h_along = turning + by_radius * pair_friction.geometry.radius + by_load * load * node.cone;
                    let by_motion = node.weight * along * h.v + torque * h_along;
                    move_with(&mut self.by[3], moves, node, torque * h.v, by_motion);
                }
                h.v
            } else {
                pair_friction.law.signed(&sliding)
            };
            self.friction += torque * h;
            share += point.weight;
            coefficient += point.weight * h;
        }
        (coefficient / share, pair_friction.at(node, total))
    }
}

/// Adds to derivatives with respect to A, E, s, Ȧ, Ė: `weight` times a quantity's derivatives with respect to p, s and
/// ṗ.
#[inline(always)]
fn add<const OPEN: bool>(to: &mut By, weight: f64, per_cone: f64, [by_arc, by_s, by_rate]: [f64; 3]) {
    let (arc, rate) = (weight * by_arc, weight * by_rate);
    to[0] += arc;
    if OPEN {
        to[1] -= arc * per_cone;
        to[4] -= rate * per_cone;
    }
    to[2] += weight * by_s;
    to[3] += rate;
}

/// Adds the effect of the motion of `node` to a sum's derivatives with respect to A and E. The node contributes `value`
/// to the sum, and `along` is the derivative of this contribution along the face.
#[inline(always)]
fn move_with(to: &mut By, moves: &Moves, node: &Node, value: f64, along: f64) {
    let [by_arc, by_even] = moves.at(node.cone);
    to[0] += along * by_arc[0] + value * by_arc[1];
    to[1] += along * by_even[0] + value * by_even[1];
}

impl PairFriction<'_> {
    /// Sliding of the flanks at a point with the torque `torque` per unit of weight.
    #[inline(always)]
    fn at(&self, node: &Node, torque: f64) -> Sliding<f64> {
        Sliding {
            sliding: self.speeds[0] * node.cone,
            sum_speed: self.speeds[1] * node.cone,
            load: torque * node.weight / (node.cone * node.width),
            radius: self.geometry.radius * node.cone,
        }
    }
}

impl Sliding<f64> {
    /// Returns dual numbers in which each quantity is a separate variable.
    #[inline(always)]
    fn with_slopes(&self) -> Sliding<Dual<4>> {
        Sliding {
            sliding: Dual::variable(self.sliding, 0),
            sum_speed: Dual::variable(self.sum_speed, 1),
            load: Dual::variable(self.load, 2),
            radius: Dual::variable(self.radius, 3),
        }
    }
}

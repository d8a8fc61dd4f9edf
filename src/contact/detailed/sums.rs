//! Sums over the face of one tooth pair: all that its forces and their derivatives are made of.
//!
//! The arc of a slice p = A − E/R − turn − bend R moves with the pair's approach A and opening E alone, so that forces are
//! sums with the weights 1 and 1/R of the slices' torques T:
//!
//!   Q_A = −ΣT,   Q_E = ΣT/R,   Q_s = −ΣU_s
//!
//! and so are their derivatives. T/R is the normal force of a slice.
//!
//! Where the points of a part move with its ends ([`Moves`]), sums over f(R) dR also change by f dR·(stretch of the part) and
//! by f′(R) dR·(motion of the point). Both together are the error of the quadrature alone, as loads vanish at ends that move;
//! with them derivatives are those of the sums to the last digit.

use super::carrying::Moves;
use super::face::Part;
use super::{Arms, Node, Opening};
use crate::contact::{Damping, Elastic, Sliding, Spring, ToothFriction};
use crate::numeric::Dual;

/// How near a pair is and how it moves.
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
pub struct Rubbing<'a> {
    /// The law.
    pub law: &'a ToothFriction,
    /// Arms of sliding.
    pub arms: Arms,
    /// Sliding speed over R, and sum of both flanks' speeds over R [rad/s].
    pub speeds: [f64; 2],
    /// Points of the whole face where one point has its load: sliding, and with it the coefficient of friction, differs over a
    /// face whose load per arc does not.
    pub whole: Option<&'a [Node]>,
}

/// Derivatives of a sum by A, E, s, Ȧ, Ė.
pub type By = [f64; 5];

/// The sums of one pair.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sums {
    /// ΣT [N·m].
    pub torque: f64,
    /// ΣT/R [N].
    pub normal: f64,
    /// ΣU_s [N·m].
    pub by_place: f64,
    /// Σh T with the signed coefficient of friction h [N·m].
    pub rubbed: f64,
    /// Heat of contact damping [W].
    pub heat: f64,
    /// Elastic energy [J], summed with derivatives.
    pub energy: f64,
    /// Derivatives of torque, normal, by_place and rubbed.
    pub by: [By; 4],
    /// Derivatives of rubbed by both speeds and by the relative radius of curvature over R.
    pub rubbed_by: [f64; 3],
}

/// One point of the face with its load.
pub struct LoadedNode<'a> {
    /// The point.
    pub node: &'a Node,
    /// Its arc [rad].
    pub arc: f64,
    /// Its elastic response, per unit of weight.
    pub elastic: Elastic,
    /// Torque over weight, damping included.
    pub torque: f64,
    /// Signed coefficient of friction, a mean with the weight of the torque if the point is a whole face, and how the flanks slide.
    pub friction: Option<(f64, Sliding<f64>)>,
}

impl Sums {
    /// Adds what `part` of the face carries; calls `look` with each loaded point.
    #[inline(always)]
    pub fn add<S: Spring, const SLOPES: bool, const OPEN: bool>(
        &mut self,
        part: &Part,
        (spring, place, damping): (&S, &S::Place, &Damping),
        at: &Approach,
        opening: &Opening,
        rubbing: Option<&Rubbing>,
        mut look: impl FnMut(&LoadedNode),
    ) {
        for node in part.nodes {
            let opened = opening.turn + part.even * node.per_cone + opening.bend * node.cone;
            let arc = if OPEN { at.arc - opened } else { at.arc };
            // rounding at an end of the part that carries
            if arc <= 0.0 {
                continue;
            }
            let rate = if OPEN { at.rate - at.opening_rate * node.per_cone } else { at.rate };
            let elastic = spring.respond(place, arc);
            let damped = damping.apply(elastic.torque, elastic.stiffness, arc, rate);
            let (weight, per_cone) = (node.weight, node.per_cone);
            let torque = weight * damped.total;
            self.torque += torque;
            self.normal += torque * per_cone;
            self.by_place += weight * elastic.by_place;
            self.heat += weight * (damped.total - elastic.torque) * rate;
            let mut by = [0.0; 3];
            if SLOPES {
                self.energy += weight * elastic.energy;
                // damping either adds to the elastic torque or scales it
                let by_place = match *damping {
                    _ if damped.total <= 0.0 => 0.0,
                    Damping::Step { .. } => elastic.torque_by_place,
                    Damping::HuntCrossley { lambda } => elastic.torque_by_place * (1.0 + lambda * rate),
                };
                by = [damped.by_depth, by_place, damped.by_rate];
                add::<OPEN>(&mut self.by[0], weight, per_cone, by);
                add::<OPEN>(&mut self.by[1], weight * per_cone, per_cone, by);
                add::<OPEN>(&mut self.by[2], weight, per_cone, [elastic.torque_by_place, elastic.by_place_twice, 0.0]);
            }
            // where points move: what comes to theirs along the face
            let moving = if SLOPES && !S::LINEAR { part.moves.as_ref() } else { None };
            let along = moving.map(|moves| {
                let closing = (part.even * per_cone) * per_cone - opening.bend;
                let along = by[0] * closing + by[2] * at.opening_rate * per_cone * per_cone;
                let place = elastic.torque_by_place * closing + 2.0 * elastic.by_place * per_cone;
                let along = [along + 2.0 * damped.total * per_cone, along + damped.total * per_cone];
                move_with(&mut self.by[0], moves, node, weight * damped.total, weight * along[0]);
                move_with(&mut self.by[1], moves, node, torque * per_cone, weight * per_cone * along[1]);
                move_with(&mut self.by[2], moves, node, weight * elastic.by_place, weight * place);
                (moves, along)
            });
            let friction = rubbing.map(|rubbing| {
                let (mut share, mut coefficient) = (0.0, 0.0);
                for point in rubbing.whole.unwrap_or(std::slice::from_ref(node)) {
                    let (sliding, torque) = (rubbing.at(point, damped.total), point.weight * damped.total);
                    let h = if SLOPES {
                        let h = rubbing.law.signed(&sliding.with_slopes());
                        let [by_sliding, by_sum_speed, by_load, by_radius] = h.d;
                        let per_load = point.weight / (point.width * point.cone);
                        let factor = point.weight * (h.v + damped.total * by_load * per_load);
                        add::<OPEN>(&mut self.by[3], factor, per_cone, by);
                        let lever = torque * point.cone;
                        self.rubbed_by[0] += lever * by_sliding;
                        self.rubbed_by[1] += lever * by_sum_speed;
                        self.rubbed_by[2] += lever * by_radius;
                        if let Some((moves, [along, load])) = along {
                            // sliding, rolling and radius grow with R, the load per width as R T
                            let turning = by_sliding * rubbing.speeds[0] + by_sum_speed * rubbing.speeds[1];
                            let h_along = turning + by_radius * rubbing.arms.radius + by_load * load * node.cone;
                            let by_motion = weight * along * h.v + torque * h_along;
                            move_with(&mut self.by[3], moves, node, torque * h.v, by_motion);
                        }
                        h.v
                    } else {
                        rubbing.law.signed(&sliding)
                    };
                    self.rubbed += torque * h;
                    share += point.weight;
                    coefficient += point.weight * h;
                }
                (coefficient / share, rubbing.at(node, damped.total))
            });
            look(&LoadedNode { node, arc, elastic, torque: damped.total, friction });
        }
    }
}

/// Adds `weight` times what depends on p, s and ṗ as `by` to derivatives by A, E, s, Ȧ, Ė.
#[inline(always)]
fn add<const OPEN: bool>(to: &mut By, weight: f64, per_cone: f64, [by_arc, by_place, by_rate]: [f64; 3]) {
    let (arc, rate) = (weight * by_arc, weight * by_rate);
    to[0] += arc;
    if OPEN {
        to[1] -= arc * per_cone;
        to[4] -= rate * per_cone;
    }
    to[2] += weight * by_place;
    to[3] += rate;
}

/// Adds what the motion of `node` adds to derivatives by A and E of a sum to which it adds `value`, which changes by `along`
/// along the face.
#[inline(always)]
fn move_with(to: &mut By, moves: &Moves, node: &Node, value: f64, along: f64) {
    let [by_arc, by_even] = moves.at(node.cone);
    to[0] += along * by_arc[0] + value * by_arc[1];
    to[1] += along * by_even[0] + value * by_even[1];
}

impl Rubbing<'_> {
    /// How the flanks slide at a point that carries the torque `torque` per unit of weight.
    #[inline(always)]
    fn at(&self, node: &Node, torque: f64) -> Sliding<f64> {
        Sliding {
            sliding: self.speeds[0] * node.cone,
            sum_speed: self.speeds[1] * node.cone,
            load: torque * node.weight / (node.cone * node.width),
            radius: self.arms.radius * node.cone,
        }
    }
}

impl Sliding<f64> {
    /// The same with each quantity as a variable of its own.
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

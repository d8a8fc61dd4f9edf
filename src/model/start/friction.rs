//! Torques of dry friction at the start.
//!
//! Friction of a pair that slides has its limit torque. Pairs at rest share what would move them, like springs in
//! parallel, until a torque T_i reaches its limit L_i; the pair then begins to slide. With the accelerations of their
//! slips ẅ = ẅ₀ − G T, and the stiffnesses k_i of their springs,
//!
//!   ẅ₀ − G T = δ (T_i − T'_i)/k_i   for pairs that are held, |T_i| ≤ L_i
//!   T_i = ±L_i                       for pairs that begin to slide, in the direction of ẅ_i
//!
//! The small δ selects the shares of parallel springs, which are relaxed at the torques T'. The equations are solved
//! again with the result as T' until it settles, so that δ leaves no error: if all pairs hold, ẅ = 0 (proximal point
//! method, R. T. Rockafellar, SIAM J. Control Optim. 14 (1976) 877). The spring of a brake is in series with the
//! half-shaft.

use nalgebra::{DMatrix, DVector};

use super::carried::{Accelerations, Carried, StartingScene};
use crate::model::dynamics::MAX_SIZE;
use crate::model::dynamics::inputs_and_friction::slip_speed;
use crate::model::effect_kinds::dry_friction::{DryFriction, SPEED_TOLERANCE};
use crate::model::effect_kinds::{PairFriction, SurfaceLoad};
use crate::model::scene::{InputDerivatives, PAIRS, PINION_PAIR, RubbingKind, RubbingPair};

/// Weight δ of the springs relative to the largest G_ii k_i.
const SPRINGS: f64 = 1e-8;
/// Maximum number of times that the springs are applied, and relative change of the torques at which this ends.
const APPLICATIONS: usize = 1000;
const SETTLED: f64 = 1e-14;
/// Number of rounds in which the friction of the pinion and the torque of its mesh find each other.
const ROUNDS: usize = 100;
/// Maximum number of changes of the set of sliding pairs.
const CHANGES: usize = 1000;
/// Rounding error of limits and accelerations.
const ROUNDING: f64 = 1e-9;

/// A pair at rest.
struct AtRest<'a> {
    pair: &'a RubbingPair,
    /// Compliance 1/k of the spring that holds it [rad/(N·m)].
    compliance: f64,
    /// Torque T' at which this spring is relaxed [N·m].
    relaxed: f64,
    /// Limit torque L while it is held, and as soon as it slides [N·m].
    limits: [f64; 2],
}

/// Pairs at rest, which share what would move them.
struct HeldPairs<'a> {
    held: &'a [AtRest<'a>],
    /// Rates at which their slips change without friction ẅ₀ [rad/s²].
    free: DVector<f64>,
    /// Their derivatives with respect to the torques, with opposite sign: G [rad/(N·m·s²)].
    mobility: DMatrix<f64>,
}

/// Torques at the `start`. Dry friction acts under the loads `on_meshes` and under its commands.
pub fn carried(start: &StartingScene, on_meshes: &[SurfaceLoad; PAIRS]) -> Carried {
    let mut carried = Carried::under(start, &PairFriction::NONE);
    // the friction of the pinion depends on the torque that it leaves to the mesh
    for _ in 0..ROUNDS {
        let friction = of_pairs(start, on_meshes, &carried);
        if friction == carried.friction {
            break;
        }
        carried = Carried::under(start, &friction);
    }
    carried
}

/// Torque with which dry friction holds each pair back at the `start` [N·m], under the loads `on_meshes` and under the
/// torque of the pinion's mesh in `carried`.
fn of_pairs(start: &StartingScene, on_meshes: &[SurfaceLoad; PAIRS], carried: &Carried) -> PairFriction {
    let (effects, state) = (start.model.body_effects(), start.state);
    let mut found = PairFriction::NONE;
    if !effects.may_have_dry_friction(state) {
        return found;
    }
    let temperatures = &state.sums.thermal.used;
    let friction = effects.friction((state.lock, temperatures), start.inputs, &InputDerivatives::ZERO);
    let mut loads = *on_meshes;
    friction.add_commands(start.inputs, &mut loads);
    loads[PINION_PAIR].load = effects.loss.map_or(0.0, |loss| loss.of(carried.in_front.ring));
    let at = state.point::<MAX_SIZE>();
    let mut at_rest = Vec::new();
    for pair in effects.pairs.iter().flatten() {
        let (i, speed) = (pair.number, slip_speed(&at, pair));
        let (on_pair, load) = (DryFriction::new(friction.on(i), &effects.surfaces), &loads[i]);
        if !on_pair.is_on() {
            continue;
        }
        if speed.abs() > SPEED_TOLERANCE {
            found.torque[i] = speed.signum() * on_pair.sliding_limit(speed.abs(), load)[0];
        } else if on_pair.stiffness() > 0.0 {
            let limits = [on_pair.breakaway(load), on_pair.sliding_limit(0.0, load)[0]];
            match start.lone_wheel(pair) {
                Some(load) => (found.torque[i], found.begins[i]) = single(-load, limits),
                None => at_rest.push(AtRest::new(start, pair, on_pair.stiffness(), limits)),
            }
        }
    }
    if !at_rest.is_empty() {
        let (torques, begins) = HeldPairs::new(start, &found, &at_rest).torques();
        for (i, of) in at_rest.iter().enumerate() {
            (found.torque[of.pair.number], found.begins[of.pair.number]) = (torques[i], begins[i]);
        }
    }
    found
}

/// Torque that holds a single body against the torque `wanted`, and the direction in which it begins to slide if this
/// is beyond its limits.
fn single(wanted: f64, [held, sliding]: [f64; 2]) -> (f64, f64) {
    if wanted.abs() <= held { (wanted, 0.0) } else { (sliding.copysign(wanted), wanted.signum()) }
}

impl<'a> AtRest<'a> {
    /// Pair with the stiffness of its friction [N·m/rad] and its limit torques [N·m].
    fn new(start: &StartingScene, pair: &'a RubbingPair, stiffness: f64, limits: [f64; 2]) -> Self {
        let own = 1.0 / stiffness;
        let (RubbingKind::Wheel, s) = RubbingKind::of(pair.number) else {
            return Self { pair, compliance: own, relaxed: 0.0, limits };
        };
        // the half-shaft is in series, and the load of the wheel acts between both
        let shaft = start.model.body_effects().half_shafts.compliance(s);
        let (compliance, load) = (own + shaft, start.load(s));
        Self { pair, compliance, relaxed: -load * shaft / compliance, limits }
    }
}

impl<'a> HeldPairs<'a> {
    /// The pairs `held`, while the others slide under `sliding`.
    fn new(start: &StartingScene, sliding: &PairFriction, held: &'a [AtRest]) -> Self {
        let (n, free) = (held.len(), Carried::under(start, sliding));
        let one = |j: usize| std::array::from_fn(|number| f64::from(number == held[j].pair.number));
        let by_torque: Vec<Accelerations> = (0..n).map(|j| start.accelerations_by(&one(j))).collect();
        Self {
            held,
            free: DVector::from_fn(n, |i, _| free.acceleration.of_slip(held[i].pair)),
            mobility: DMatrix::from_fn(n, n, |i, j| -by_torque[j].of_slip(held[i].pair)),
        }
    }

    /// Torques that hold the pairs back [N·m], and the directions ±1 in which pairs begin to slide; 0 if they are held.
    fn torques(&self) -> (DVector<f64>, Vec<f64>) {
        let n = self.held.len();
        let compliance = DVector::from_fn(n, |i, _| self.held[i].compliance);
        let stiffest = self.mobility.diagonal().component_div(&compliance).max();
        let mut found = (DVector::from_fn(n, |i, _| self.held[i].relaxed), vec![0.0; n]);
        // without any mobility, imposed motions carry everything
        if stiffest <= 0.0 {
            return (DVector::zeros(n), found.1);
        }
        let springs = compliance * (SPRINGS * stiffest);
        for _ in 0..APPLICATIONS {
            let next = self.with_springs(&springs, &found.0);
            let has_settled = (&next.0 - &found.0).amax() <= SETTLED * next.0.amax();
            found = next;
            if has_settled {
                break;
            }
        }
        found
    }

    /// Torques that solve the equations above with δ/k = `springs` and T' = `from`. A pair beyond its limit slides, and
    /// is held again if its slip would turn back.
    fn with_springs(&self, springs: &DVector<f64>, from: &DVector<f64>) -> (DVector<f64>, Vec<f64>) {
        let n = self.held.len();
        let matrix = &self.mobility + DMatrix::from_diagonal(springs);
        let wanted = &self.free + springs.component_mul(from);
        let (mut begins, mut torques) = (vec![0.0; n], DVector::<f64>::zeros(n));
        for round in 0..CHANGES {
            // rows of sliding pairs keep their limit torques
            let (mut rows, mut right) = (matrix.clone(), wanted.clone());
            for i in (0..n).filter(|&i| begins[i] != 0.0) {
                rows.row_mut(i).fill(0.0);
                (rows[(i, i)], right[i]) = (1.0, begins[i] * self.held[i].limits[1]);
            }
            // springs make the matrix regular
            let Some(solved) = rows.lu().solve(&right) else { break };
            torques = solved;
            let moves = &wanted - &matrix * &torques;
            let is_wrong = |i: usize| match begins[i] {
                0.0 => torques[i].abs() > self.held[i].limits[0] * (1.0 + ROUNDING),
                direction => moves[i] * direction < -ROUNDING * wanted.amax(),
            };
            // changing all of them together converges in few rounds or never; changing only the first one always
            // converges (K. G. Murty, Opsearch 11 (1974) 123)
            let wrong: Vec<usize> = (0..n).filter(|&i| is_wrong(i)).take(if round < n { n } else { 1 }).collect();
            if wrong.is_empty() {
                break;
            }
            for i in wrong {
                begins[i] = if begins[i] == 0.0 { torques[i].signum() } else { 0.0 };
            }
        }
        (torques, begins)
    }
}

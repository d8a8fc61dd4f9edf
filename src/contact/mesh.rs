//! The elastic potential of one mesh: from it force, Jacobian, energy and heat, all at one place.
//!
//! Coordinates: q = sinδ_bs·α − σ·sinδ_bp·ψ, the relative position measured from "tooth in the middle of the gap", and
//! x = σ·sinδ_bp·ψ + h, the planet's travel along the line of action. Both are arcs on the unit sphere [rad].
//! The drive flanks approach by a = −q − b_n/2, the coast flanks by a = q − b_n/2. Tooth pair k stands at
//! s = γ_p,pitch sinδ_bp ± x + k p_b (+ drive, − coast) and penetrates by d = R (a − g), where g is the corner gap
//! beyond the planet's tip, at Δ = s − s_hi, or beyond the side gear's tip, at Δ = s_lo − s + a: that corner rides on
//! the side gear, whose own position is s − a.
//!
//! V(q, x) = Σ U(d). Forces are −∇V with ∂V/∂x included, so that an undamped scene conserves energy.

use super::impact::{Force, Impact};
use crate::geometry::Pair;
use crate::geometry::corner::CornerGap;

/// Flank of the planet tooth that carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flank {
    /// Carrier drives the side gear forward.
    Drive,
    /// Side gear drives the carrier forward.
    Coast,
}

/// Where a loaded pair touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// On the path of contact.
    Path,
    /// The planet's tip corner on the side gear's flank.
    PlanetTip,
    /// The side gear's tip corner on the planet's flank.
    SideTip,
}

/// One loaded tooth pair, with the derivatives of its penetration arc p = d/R by q and x.
#[derive(Clone, Copy, Debug)]
pub struct ToothPair {
    /// Flank in contact.
    pub flank: Flank,
    /// Kind of contact.
    pub spot: Spot,
    /// Arc Δ past the end of the path [rad]; the position s on the path if on it.
    pub place: f64,
    /// Penetration arc p = a − g [rad], positive.
    pub depth: f64,
    /// ∂p/∂q and ∂p/∂x.
    pub slope: [f64; 2],
    /// ∂²p/∂q² = ∂²p/∂q∂x, and ∂²p/∂x² [1/rad].
    pub curvature: [f64; 2],
}

/// Mesh state: q, x and their rates.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshState {
    /// Relative position and planet travel [rad].
    pub position: [f64; 2],
    /// Their rates [rad/s].
    pub rate: [f64; 2],
}

/// Forces of a mesh conjugate to (q, x) [N·m per rad on the unit sphere], and heat.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshForce {
    /// −∂V/∂(q, x) with damping [N·m].
    pub force: [f64; 2],
    /// Power turned into heat [W].
    pub heat: f64,
}

/// Derivatives of the forces of a mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshJacobian {
    /// ∂force/∂(q, x) [N·m/rad].
    pub by_position: [[f64; 2]; 2],
    /// ∂force/∂(q̇, ẋ) [N·m·s/rad].
    pub by_rate: [[f64; 2]; 2],
}

impl MeshForce {
    /// Adds the force `f` of a pair with slopes `slope` at cone distance `r`, approaching with `rate` [m/s].
    #[inline]
    fn add(&mut self, f: &Force, slope: [f64; 2], r: f64, rate: f64) {
        let torque = r * f.total;
        self.force[0] -= torque * slope[0];
        self.force[1] -= torque * slope[1];
        self.heat += (f.total - f.elastic) * rate;
    }
}

/// A planet meshing with a side gear under the IMPACT law.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Contact law.
    pub law: Impact,
    /// Cone distance at which the law acts: R_m [m].
    pub cone: f64,
    /// Gap functions of the planet's and the side gear's tip corner.
    pub corner: [CornerGap; 2],
    half_backlash: f64,
    base_pitch: f64,
    per_base_pitch: f64,
    centred: f64,
    low: f64,
    high: f64,
    corner_contact: bool,
    /// Where tooth pairs can touch at working loads, and up to the largest approach.
    windows: [Window; 2],
}

/// Part of the line of action in which pairs can touch up to some approach.
#[derive(Clone, Copy, Debug)]
struct Window {
    /// Its lower end [rad].
    low: f64,
    /// Tooth pairs that fit in: a fixed count, so that no wild trial state can keep a step busy.
    candidates: usize,
}

/// Approach [rad] up to which the narrow window serves: some tenths of a millimetre, beyond any working load.
const WORKING_APPROACH: f64 = 5e-3;

/// Margin that keeps rounding from losing a pair that just touches [base pitches, rad].
const ROUNDING: f64 = 1e-9;

/// Smallest whole number not below `x`, for |x| far below 2⁶³.
#[inline]
fn ceil(x: f64) -> f64 {
    let whole = x as i64 as f64;
    if whole < x { whole + 1.0 } else { whole }
}

impl Mesh {
    /// Mesh of `pair` under `law` for approaches up to `reach` [rad].
    pub fn new(pair: &Pair, law: Impact, corner_contact: bool, reach: f64) -> Self {
        let corner = [CornerGap::new(pair, 0, reach), CornerGap::new(pair, 1, reach)];
        let low = -corner[1].end;
        let high = corner[0].end;
        let window = |approach: f64| {
            let beyond = |i: usize| if corner_contact { corner[i].reach(approach) } else { 0.0 };
            let length = beyond(1) + (high - low) + beyond(0);
            Window { low: low - beyond(1), candidates: libm::ceil(length / pair.base_pitch) as usize }
        };
        Self {
            windows: [window(WORKING_APPROACH), window(reach)],
            law,
            cone: pair.mean_cone,
            half_backlash: pair.normal_backlash / 2.0,
            base_pitch: pair.base_pitch,
            per_base_pitch: 1.0 / pair.base_pitch,
            centred: pair.centred_position(),
            low,
            high,
            corner,
            corner_contact,
        }
    }

    /// Half the normal backlash [rad].
    pub fn half_backlash(&self) -> f64 {
        self.half_backlash
    }

    /// Approach of the drive flanks a_d at relative position `q` [rad].
    pub fn drive_approach(&self, q: f64) -> f64 {
        -q - self.half_backlash
    }

    /// Approach of the flank pair that carries, negative inside the lash [rad].
    pub fn approach(&self, q: f64) -> f64 {
        q.abs() - self.half_backlash
    }

    /// Calls `visit` with each loaded tooth pair at position (q, x).
    #[inline(always)]
    pub fn pairs(&self, [q, x]: [f64; 2], mut visit: impl FnMut(&ToothPair)) {
        // only one flank of a gap can carry: sign = ∂a/∂q = −∂s/∂x
        let approach = self.approach(q);
        if approach <= 0.0 {
            return;
        }
        let (flank, sign) = if q < 0.0 { (Flank::Drive, -1.0) } else { (Flank::Coast, 1.0) };
        let start = self.centred - sign * x;
        let window = &self.windows[usize::from(approach > WORKING_APPROACH)];
        let first = ceil((window.low - start) * self.per_base_pitch - ROUNDING);
        let mut s = start + first * self.base_pitch;
        let mut visit_loaded = |pair: &ToothPair| {
            if pair.depth > 0.0 {
                visit(pair);
            }
        };
        for _ in 0..window.candidates {
            let past_planet_tip = s - self.high;
            let past_side_tip = self.low - s + approach;
            if past_planet_tip > 0.0 {
                if past_planet_tip * past_planet_tip < approach * self.corner[0].spread && self.corner_contact {
                    let g = self.corner[0].at(past_planet_tip);
                    visit_loaded(&ToothPair {
                        flank,
                        spot: Spot::PlanetTip,
                        place: past_planet_tip,
                        depth: approach - g.v,
                        slope: [sign, sign * g.d],
                        curvature: [0.0, -g.dd],
                    });
                }
            } else if past_side_tip > 0.0 && self.corner_contact {
                if past_side_tip * past_side_tip < approach * self.corner[1].spread {
                    // Δ moves with q by `sign` and with x by `sign` too
                    let g = self.corner[1].at(past_side_tip);
                    visit_loaded(&ToothPair {
                        flank,
                        spot: Spot::SideTip,
                        place: past_side_tip,
                        depth: approach - g.v,
                        slope: [sign * (1.0 - g.d), -sign * g.d],
                        curvature: [-g.dd, -g.dd],
                    });
                }
            } else if s >= self.low {
                visit_loaded(&ToothPair {
                    flank,
                    spot: Spot::Path,
                    place: s,
                    depth: approach,
                    slope: [sign, 0.0],
                    curvature: [0.0, 0.0],
                });
            }
            s += self.base_pitch;
        }
    }

    /// Rate ḋ [m/s] and force of a pair.
    #[inline]
    pub fn pair_force(&self, pair: &ToothPair, state: &MeshState) -> (f64, Force) {
        let rate = self.cone * (pair.slope[0] * state.rate[0] + pair.slope[1] * state.rate[1]);
        (rate, self.law.force(self.cone * pair.depth, rate))
    }

    /// Forces and heat.
    #[inline]
    pub fn force(&self, state: &MeshState) -> MeshForce {
        let mut sum = MeshForce::default();
        self.pairs(state.position, |pair| {
            let (rate, f) = self.pair_force(pair, state);
            sum.add(&f, pair.slope, self.cone, rate);
        });
        sum
    }

    /// Forces, heat and the forces' exact derivatives.
    pub fn linearise(&self, state: &MeshState) -> (MeshForce, MeshJacobian) {
        let (mut sum, mut jacobian) = (MeshForce::default(), MeshJacobian::default());
        let r = self.cone;
        self.pairs(state.position, |pair| {
            let (rate, f) = self.pair_force(pair, state);
            sum.add(&f, pair.slope, r, rate);
            let [qq, xx] = pair.curvature;
            let turn = [qq * (state.rate[0] + state.rate[1]), qq * state.rate[0] + xx * state.rate[1]];
            let hessian = [[qq, qq], [qq, xx]];
            for a in 0..2 {
                for b in 0..2 {
                    let along = f.by_depth * pair.slope[b] + f.by_rate * turn[b];
                    jacobian.by_position[a][b] -= r * (r * along * pair.slope[a] + f.total * hessian[a][b]);
                    jacobian.by_rate[a][b] -= r * r * f.by_rate * pair.slope[a] * pair.slope[b];
                }
            }
        });
        (sum, jacobian)
    }

    /// Elastic energy V [J] at position (q, x).
    pub fn energy(&self, position: [f64; 2]) -> f64 {
        let mut energy = 0.0;
        self.pairs(position, |pair| energy += self.law.energy(self.cone * pair.depth));
        energy
    }
}

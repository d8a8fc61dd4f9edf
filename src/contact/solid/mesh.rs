//! A mesh of solid teeth: the potential of all pairs and sections that overlap.
//!
//!   V(q, x) = Σ_k Σ_j ω_j U(R_m p_kj(q, x)),   Σ_j ω_j = 1
//!
//! over pairs k and sections j across the face, p the overlap of a section as an arc ([`super::overlap`]) and U of the
//! law of a pair (IMPACT): slices of a straight bevel tooth are similar, so that the load per width depends on the arc
//! alone. A section that moves by δp gives way by R_j δp where it is, so that its force is
//!
//!   F_j = ω_j R_m/R_j U′(R_m p_kj)
//!
//! the only one that balances the torques. With ω_j ∝ R_j times its width aligned flanks load the face evenly; then
//! the resultant acts at R_m and V is that of tooth pairs on the path of contact. On misaligned or crowned flanks
//! every section carries the load of its own overlap.

use std::ops::RangeInclusive;

use super::candidates::Candidates;
use super::flank::Flanks;
pub use super::loads::SolidLoad;
use super::overlap::{FlankSection, Softness};
use super::pose::{Displacement, Placement};
use crate::contact::damping::Damping;
use crate::contact::impact::{Force, Impact};
use crate::contact::pairs::Flank;
use crate::contact::state::{MeshForce, MeshJacobian, MeshState};
use crate::geometry::Pair;
use crate::numeric::{Curved, Dual, Smooth, tan};

/// A section across the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidSlice {
    /// Cone distance R_j [m].
    pub cone: f64,
    /// ω_j.
    pub share: f64,
    /// Width that it represents [m].
    pub width: f64,
    /// Material missing there on the pair by crowning [m].
    pub relief: f64,
}

/// What defines the solids.
#[derive(Clone, Debug)]
pub struct SolidSpec {
    /// Angular radius of the root fillets [rad].
    pub fillet: f64,
    /// Facets per flank.
    pub facets: usize,
    /// Multiple of the usual softness.
    pub smoothing: f64,
    /// Sections across the face; one at R_m where all are alike.
    pub slices: Vec<SolidSlice>,
    /// Displacement of each planet against the left and right side gear.
    pub displaced: Vec<[Displacement; 2]>,
}

/// ε in heights of arc, so that the patch is almost as wide as a facet and passes from one to the next without a
/// ripple: at half-width c·facet the first harmonic of the facets is damped by exp(−2π²c²).
const SOFTNESS: f64 = 1.25;

/// Upper bound of a flank's length [rad].
const LONGEST: f64 = 1.0;

/// A mesh of solid teeth.
#[derive(Clone, Debug)]
pub struct SolidMesh {
    /// Law of a section, as if the whole face were in its state.
    pub elastic: Impact,
    /// Damping.
    pub damping: Damping,
    pub(super) cone: f64,
    flanks: Flanks,
    candidates: Candidates,
    pub(super) soft: Softness,
    pub(super) slices: Vec<SolidSlice>,
    /// Sections without a share, at which the load is only looked at.
    pub edges: Vec<SolidSlice>,
    /// Drive and mirrored coast flank of each planet with each side.
    placements: Vec<[[Placement; 2]; 2]>,
    half_backlash: f64,
    base_pitch: f64,
    centred: f64,
    /// Magnitude of the negative approach from which flanks can still touch [rad].
    slack: f64,
}

impl SolidMesh {
    /// Mesh of `pair` whose planets may be displaced; `slack` [m] bounds the gap that displacements can close.
    pub fn new(pair: &Pair, spec: &SolidSpec, elastic: Impact, damping: Damping, slack: f64) -> Self {
        let flanks = Flanks::new(pair, spec.fillet, spec.facets);
        let width = SOFTNESS * spec.smoothing * (flanks.sagitta[0] + flanks.sagitta[1]);
        let relative = 1.0 / (1.0 / tan(pair.pitch_arc[0]) + 1.0 / tan(pair.pitch_arc[1]));
        let soft = Softness::new(width, relative, LONGEST);
        let ahead = soft.ahead;
        let placements = spec
            .displaced
            .iter()
            .map(|sides| sides.map(|d| [Placement::new(pair, &d), Placement::new(pair, &d.mirrored())]))
            .collect();
        Self {
            elastic,
            damping,
            cone: pair.mean_cone,
            candidates: Candidates::new(pair, &flanks, slack / pair.inner_cone + soft.reach()),
            flanks,
            soft,
            slices: spec.slices.clone(),
            edges: Vec::new(),
            placements,
            half_backlash: pair.normal_backlash / 2.0,
            base_pitch: pair.base_pitch,
            centred: pair.centred_position(),
            slack: slack / pair.inner_cone + ahead,
        }
    }

    /// Sections across the face.
    pub fn section_count(&self) -> usize {
        self.slices.len()
    }

    /// Visits each of `slices` of each pair near contact with its overlap as a function of (q, x), slopes by (q, x) included.
    #[inline]
    pub(super) fn sections<T: Smooth>(
        &self,
        slices: &[SolidSlice],
        which: [usize; 2],
        [q, x]: [f64; 2],
        variable: impl Fn(f64, usize, f64) -> T,
        mut visit: impl FnMut(&FlankPair, &SolidSlice, T),
    ) {
        for (flank, sign) in [(Flank::Drive, 1.0), (Flank::Coast, -1.0)] {
            let (q, x) = (sign * q, sign * x);
            let deepest = -q - self.half_backlash + self.slack;
            if deepest <= 0.0 {
                continue;
            }
            // the mesh repeats with every base pitch
            let turns = libm::round(x / self.base_pitch);
            let x = x - turns * self.base_pitch;
            let (tq, tx) = (variable(q, 0, sign), variable(x, 1, sign));
            let placement = &self.placements[which[0]][which[1]][usize::from(flank == Flank::Coast)];
            self.candidates.near(placement.between(q, x), deepest, |k, rays| {
                let near = FlankPair {
                    rays,
                    flank,
                    placement,
                    number: (-turns as i64).saturating_add(i64::from(k)),
                    s: self.centred + x + f64::from(k) * self.base_pitch,
                    q,
                    x,
                    k,
                };
                let poses = placement.poses(tq, tx, k);
                for slice in slices {
                    if let Some(depth) = self.section(&near, slice).depth(&poses, &self.soft) {
                        visit(&near, slice, depth);
                    }
                }
            });
        }
    }

    pub(super) fn section<'a>(&'a self, near: &FlankPair, slice: &SolidSlice) -> FlankSection<'a> {
        let [planet, side] = &self.flanks.rays;
        FlankSection {
            rays: [&planet[near.rays[0].clone()], &side[near.rays[1].clone()]],
            tips: [&planet[0], &side[side.len() - 1]],
            relief: slice.relief / slice.cone,
            offset: near.placement.offset().map(|w| w / slice.cone),
        }
    }

    /// Force of a section that overlaps by `depth` [rad], as if the whole face were in its state.
    pub(super) fn respond(&self, depth: f64, rate: f64) -> Force {
        let d = self.cone * depth;
        let elastic = self.elastic.force(d, 0.0);
        self.damping.apply(elastic.elastic, elastic.by_depth, d, self.cone * rate)
    }

    /// Forces and heat of the mesh of planet and side `state.which`.
    pub fn force(&self, state: &MeshState) -> MeshForce {
        let mut sum = MeshForce::default();
        let [dq, dx] = state.rate;
        self.sections(&self.slices, state.which, state.position, slope, |_, slice, p: Dual<2>| {
            if p.v > 0.0 {
                let rate = p.d[0] * dq + p.d[1] * dx;
                let force = self.respond(p.v, rate);
                let torque = slice.share * self.cone * force.total;
                sum.force[0] -= torque * p.d[0];
                sum.force[1] -= torque * p.d[1];
                sum.heat += slice.share * (force.total - force.elastic) * self.cone * rate;
            }
        });
        sum
    }

    /// Forces, heat and their exact derivatives.
    pub fn linearise(&self, state: &MeshState) -> (MeshForce, MeshJacobian) {
        let (mut sum, mut by) = (MeshForce::default(), MeshJacobian::default());
        let [dq, dx] = state.rate;
        self.sections(&self.slices, state.which, state.position, curve, |_, slice, p: Curved| {
            if p.v <= 0.0 {
                return;
            }
            let rate = p.d[0] * dq + p.d[1] * dx;
            let f = self.respond(p.v, rate);
            let r = self.cone;
            let torque = slice.share * r * f.total;
            sum.heat += slice.share * (f.total - f.elastic) * r * rate;
            let hessian = [[p.dd[0], p.dd[1]], [p.dd[1], p.dd[2]]];
            for b in 0..2 {
                sum.force[b] -= torque * p.d[b];
                let along = f.by_depth * p.d[b] + f.by_rate * (hessian[b][0] * dq + hessian[b][1] * dx);
                for a in 0..2 {
                    by.by_position[a][b] -= slice.share * r * (r * along * p.d[a] + f.total * hessian[a][b]);
                    by.by_rate[a][b] -= slice.share * r * r * f.by_rate * p.d[a] * p.d[b];
                }
            }
        });
        (sum, by)
    }

    /// Elastic energy V [J] of the mesh `which` at position (q, x).
    pub fn energy(&self, which: [usize; 2], position: [f64; 2]) -> f64 {
        let mut energy = 0.0;
        self.sections(
            &self.slices,
            which,
            position,
            |v, _, _| v,
            |_, slice, p: f64| {
                if p > 0.0 {
                    energy += slice.share * self.elastic.energy(self.cone * p);
                }
            },
        );
        energy
    }
}

/// A pair of flanks near each other, in the mirror image in which it is a drive flank.
pub(super) struct FlankPair<'a> {
    pub(super) flank: Flank,
    pub(super) placement: &'a Placement,
    /// Rays of planet and side gear.
    pub(super) rays: [RangeInclusive<usize>; 2],
    pub(super) number: i64,
    pub(super) s: f64,
    pub(super) q: f64,
    pub(super) x: f64,
    pub(super) k: i32,
}

/// Variable `i` with its slope.
pub(super) fn slope(v: f64, i: usize, slope: f64) -> Dual<2> {
    let mut dual = Dual { v, d: [0.0; 2] };
    dual.d[i] = slope;
    dual
}

/// Variable `i` with its slope and no curvature.
fn curve(v: f64, i: usize, slope: f64) -> Curved {
    let mut curved = Curved::constant(v);
    curved.d[i] = slope;
    curved
}

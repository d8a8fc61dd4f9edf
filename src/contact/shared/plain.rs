//! Error-free meshes of a planet on shared gear bodies: forces, Jacobian, energy and heat.
//!
//! One point represents the load of a face whose flanks fit, and the side gears stay on their axes.

use super::{COORDINATES, Change, OpeningByOthers, Pairs, Share, Sharing};
use crate::contact::bodies::{LoadedPair, PairCouplings};
use crate::contact::detailed::PairName;
use crate::contact::impact::Force;
use crate::contact::mesh::{MeshForce, MeshState};
use crate::contact::spring::Response;
use crate::contact::{Flank, Mesh, Spring, ToothPair};

/// Both meshes of a planet.
pub struct SharedMeshes<'a> {
    /// The mesh, identical on both sides.
    pub mesh: &'a Mesh,
    /// Couplings through the bodies.
    pub bodies: &'a PairCouplings,
    /// Number of the planet tooth whose position in the right mesh corresponds to the position of tooth 0 in the left
    /// mesh.
    pub opposite: i64,
    /// Number of pairs by which the planet's position was wrapped, positive in the direction of x of each mesh.
    pub wrapped: [i64; 2],
}

/// Forces on the meshes and their derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub struct SharedForce {
    /// Forces and heat, left and right.
    pub force: [MeshForce; 2],
    /// ∂(force of a side)/∂(q, x of a side), indexed by side, side, row, column.
    pub by_position: [[[[f64; 2]; 2]; 2]; 2],
    /// ∂force/∂(rates of the same mesh).
    pub by_rate: [[[f64; 2]; 2]; 2],
    /// Elastic energy [J].
    pub energy: f64,
}

/// A pair that may be loaded.
#[derive(Clone, Copy)]
struct Near<P> {
    pair: ToothPair,
    loaded: LoadedPair,
    local: P,
}

/// Callback for each pair, with the approach of its flanks [rad] and its share of the load.
type See<'a, P> = dyn FnMut(&Near<P>, f64, &Share) + 'a;

impl SharedMeshes<'_> {
    /// Number of the planet tooth of a pair.
    #[inline(always)]
    fn tooth(&self, side: usize, flank: Flank, number: i64) -> i64 {
        let PairName { tooth, .. } = PairName::new((0, side), flank, number, self.wrapped[side]);
        if side == 0 { tooth } else { self.opposite.wrapping_sub(tooth) }
    }

    /// Gathers the pairs that are pressed, that others may pull into contact, or that are within `lookout` times the
    /// deepest approach of touching.
    #[inline(always)]
    fn gather<S: Spring>(&self, spring: &S, states: &[MeshState; 2], lookout: f64, pairs: &mut Pairs<Near<S::Local>>) {
        let half = self.mesh.half_backlash();
        // approaches of drive and coast flanks, left and right
        let depth = states.each_ref().map(|state| [-state.position[0] - half, state.position[0] - half]);
        let deepest = depth.as_flattened().iter().fold(0.0f64, |deepest, depth| deepest.max(*depth));
        for side in 0..2 {
            for (i, flank) in [Flank::Drive, Flank::Coast].into_iter().enumerate() {
                let margin = self.bodies.pull.margin(&depth, side, i) + lookout * deepest;
                let approach = depth[side][i] + margin;
                if approach <= 0.0 {
                    continue;
                }
                self.mesh.engagement.near(flank, states[side].position[1], approach, margin, |pair| {
                    if pair.depth + margin <= 0.0 {
                        return;
                    }
                    pairs.add(pair.depth, || {
                        let tooth = self.tooth(side, flank, pair.number);
                        let loaded = LoadedPair { side, flank, number: pair.number, tooth, s: pair.s };
                        Near { pair: *pair, loaded, local: spring.local(pair.s) }
                    });
                });
            }
        }
    }

    /// Response of a pair at its own arc `own` [rad] and the rate `rate` [m/s] of the whole approach.
    #[inline(always)]
    fn respond<S: Spring>(&self, spring: &S, near: &Near<S::Local>, own: f64, rate: f64) -> Response {
        let Mesh { whole, damping, .. } = self.mesh;
        spring.respond_whole::<true>(&near.local, (whole, damping), whole.cone * own, rate)
    }

    /// Calls `see` with each pair that may be loaded and its share of the load. With `SLOPES`, the share includes its
    /// slopes.
    fn share<S: Spring, const SLOPES: bool>(
        &self,
        spring: &S,
        states: &[MeshState; 2],
        lookout: f64,
        see: &mut See<S::Local>,
    ) {
        let mut pairs = Pairs::none();
        self.gather(spring, states, lookout, &mut pairs);
        let near_of = |k: usize| pairs.get(k);
        let load = |k: usize, arc: f64| {
            let (Some(near), false) = (near_of(k), arc <= 0.0) else { return [0.0; 2] };
            let elastic = spring.respond(&near.local, arc);
            [elastic.torque, elastic.stiffness]
        };
        let changes = |k: usize, own: f64| {
            let (mut by, mut change) = ([0.0; COORDINATES], Change::default());
            if let Some(near) = near_of(k) {
                let (pair, at) = (&near.pair, 3 * near.loaded.side);
                (by[at], by[at + 1]) = (pair.slope[0], pair.slope[1]);
                let by_s = if own > 0.0 { spring.respond(&near.local, own).torque_by_s } else { 0.0 };
                change.position = (at + 1, pair.s_slope, by_s * pair.s_slope);
            }
            (by, change)
        };
        let loaded_pair = |k: usize| near_of(k).map(|near| &near.loaded);
        let sharing = Sharing {
            bodies: self.bodies,
            arcs: pairs.arcs(),
            loaded_pair: &loaded_pair,
            law: &load,
            is_linear: S::LINEAR,
        };
        sharing.solve(if SLOPES { Some(&changes) } else { None }, &mut |k, share| {
            if let Some(near) = near_of(k) {
                see(near, pairs.arcs()[k], share);
            }
        });
    }

    /// Calls [`Self::share`], but skips unloaded pairs.
    fn for_each_loaded<S: Spring, const SLOPES: bool>(
        &self,
        spring: &S,
        states: &[MeshState; 2],
        mut see: impl FnMut(&Near<S::Local>, f64, &Share),
    ) {
        self.share::<S, SLOPES>(spring, states, 0.0, &mut |near, arc, share| {
            if share.own > 0.0 {
                see(near, arc, share);
            }
        });
    }

    /// Forces and heat of both meshes.
    pub fn force<S: Spring>(&self, spring: &S, states: &[MeshState; 2]) -> [MeshForce; 2] {
        let mut sum = [MeshForce::default(); 2];
        self.for_each_loaded::<S, false>(spring, states, |near, _, share| {
            let side = near.loaded.side;
            self.add(spring, &mut sum[side], near, &states[side], share);
        });
        sum
    }

    /// Adds the force of a pair and its heat; returns its response.
    #[inline(always)]
    fn add<S: Spring>(
        &self,
        spring: &S,
        to: &mut MeshForce,
        near: &Near<S::Local>,
        state: &MeshState,
        share: &Share,
    ) -> Response {
        let (pair, rate) = (&near.pair, self.mesh.rate(&near.pair, state));
        let response = self.respond(spring, near, share.own, rate);
        let torque = self.mesh.whole.cone * response.force.total;
        to.force[0] -= torque * pair.slope[0];
        to.force[1] -=
            torque * pair.slope[1] + (response.by_s - self.mesh.whole.moment * share.load * share.along) * pair.s_slope;
        to.heat += (response.force.total - response.force.elastic) * rate;
        response
    }

    /// Forces and heat of both meshes with their derivatives, and the elastic energy.
    pub fn linearise<S: Spring>(&self, spring: &S, states: &[MeshState; 2]) -> SharedForce {
        let mut sum = SharedForce::default();
        self.for_each_loaded::<S, true>(spring, states, |near, arc, share| {
            self.add_linearised(spring, &mut sum, near, (states, arc), share);
        });
        sum
    }

    /// Adds a pair with its derivatives.
    #[inline(always)]
    fn add_linearised<S: Spring>(
        &self,
        spring: &S,
        sum: &mut SharedForce,
        near: &Near<S::Local>,
        (states, arc): (&[MeshState; 2], f64),
        share: &Share,
    ) {
        let Some([own_by, along_by]) = share.slopes else { return };
        let (moment, r) = (self.mesh.whole.moment, self.mesh.whole.cone);
        let (pair, side) = (&near.pair, near.loaded.side);
        let state = &states[side];
        let response = self.add(spring, &mut sum.force[side], near, state, share);
        let f = &response.force;
        sum.energy += response.energy + 0.5 * moment * share.load * (arc - share.own);
        let [qq, xx] = pair.curvature;
        let turn = [qq * (state.rate[0] + state.rate[1]), qq * state.rate[0] + xx * state.rate[1]];
        let hessian = [[qq, qq], [qq, xx]];
        for other in 0..2 {
            for b in 0..2 {
                let z = 3 * other + b;
                let here = other == side;
                // derivatives through the own arc, the position on the path, and the rate at constant speeds
                let mut torque = r * r * f.by_depth * own_by[z];
                let mut along = r * response.elastic_by_s * own_by[z] - moment * along_by[z];
                if here {
                    torque += r * r * f.by_rate * turn[b];
                    if b == 1 {
                        torque += r * response.total_by_s * pair.s_slope;
                        along += response.by_s_twice * pair.s_slope;
                    }
                }
                let to = &mut sum.by_position[side][other];
                for a in 0..2 {
                    to[a][b] -= torque * pair.slope[a];
                    if here {
                        to[a][b] -= r * f.total * hessian[a][b];
                    }
                }
                to[1][b] -= along * pair.s_slope;
            }
        }
        for a in 0..2 {
            for b in 0..2 {
                sum.by_rate[side][a][b] -= r * r * f.by_rate * pair.slope[a] * pair.slope[b];
            }
        }
    }

    /// Elastic energy of both meshes [J].
    pub fn energy<S: Spring>(&self, spring: &S, states: &[MeshState; 2]) -> f64 {
        let mut sum = 0.0;
        self.for_each_loaded::<S, false>(spring, states, |near, arc, share| {
            let alone = spring.respond(&near.local, share.own).energy;
            sum += self.mesh.whole.moment * (alone + 0.5 * share.load * (arc - share.own));
        });
        sum
    }

    /// Displacements that other pairs cause at pairs that touch or are about to touch.
    pub fn opening_by_others<S: Spring>(&self, spring: &S, states: &[MeshState; 2]) -> OpeningByOthers {
        let mut opening_by_others = OpeningByOthers::default();
        self.share::<S, false>(spring, states, OpeningByOthers::LOOKOUT, &mut |near, arc, share| {
            let Near { pair, loaded, .. } = near;
            opening_by_others.add(loaded.side, pair.flank, pair.number, arc - share.own);
        });
        opening_by_others
    }

    /// Calls `visit` with each loaded pair of the mesh with side gear `side` and its force. The depth of the pair is
    /// its own arc.
    pub fn loaded<S: Spring>(
        &self,
        spring: &S,
        states: &[MeshState; 2],
        side: usize,
        visit: &mut dyn FnMut(&ToothPair, &Force),
    ) {
        self.for_each_loaded::<S, false>(spring, states, |near, _, share| {
            if near.loaded.side == side {
                let pair = ToothPair { depth: share.own, ..near.pair };
                let rate = self.mesh.rate(&pair, &states[side]);
                visit(&pair, &self.respond(spring, near, share.own, rate).force);
            }
        });
    }
}

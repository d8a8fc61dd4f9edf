//! Error-free meshes of a planet that share bodies: forces, Jacobian, energy and heat.
//!
//! Sums that steps ask for are compiled for each number of pairs, as they are short, and once for each law.

use super::couplings::{MOST_PAIRS, place_for};
use super::{Change, CouplingCurvatures, Couplings, Gradients, OpeningByOthers, OwnArcs};
use crate::contact::bodies::{PairCouplings, PairPlace};
use crate::contact::impact::Force;
use crate::contact::law::FaceLaw;
use crate::contact::mesh::{MeshForce, MeshState};
use crate::contact::{Flank, Mesh, Spring, ToothPair};

/// Both meshes of a planet.
pub struct SharedMeshes<'a> {
    /// The mesh, alike on both sides.
    pub mesh: &'a Mesh,
    /// The bodies.
    pub bodies: &'a PairCouplings,
    /// Number of the planet's tooth that stands at the right mesh's line as tooth 0 does at the left one's.
    pub opposite: i64,
    /// Pairs by which the planet's position was wrapped, in the sense of x of each mesh.
    pub wrapped: [i64; 2],
}

/// Forces on the meshes and their derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub struct SharedForce {
    /// Forces and heat, left and right.
    pub force: [MeshForce; 2],
    /// ∂(force of a side)/∂(q, x of a side): side, side, row, column.
    pub by_position: [[[[f64; 2]; 2]; 2]; 2],
    /// ∂force/∂(rates) of each side's own.
    pub by_rate: [[[f64; 2]; 2]; 2],
    /// Elastic energy [J].
    pub energy: f64,
}

/// Coordinates of both meshes: q, x left and right.
const COORDINATES: usize = 4;

/// A pair that may carry.
#[derive(Clone, Copy)]
struct Near<P> {
    pair: ToothPair,
    pair_place: PairPlace,
    place: P,
}

/// `K` of them with their own arcs.
struct Sharing<'a, P, const K: usize> {
    near: &'a [Option<Near<P>>; MOST_PAIRS],
    arc: [f64; K],
    couplings: Couplings<K>,
    own: OwnArcs<K>,
}

/// Evaluates an expression with `K` set to the number of pairs.
macro_rules! by_count {
    ($count:expr, $none:expr, $body:expr) => {
        match $count {
            0 => $none,
            1 => by_count!(@ 1, $body),
            2 => by_count!(@ 2, $body),
            3 => by_count!(@ 3, $body),
            4 => by_count!(@ 4, $body),
            _ => by_count!(@ MOST_PAIRS, $body),
        }
    };
    (@ $k:expr, $body:expr) => {{
        const K: usize = $k;
        $body
    }};
}

impl<'a, P: Copy, const K: usize> Sharing<'a, P, K> {
    #[inline(always)]
    fn new<S: Spring<Place = P>>(
        bodies: &PairCouplings,
        law: &FaceLaw<S>,
        near: &'a [Option<Near<P>>; MOST_PAIRS],
        count: usize,
    ) -> Self {
        let couplings = Couplings::new(bodies, if K < MOST_PAIRS { K } else { count }, Self::pair_places(near));
        Self::of(law, near, couplings)
    }

    /// The same with second derivatives of the couplings.
    #[inline(always)]
    fn with_curvatures<S: Spring<Place = P>>(
        bodies: &PairCouplings,
        law: &FaceLaw<S>,
        near: &'a [Option<Near<P>>; MOST_PAIRS],
        count: usize,
    ) -> (Self, CouplingCurvatures<K>) {
        let (couplings, curvatures) =
            Couplings::with_curvatures(bodies, if K < MOST_PAIRS { K } else { count }, Self::pair_places(near));
        (Self::of(law, near, couplings), curvatures)
    }

    #[inline(always)]
    fn pair_places(near: &'a [Option<Near<P>>; MOST_PAIRS]) -> impl Fn(usize) -> Option<&'a PairPlace> {
        |k| near[k].as_ref().map(|near| &near.pair_place)
    }

    #[inline(always)]
    fn of<S: Spring<Place = P>>(
        law: &FaceLaw<S>,
        near: &'a [Option<Near<P>>; MOST_PAIRS],
        couplings: Couplings<K>,
    ) -> Self {
        let arc = std::array::from_fn(|k| near[k].as_ref().map_or(0.0, |near| near.pair.depth));
        let law = |k: usize, arc: f64| {
            let (Some(near), false) = (&near[k], arc <= 0.0) else { return [0.0; 2] };
            let elastic = law.specific.respond(&near.place, arc);
            [elastic.torque, elastic.stiffness]
        };
        let own = if S::LINEAR { OwnArcs::linear(&couplings, &arc, law) } else { OwnArcs::new(&couplings, &arc, law) };
        Self { near, arc, couplings, own }
    }
}

/// How pairs share the load.
struct Shares<'a, P> {
    near: &'a [Option<Near<P>>],
    arc: &'a [f64],
    own: &'a [f64],
    load: &'a [f64],
    along: &'a [f64],
}

/// What a pair has of it.
struct Share<'a, P> {
    near: &'a Near<P>,
    /// Arc by which its flanks approach [rad].
    arc: f64,
    /// Own arc [rad].
    own: f64,
    /// Load ω_k.
    load: f64,
    /// τ_k = Σ_l ∂t_kl/∂s_k ω_l.
    along: f64,
}

impl<'a, P> Shares<'a, P> {
    /// All pairs.
    #[inline(always)]
    fn all(&self) -> impl Iterator<Item = Share<'a, P>> {
        let values = self.arc.iter().zip(self.own).zip(self.load.iter().zip(self.along));
        self.near.iter().zip(values).filter_map(|(near, ((&arc, &own), (&load, &along)))| {
            near.as_ref().map(|near| Share { near, arc, own, load, along })
        })
    }

    /// Pairs that carry.
    #[inline(always)]
    fn loaded(&self) -> impl Iterator<Item = Share<'a, P>> {
        self.all().filter(|share| share.own > 0.0)
    }
}

impl SharedMeshes<'_> {
    /// Number of the planet's tooth of a pair.
    #[inline(always)]
    fn tooth(&self, side: usize, flank: Flank, number: i64) -> i64 {
        let wrapped = self.wrapped[side];
        let tooth = if flank == Flank::Drive {
            number.wrapping_sub(wrapped)
        } else {
            number.wrapping_add(wrapped).wrapping_neg()
        };
        if side == 0 { tooth } else { self.opposite.wrapping_sub(tooth) }
    }

    /// Calls `visit` with each pair that is pressed, or that others may pull together: those within `lookout` of the deepest
    /// approach of flanks too.
    #[inline(always)]
    fn pairs<S: Spring>(
        &self,
        law: &FaceLaw<S>,
        states: &[MeshState; 2],
        lookout: f64,
        near: &mut [Option<Near<S::Place>>; MOST_PAIRS],
    ) -> usize {
        let half = self.mesh.half_backlash();
        // approaches of drive and coast flanks, left and right
        let depth = states.each_ref().map(|state| [-state.position[0] - half, state.position[0] - half]);
        let deepest = depth.as_flattened().iter().fold(0.0f64, |deepest, depth| deepest.max(*depth));
        let mut count = 0;
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
                    let depth_of = |k: usize| near[k].as_ref().map_or(0.0, |near: &Near<S::Place>| near.pair.depth);
                    if let Some(place) = place_for(pair.depth, &mut count, depth_of) {
                        let tooth = self.tooth(side, flank, pair.number);
                        let pair_place = PairPlace { side, flank, number: pair.number, tooth, s: pair.s };
                        near[place] = Some(Near { pair: *pair, pair_place, place: law.specific.place(pair.s) });
                    }
                });
            }
        }
        count
    }

    /// Rate ḋ of a pair [m/s].
    #[inline(always)]
    fn rate(&self, pair: &ToothPair, state: &MeshState) -> f64 {
        self.mesh.cone * (pair.slope[0] * state.rate[0] + pair.slope[1] * state.rate[1])
    }

    /// Calls `see` with how the pairs share the load: compiled for each number of pairs and each law, which is why all that needs
    /// no derivatives asks here.
    #[inline(never)]
    fn share<S: Spring>(
        &self,
        law: &FaceLaw<S>,
        states: &[MeshState; 2],
        lookout: f64,
        see: &mut dyn FnMut(Shares<S::Place>),
    ) {
        let mut near = std::array::from_fn(|_| None);
        let count = self.pairs(law, states, lookout, &mut near);
        by_count!(count, (), {
            let Sharing { near, arc, couplings, own } = Sharing::<_, K>::new::<S>(self.bodies, law, &near, count);
            let along = couplings.times(&couplings.by_own, &own.load);
            see(Shares { near, arc: &arc, own: &own.arc, load: &own.load, along: &along });
        });
    }

    /// Forces and heat of both meshes.
    pub fn force<S: Spring>(&self, law: &FaceLaw<S>, states: &[MeshState; 2]) -> [MeshForce; 2] {
        let mut sum = [MeshForce::default(); 2];
        self.share(law, states, 0.0, &mut |shares| {
            for Share { near, own, load, along, .. } in shares.loaded() {
                let (pair, side) = (&near.pair, near.pair_place.side);
                let rate = self.rate(pair, &states[side]);
                let response = law.respond_at(&near.place, self.mesh.cone * own, rate);
                let torque = self.mesh.cone * response.force.total;
                sum[side].force[0] -= torque * pair.slope[0];
                sum[side].force[1] -=
                    torque * pair.slope[1] + (response.by_place - law.moment * load * along) * pair.s_slope;
                sum[side].heat += (response.force.total - response.force.elastic) * rate;
            }
        });
        sum
    }

    /// The same with their derivatives and the elastic energy.
    #[inline(never)]
    pub fn linearise<S: Spring>(&self, law: &FaceLaw<S>, states: &[MeshState; 2]) -> SharedForce {
        let mut near = std::array::from_fn(|_| None);
        let count = self.pairs(law, states, 0.0, &mut near);
        by_count!(count, SharedForce::default(), {
            let (sharing, curvatures) = Sharing::<_, K>::with_curvatures::<S>(self.bodies, law, &near, count);
            self.linearise_pairs(law, states, &sharing, &curvatures)
        })
    }

    #[inline(always)]
    fn linearise_pairs<S: Spring, const K: usize>(
        &self,
        law: &FaceLaw<S>,
        states: &[MeshState; 2],
        sharing: &Sharing<S::Place, K>,
        curvatures: &CouplingCurvatures<K>,
    ) -> SharedForce {
        let (moment, r) = (law.moment, self.mesh.cone);
        let Sharing { couplings, own, .. } = sharing;
        let along = couplings.times(&couplings.by_own, &own.load);
        let (mut arc, mut changes) = ([[0.0; COORDINATES]; K], [Change::default(); K]);
        for k in 0..couplings.count {
            let Some(near) = &sharing.near[k] else { continue };
            let (pair, x) = (&near.pair, 2 * near.pair_place.side + 1);
            (arc[k][x - 1], arc[k][x]) = (pair.slope[0], pair.slope[1]);
            changes[k].place = (x, pair.s_slope, 0.0);
            if own.load[k] > 0.0 {
                changes[k].place.2 = law.specific.respond(&near.place, own.arc[k]).torque_by_place * pair.s_slope;
            }
        }
        let gradients = Gradients::new((couplings, curvatures), own, &along, arc, &changes);
        let mut sum = SharedForce::default();
        for k in 0..K {
            let (Some(near), true) = (&sharing.near[k], own.arc[k] > 0.0) else { continue };
            let (pair, side) = (&near.pair, near.pair_place.side);
            let state = &states[side];
            let rate = self.rate(pair, state);
            let response = law.respond_at(&near.place, r * own.arc[k], rate);
            let f = &response.force;
            let to = &mut sum.force[side];
            to.force[0] -= r * f.total * pair.slope[0];
            to.force[1] -=
                r * f.total * pair.slope[1] + (response.by_place - moment * own.load[k] * along[k]) * pair.s_slope;
            to.heat += (f.total - f.elastic) * rate;
            sum.energy += response.energy + 0.5 * moment * own.load[k] * (sharing.arc[k] - own.arc[k]);
            let own_by = &gradients.own[k];
            let [qq, xx] = pair.curvature;
            let turn = [qq * (state.rate[0] + state.rate[1]), qq * state.rate[0] + xx * state.rate[1]];
            let hessian = [[qq, qq], [qq, xx]];
            for other in 0..2 {
                for b in 0..2 {
                    let z = 2 * other + b;
                    let here = other == side;
                    // by the own arc, by the place and by the rate at constant speeds
                    let mut torque = r * r * f.by_depth * own_by[z];
                    let mut along = r * response.elastic_by_place * own_by[z] - moment * gradients.along[k][z];
                    if here {
                        torque += r * r * f.by_rate * turn[b];
                        if b == 1 {
                            torque += r * response.total_by_place * pair.s_slope;
                            along += response.by_place_twice * pair.s_slope;
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
        sum
    }

    /// Elastic energy of both meshes [J].
    pub fn energy<S: Spring>(&self, law: &FaceLaw<S>, states: &[MeshState; 2]) -> f64 {
        let mut sum = 0.0;
        self.share(law, states, 0.0, &mut |shares| {
            let energy = |Share { near, arc, own, load, .. }: Share<S::Place>| {
                let alone = law.specific.respond(&near.place, own).energy;
                law.moment * (alone + 0.5 * load * (arc - own))
            };
            sum = shares.loaded().map(energy).sum();
        });
        sum
    }

    /// By how much pairs that touch or are about to are moved by others.
    pub fn opening_by_others<S: Spring>(&self, law: &FaceLaw<S>, states: &[MeshState; 2]) -> OpeningByOthers {
        let mut opening_by_others = OpeningByOthers::default();
        self.share(law, states, OpeningByOthers::LOOKOUT, &mut |shares| {
            for Share { near: Near { pair, pair_place, .. }, arc, own, .. } in shares.all() {
                opening_by_others.add(pair_place.side, pair.flank, pair.number, arc - own);
            }
        });
        opening_by_others
    }

    /// Calls `visit` with each loaded pair of the mesh with side gear `side`, its depth that of its own arc, and its force.
    pub fn loaded<S: Spring>(
        &self,
        law: &FaceLaw<S>,
        states: &[MeshState; 2],
        side: usize,
        visit: &mut dyn FnMut(&ToothPair, &Force),
    ) {
        self.share(law, states, 0.0, &mut |shares| {
            for Share { near, own, .. } in shares.loaded().filter(|share| share.near.pair_place.side == side) {
                let pair = ToothPair { depth: own, ..near.pair };
                let rate = self.rate(&pair, &states[side]);
                visit(&pair, &law.respond_at(&near.place, self.mesh.cone * pair.depth, rate).force);
            }
        });
    }
}

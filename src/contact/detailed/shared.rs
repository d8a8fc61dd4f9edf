//! Both meshes of a planet in detail, where their gears have elastic bodies (`contact::shared`).
//!
//! The own arc of a pair takes the place of its arc in every slice: bodies move a tooth as a whole. Loads of others follow from
//! the elastic torque over the face, ω = M/J.

use super::super::bodies::{PairCouplings, PairPlace};
use super::super::shared::{Change, Couplings, Gradients, MOST_PAIRS, OpeningByOthers, OwnArcs, place_for};
use super::directions::Arcs;
use super::face::{Cut, Part};
use super::loads::Look;
use super::sums::{Approach, Sums};
use super::touching::Touching;
use super::{
    Detailed, DetailedLoad, DetailedState, MeshTeeth, Opening, PairMotion, PairName, SliceLoad, Totals, WITH_OTHER,
};
use crate::contact::{AnySpring, Damping, Flank, Spring, ToothPair};
use crate::numeric::Dual;

/// Evaluates an expression with `law` bound to the law of teeth in use, or another one: bodies are elastic under no other law.
macro_rules! with_teeth {
    ($of:expr, $law:ident => $body:expr, $none:expr) => {
        match $of {
            AnySpring::Line($law) => $body,
            AnySpring::LineWeber($law) => $body,
            _ => $none,
        }
    };
}

/// Coordinates of both meshes: q, x, w left and right.
const COORDINATES: usize = 6;

/// Teeth of both meshes of a planet on bodies that they share.
#[derive(Clone, Copy)]
pub struct SharedTeeth<'a> {
    /// Teeth, left and right.
    pub teeth: [MeshTeeth<'a>; 2],
    /// The bodies.
    pub bodies: &'a PairCouplings,
    /// Number of the planet's tooth of a pair, of the unrolled sequence.
    pub numbers: &'a dyn Fn(PairName) -> i64,
}

/// A pair that may touch.
#[derive(Clone, Copy)]
struct Near {
    side: usize,
    name: PairName,
    pair: ToothPair,
    opening: Opening,
    axial: [f64; 2],
    arcs: Arcs,
    pair_place: PairPlace,
}

/// All of them, and what they share.
struct Shared {
    near: [Option<Near>; MOST_PAIRS],
    arc: [f64; MOST_PAIRS],
    couplings: Couplings<MOST_PAIRS>,
    own: OwnArcs<MOST_PAIRS>,
}

impl Shared {
    /// No pairs.
    #[inline(always)]
    fn none() -> Self {
        Self {
            near: std::array::from_fn(|_| None),
            arc: [0.0; MOST_PAIRS],
            couplings: Couplings::NONE,
            own: OwnArcs::NONE,
        }
    }
}

/// How the bodies see pairs.
fn pair_places_of<'a>(near: &'a [Option<Near>; MOST_PAIRS]) -> impl Fn(usize) -> Option<&'a PairPlace> {
    |k| near[k].as_ref().map(|near| &near.pair_place)
}

/// What the elastic part of a face carries at an own arc, over J.
#[derive(Clone, Copy, Default)]
struct Carried {
    load: f64,
    by_arc: f64,
    by_opening: f64,
    by_place: f64,
    energy: f64,
}

impl Detailed {
    /// What the elastic part of a pair carries.
    #[inline(always)]
    fn carried<S: Spring>(&self, spring: &S, near: &Near, arc: f64) -> Carried {
        let place = spring.place(near.pair.s);
        let (opening, mut sums) = (&near.opening, Sums::default());
        let still = Approach { arc, rate: 0.0, opening_rate: 0.0 };
        for part in self.face.loaded(arc, opening, &mut Cut::default()) {
            sums.add::<S, true, true>(&part, (spring, &place, &Damping::NONE), &still, opening, None, |_| {});
        }
        let [by_arc, by_opening, by_place, ..] = sums.by[0].map(|by| by / self.moment);
        Carried { load: sums.torque / self.moment, by_arc, by_opening, by_place, energy: sums.energy / self.moment }
    }

    /// The pairs of both meshes that are pressed, that others may pull together, or that are within `lookout` of the deepest
    /// approach of flanks, with their own arcs, into `to`, which is large and not to be moved.
    fn shared<S: Spring>(
        &self,
        spring: &S,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        lookout: f64,
        to: &mut Shared,
    ) {
        // excess material presses before flanks that fit do
        let excess = [0, 1].map(|side| {
            let gaps = shared.teeth[side].gaps.map_or(0.0, |gaps| -gaps.least());
            (gaps + (-states[side].position[2]).max(0.0)) / self.face.inner()
        });
        let depth = [0, 1].map(|side| {
            let q = states[side].position[0];
            [-q, q].map(|q| q - shared.teeth[side].engagement.half_backlash() + excess[side])
        });
        let deepest = depth.as_flattened().iter().fold(0.0f64, |deepest, depth| deepest.max(*depth));
        let Shared { near, arc, couplings, own } = to;
        let mut count = 0;
        for side in 0..2 {
            let (teeth, state) = (&shared.teeth[side], &states[side]);
            let margin = [0, 1].map(|flank| shared.bodies.pull.margin(&depth, side, flank) + lookout * deepest);
            self.each(teeth, state, margin, |name, pair| {
                let margin = margin[usize::from(pair.flank == Flank::Coast)];
                let (opening, axial, arcs) = self.opened_pair(teeth, name, pair.s, state.position[2]);
                let mut cut = Cut::default();
                let parts = self.face.loaded(pair.depth + margin, &opening, &mut cut);
                if parts.iter().all(Part::is_empty) {
                    return;
                }
                if let Some(place) = place_for(pair.depth, &mut count, |k| arc[k]) {
                    let tooth = (shared.numbers)(*name);
                    let pair_place = PairPlace { side, flank: pair.flank, number: pair.number, tooth, s: pair.s };
                    near[place] = Some(Near { side, name: *name, pair: *pair, opening, axial, arcs, pair_place });
                    arc[place] = pair.depth;
                }
            });
        }
        couplings.fill(shared.bodies, count, pair_places_of(near));
        // flanks that excess material presses carry at arcs below 0, so that every arc is asked
        *own = OwnArcs::new(couplings, arc, |k, arc| {
            let carried = near[k].as_ref().map_or(Carried::default(), |near| self.carried(spring, near, arc));
            [carried.load, carried.by_arc]
        });
    }

    /// Loads of both meshes of a planet.
    pub fn load_shared(&self, shared: &SharedTeeth, states: &[DetailedState; 2]) -> [DetailedLoad<f64>; 2] {
        self.load_and_look_shared(shared, states, self.needs_thrust, None)
    }

    fn load_and_look_shared(
        &self,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        needs_thrust: bool,
        look: Look,
    ) -> [DetailedLoad<f64>; 2] {
        let mut totals = [Totals::<0, WITH_OTHER>::default(); 2];
        with_teeth!(&self.spring, spring => self.sum_shared(spring, &mut totals, shared, states, needs_thrust, look), ());
        totals.map(|totals| totals.load())
    }

    /// The same with their exact derivatives by q, x, w and their rates of the own mesh, and by q, x, w of the other.
    pub fn linearise_shared(
        &self,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
    ) -> [DetailedLoad<Dual<WITH_OTHER>>; 2] {
        let mut totals = [Totals::<7, WITH_OTHER>::default(); 2];
        with_teeth!(&self.spring, spring => self.sum_shared(spring, &mut totals, shared, states, self.needs_thrust, None), ());
        totals.map(|totals| totals.linearised())
    }

    /// Loads of both meshes; calls `look` with each loaded slice.
    pub fn look_shared(
        &self,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        look: &mut dyn FnMut(&SliceLoad),
    ) -> [DetailedLoad<f64>; 2] {
        self.load_and_look_shared(shared, states, true, Some(look))
    }

    /// Elastic energy of both meshes [J].
    pub fn energy_shared(&self, shared: &SharedTeeth, states: &[DetailedState; 2]) -> f64 {
        with_teeth!(&self.spring, spring => {
            let mut all = Shared::none();
            self.shared(spring, shared, states, 0.0, &mut all);
            let Shared { near, arc, own, .. } = &all;
            let energy = |(k, near): (usize, &Near)| {
                let alone = self.carried(spring, near, own.arc[k]).energy;
                self.moment * (alone + 0.5 * own.load[k] * (arc[k] - own.arc[k]))
            };
            near.iter().flatten().enumerate().map(energy).sum()
        }, 0.0)
    }

    /// By how much pairs that touch or are about to are moved by others.
    pub fn opening_by_others(&self, shared: &SharedTeeth, states: &[DetailedState; 2]) -> OpeningByOthers {
        let mut opening_by_others = OpeningByOthers::default();
        with_teeth!(&self.spring, spring => {
            let mut all = Shared::none();
            self.shared(spring, shared, states, OpeningByOthers::LOOKOUT, &mut all);
            let Shared { near, arc, own, .. } = &all;
            for (k, near) in near.iter().flatten().enumerate() {
                opening_by_others.add(near.side, near.pair.flank, near.pair.number, arc[k] - own.arc[k]);
            }
        }, ());
        opening_by_others
    }

    /// Adds the loads of all pairs.
    #[inline(always)]
    fn sum_shared<S: Spring, const ROWS: usize>(
        &self,
        spring: &S,
        totals: &mut [Totals<ROWS, WITH_OTHER>; 2],
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        needs_thrust: bool,
        mut look: Look,
    ) {
        let mut see = |slice: &SliceLoad| {
            if let Some(look) = &mut look {
                look(slice);
            }
        };
        let mut all = Shared::none();
        self.shared(spring, shared, states, 0.0, &mut all);
        let Shared { near, arc, couplings, own } = &all;
        let along = couplings.times(&couplings.by_own, &own.load);
        let gradients = (ROWS > 0).then(|| {
            let (_, curvatures) = Couplings::with_curvatures(shared.bodies, couplings.count, pair_places_of(near));
            let (mut by, mut changes) = ([[0.0; COORDINATES]; MOST_PAIRS], [Change::default(); MOST_PAIRS]);
            for (k, near) in near.iter().flatten().enumerate() {
                let (at, pair) = (3 * near.side, &near.pair);
                (by[k][at], by[k][at + 1]) = (pair.slope[0], pair.slope[1]);
                let carried = self.carried(spring, near, own.arc[k]);
                let by_place = carried.by_place + carried.by_opening * near.opening.even.d;
                changes[k] = Change {
                    place: (at + 1, pair.s_slope, by_place * pair.s_slope),
                    opening: (at + 2, carried.by_opening * near.axial[0]),
                };
            }
            Gradients::new((couplings, &curvatures), own, &along, by, &changes)
        });
        for (k, near) in near.iter().flatten().enumerate() {
            let (side, name) = (near.side, near.name);
            let pair = ToothPair { depth: own.arc[k], ..near.pair };
            let mut cut = Cut::default();
            let parts = self.face.loaded(pair.depth, &near.opening, &mut cut);
            if parts.iter().all(Part::is_empty) {
                continue;
            }
            let (mut motion, mut along_by) =
                (PairMotion::<true, true>::new(&pair, &near.opening, near.axial, &states[side]), [[0.0; 3]; 2]);
            if let Some(gradients) = &gradients {
                let of = |by: &[f64; COORDINATES]| {
                    [side, 1 - side].map(|side| [by[3 * side], by[3 * side + 1], by[3 * side + 2]])
                };
                motion.own = of(&gradients.own[k]);
                along_by = of(&gradients.along[k]).map(|by| by.map(|by| self.moment * pair.s_slope * by));
            }
            let force = self.moment * pair.s_slope * own.load[k] * along[k];
            let energy = 0.5 * self.moment * own.load[k] * (arc[k] - own.arc[k]);
            totals[side].add_moving(force, along_by, energy);
            let touching =
                Touching { name: &name, pair: &pair, opening: &near.opening, arcs: near.arcs, parts, motion };
            let teeth = &shared.teeth[side];
            self.add_touching((spring, teeth, needs_thrust), &mut totals[side], touching, &mut see);
        }
    }
}

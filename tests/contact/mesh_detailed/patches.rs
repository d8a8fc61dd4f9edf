//! A face of which a part carries: loads, deflections and derivatives against an own sum over 4000 slices of the same law, for
//! patches of every length, in the middle, at one end and over both ends.

use crate::random::Draws;
use bevel_differential::contact::detailed::{DetailedState, Gaps, Opening, PairName, SliceLoad};
use bevel_differential::contact::spring::Spring;
use bevel_differential::contact::tooth_friction::ToothFriction;
use bevel_differential::geometry::Pair;
use bevel_differential::numeric::Jet;
use fastrand::Rng;

use super::setup::{Both, carries_in_part, coulomb, difference, random_state, readings, smooth};
use crate::mesh_laws::{GEARS, Kind, RESTITUTION, STEP, UNDAMPED};

const KINDS: [Kind; 2] = [Kind::Line, Kind::LineWeber];
/// Slices of the own sum.
const SLICES: usize = 4000;

/// The same opening for every pair, at every place.
#[derive(Debug)]
struct Alike(Opening);

impl Gaps for Alike {
    fn opening(&self, _: &PairName, _: f64) -> Opening {
        self.0
    }
    fn least(&self) -> f64 {
        -2e-4
    }
}

/// Crowning of `crown` [m] at both ends of the face, an even gap [m], and a turn about the apex [rad].
fn crowned(pair: &Pair, crown: f64, even: f64, turn: f64, edge: Option<(f64, f64)>) -> Alike {
    let half = 0.5 * (pair.outer_cone - pair.inner_cone);
    let (bend, middle) = (crown / (half * half), pair.mean_cone);
    let level = even + bend * middle * middle;
    Alike(Opening { even: Jet { v: level, d: 0.0, dd: 0.0 }, turn: turn - 2.0 * bend * middle, bend, edge })
}

/// A state at rest at which one pair of drive flanks stands at the pitch point, `approach` [rad] deep.
fn at(both: &Both, approach: f64) -> DetailedState {
    let q = -(both.pair.normal_backlash / 2.0 + approach);
    DetailedState { position: [q, -both.pair.centred_position(), 0.0], rate: [0.0; 3], wrapped: 0 }
}

/// Places of the pairs that can touch.
fn places(both: &Both, approach: f64) -> Vec<(f64, f64)> {
    let mut pairs = Vec::new();
    let state = at(both, approach);
    let engagement = both.engagement();
    engagement.pairs([state.position[0], state.position[1]], |pair| pairs.push((pair.depth, pair.s)));
    pairs
}

/// ∫ω R² dR and ∫ω R dR over the face, by slices.
fn slices(both: &Both, opening: &Opening, approach: f64, s: f64) -> [f64; 2] {
    let [inner, outer] = both.detailed.face.ends().unwrap();
    let width = (outer - inner) / SLICES as f64;
    let mut sums = [0.0; 2];
    for j in 0..SLICES {
        let r = inner + (j as f64 + 0.5) * width;
        let missing = opening.edge.map_or(0.0, |(edge, depth)| if r > edge { depth } else { 0.0 });
        let arc = approach - (opening.even.v + missing) / r - opening.turn - opening.bend * r;
        if arc > 0.0 {
            let load = both.detailed.spring.at(arc, s).torque;
            sums[0] += load * r * r * width;
            sums[1] += load * r * width;
        }
    }
    sums
}

/// The openings looked at: crowning, misalignment of both signs, and both at once, which lift one end or both.
fn openings(pair: &Pair) -> Vec<(String, Alike)> {
    let mut all = Vec::new();
    for crown in [0.0, 1e-6, 5e-6, 20e-6, 48e-6, 100e-6, 300e-6] {
        for even in [-30e-6, 0.0, 40e-6] {
            for edge in [None, Some((pair.mean_cone + 2e-3, 1e-3)), Some((pair.mean_cone - 3e-3, 4e-6))] {
                let name = format!("crowning {crown:e}, gap {even:e}, edge {edge:?}");
                // the gap closes in the middle
                all.push((name, crowned(pair, crown, even, -even / pair.mean_cone, edge)));
            }
        }
    }
    all
}

#[test]
fn a_patch_of_any_length_carries_what_4000_slices_of_the_law_carry() {
    let (mut worst, mut compared, mut partial) = ([0.0f64; 2], 0, 0);
    for kind in KINDS {
        let both = Both::sliced(GEARS[0], kind, UNDAMPED, None);
        let pair = &both.pair;
        for (name, gaps) in openings(pair) {
            for approach in [3e-6, 2e-5, 1e-4, 5e-4, 1e-3, 2e-3, 4e-3] {
                let state = at(&both, approach);
                let load = both.load(Some(&gaps), &state);
                let mut own = [0.0; 2];
                for (depth, s) in places(&both, approach) {
                    let sums = slices(&both, &gaps.0, depth, s);
                    own = [own[0] + sums[0], own[1] + sums[1]];
                }
                if own[1] < 1e-3 {
                    assert!(load.normal < 2e-3, "{kind:?} {name} {approach:e}: {}", load.normal);
                    continue;
                }
                compared += 1;
                partial += usize::from(carries_in_part(&both, Some(&gaps), &state));
                let off = (load.normal / own[1] - 1.0).abs();
                worst[usize::from(kind == Kind::LineWeber)] = worst[usize::from(kind == Kind::LineWeber)].max(off);
                // what middles of slices are off by where the load ends within one
                assert!(off < 1e-3, "{kind:?} {name} {approach:e}: {} for {}", load.normal, own[1]);
            }
        }
    }
    println!("force within {worst:?} of `line`, `line_weber` in {compared} states, {partial} in part");
    assert!(compared > 500 && partial > 150, "{compared} {partial}");
}

#[test]
fn loads_from_5_to_835_newton_metres_deflect_crowned_teeth_as_4000_slices_say() {
    for kind in KINDS {
        let both = Both::sliced(GEARS[0], kind, UNDAMPED, None);
        let pair = &both.pair;
        let mut worst = [0.0f64; 2];
        for torque in [5.0, 20.0, 150.0, 400.0, 835.0] {
            // of one of two planets, about the pole of the plane of action
            let moment = torque / (2.0 * pair.sin_base()[1]);
            for crown in [0.0, 2e-6, 10e-6, 20e-6, 48e-6, 100e-6, 200e-6, 300e-6] {
                let gaps = crowned(pair, crown, 0.0, 0.0, None);
                let solve = |load: &dyn Fn(f64) -> f64| {
                    let (mut low, mut high) = (0.0, 0.03);
                    for _ in 0..80 {
                        let middle = 0.5 * (low + high);
                        if load(middle) < moment { low = middle } else { high = middle }
                    }
                    high
                };
                let program = solve(&|a| both.load(Some(&gaps), &at(&both, a)).force[0]);
                let own = |a: f64| places(&both, a).iter().map(|&(d, s)| slices(&both, &gaps.0, d, s)[0]).sum::<f64>();
                let slices = solve(&own);
                let force = both.load(Some(&gaps), &at(&both, slices)).force[0];
                worst = [worst[0].max((program / slices - 1.0).abs()), worst[1].max((force / moment - 1.0).abs())];
            }
        }
        println!("{kind:?}: deflection within {:.1e}, force {:.1e}", worst[0], worst[1]);
        assert!(worst.iter().all(|off| *off < 3e-4), "{kind:?} {worst:?}");
    }
}

/// Openings and states at random, of which a part of the face carries.
fn in_part(random: &mut Rng, both: &Both) -> Option<(Alike, DetailedState)> {
    let pair = &both.pair;
    let size = 10f64.powf(random.between(-6.0, -3.6));
    let even = size * random.between(-1.0, 1.0);
    let gaps = crowned(pair, size, even, -even / pair.mean_cone, None);
    let state = random_state(random, pair, 0.3 * size);
    carries_in_part(both, Some(&gaps), &state).then_some((gaps, state))
}

#[test]
fn forces_of_a_patch_are_the_gradient_of_its_energy() {
    for kind in KINDS {
        let (mut random, mut worst, mut compared) = (Rng::with_seed(71), 0.0f64, 0);
        for of in GEARS {
            let both = Both::sliced(of, kind, UNDAMPED, None);
            for _ in 0..3000 {
                let Some((gaps, mut state)) = in_part(&mut random, &both) else { continue };
                state.rate = [0.0; 3];
                let mut deepest = 0.0f64;
                let force = both.look(Some(&gaps), &state, |slice| deepest = deepest.max(slice.arc)).force;
                let h = [2e-3 * deepest, 2e-3 * deepest, 2e-3 * deepest * both.plain.cone];
                if !smooth(&both, Some(&gaps), &state, &h) {
                    continue;
                }
                for axis in 0..3 {
                    let unit = if axis == 2 { both.plain.cone } else { 1.0 };
                    let gradient = difference(&state, axis, h[axis], |s| both.energy(Some(&gaps), s));
                    let off = (force[axis] + gradient).abs() * unit / force[0].abs();
                    worst = worst.max(off);
                    assert!(off < 3e-8, "{kind:?} {gaps:?} {state:?} axis {axis}: {} {gradient}", force[axis]);
                }
                compared += 1;
            }
        }
        println!("{kind:?}: worst {worst:e} of the force in {compared} states");
        assert!(compared > 1000, "{compared}");
    }
}

#[test]
fn derivatives_of_a_patch_contain_how_its_ends_move() {
    let cases: [(_, Option<ToothFriction>); 3] =
        [(UNDAMPED, None), (STEP, Some(coulomb(0.07, 0.05))), (RESTITUTION, Some(coulomb(0.07, 0.05)))];
    for (damping, friction) in cases {
        let (mut random, mut worst, mut compared) = (Rng::with_seed(72), 0.0f64, 0);
        for of in GEARS {
            let both = Both::sliced(of, Kind::LineWeber, damping, friction);
            for _ in 0..1500 {
                let Some((gaps, state)) = in_part(&mut random, &both) else { continue };
                let gaps: Option<&dyn Gaps> = Some(&gaps);
                let mut deepest = 0.0f64;
                both.look(gaps, &state, |slice: &SliceLoad| deepest = deepest.max(slice.arc));
                let (r, h) = (both.plain.cone, 1e-4 * deepest);
                let h = [h, h, h * r, 1e-3, 1e-3, 1e-3 * r];
                if !smooth(&both, gaps, &state, &h) {
                    continue;
                }
                compared += 1;
                let found = readings(&both.linearise(gaps, &state));
                let unit = |a: usize| if a < 2 { 1.0 / r } else { 1.0 };
                let by = |i: usize| if i == 2 { r } else { 1.0 };
                let sizes = (0..3).flat_map(|i| (0..7).map(move |a| (i, a)));
                let scale = sizes.map(|(i, a)| (found[a].d[i] * unit(a) * by(i)).abs()).fold(1e-30, f64::max);
                for i in 0..3 {
                    for a in 0..7 {
                        let d = difference(&state, i, h[i], |s| readings(&both.load(gaps, s))[a]);
                        let off = (found[a].d[i] - d).abs() * unit(a) * by(i) / scale;
                        worst = worst.max(off);
                        assert!(off < 1e-6, "{damping:?} {gaps:?} {state:?} reading {a} by {i}: {} {d}", found[a].d[i]);
                    }
                }
            }
        }
        println!("{damping:?}: worst {worst:e} in {compared} states");
        assert!(compared > 500, "{compared}");
    }
}

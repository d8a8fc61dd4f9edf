//! Loads of pairs on elastic gear bodies, checked against the compliance between pairs: within a mesh, between a
//! planet's two meshes, and with many small teeth.

use bevel_differential::contact::bodies::{GearBody, LoadedPair};
use bevel_differential::contact::shared::MAX_PAIRS;
use bevel_differential::contact::{Flank, Spot};
use nalgebra::{DMatrix, DVector};

use super::kinds::{At, Contact, Face, GEARS, Gears, PLAIN, Planet, STEEL};
use crate::mesh_laws::Kind;

const ELASTIC: Contact = Contact { is_elastic: true, ..PLAIN };

/// State with drive flanks of the first `sides` meshes pressed together by `approach` [rad] and the planet turned by
/// `x` [rad] along the left path.
fn pressed(planet: &Planet, approach: f64, sides: usize, x: f64) -> At {
    let q = [0, 1].map(|side| if side < sides { planet.pressed(-1.0, approach) } else { 0.0 });
    At { position: [[q[0], x, 0.0], [q[1], -x, 0.0]], ..At::FREE }
}

/// Touching pairs of both meshes, and true if the teeth of all of them are beams.
fn pairs(planet: &Planet, at: &At) -> (Vec<LoadedPair>, bool) {
    let [low, high] = planet.gears.stiffness[1].range;
    let (mut places, mut are_beams) = (Vec::new(), true);
    for side in 0..2 {
        for pair in planet.pairs(at, side) {
            are_beams &= pair.spot == Spot::Path && pair.s > low && pair.s < high;
            let tooth = if side == 0 { pair.number } else { planet.gears.opposite() - pair.number };
            places.push(LoadedPair { side, flank: Flank::Drive, number: pair.number, tooth, s: pair.s });
        }
    }
    (places, are_beams)
}

/// Displacement t of one pair of drive flanks under a unit load on another, computed from the bodies for loads up to
/// `past` [rad] beyond the ends of the path [1/Pa]. If the pairs belong to different meshes, the planet has an even
/// number of teeth.
fn between(gears: &Gears, past: f64, a: &LoadedPair, b: &LoadedPair) -> f64 {
    let [low, high] = [gears.stiffness[1].path[0] - past, gears.stiffness[1].path[1] + past];
    let teeth = &gears.on_bodies.teeth;
    let displacement = |i: usize| {
        let load = |pair: &LoadedPair| {
            let roll = teeth.rolls(gears.pair.outer_cone * pair.s.clamp(low, high))[i];
            let [across, along, moment] = gears.on_bodies.bodies[i].root.load(teeth.sections[i].load(roll).angle);
            // the drive flank presses the planet toward lower numbers on the left
            let sign = if i == 0 && pair.side == 0 { -1.0 } else { 1.0 };
            [sign * across, along, sign * moment]
        };
        // teeth of both meshes are opposite when they pass the pitch point, and pair numbers are constant during
        // contact
        let half_turn = f64::from(gears.pair.gears[0].teeth) / 2.0;
        let further = match (i, a.side, b.side) {
            (0, 0, 1) => half_turn + (a.number + b.number) as f64,
            (0, 1, 0) => -half_turn - (a.number + b.number) as f64,
            (0, 1, 1) => (b.number - a.number) as f64,
            _ => (a.number - b.number) as f64,
        };
        GearBody::displacement(&gears.on_bodies.between_teeth(i, further), &load(a), &load(b))
    };
    (0..if a.side == b.side { 2 } else { 1 }).map(displacement).sum()
}

#[test]
fn pair_loads_satisfy_their_common_compliance_within_a_mesh_and_between_meshes() {
    const APPROACH: f64 = 1e-5;
    let mut counts = [[0; 3]; 3];
    // teeth with backlash, so that a mesh that is not pressed is free
    for (gear, sides, j) in [(0, 1), (0, 2), (2, 1)].iter().flat_map(|of| (0..200).map(move |j| (of.0, of.1, j))) {
        let planet = Planet::new(ELASTIC, &GEARS[gear]);
        let gears = &planet.gears;
        let moment = (gears.pair.outer_cone.powi(3) - gears.pair.inner_cone.powi(3)) / 3.0;
        let at = pressed(&planet, APPROACH, sides, gears.pair.base_pitch * (f64::from(j) / 200.0 - 0.5));
        let (pairs, true) = pairs(&planet, &at) else { continue };
        let compliance = DMatrix::from_fn(pairs.len(), pairs.len(), |k, l| {
            let alone = || gears.on_bodies.alone(pairs[k].s, gears.stiffness[1].reference).total();
            if k == l { alone() } else { between(gears, 0.0, &pairs[k], &pairs[l]) }
        });
        let loads = compliance.clone().lu().solve(&DVector::repeat(pairs.len(), APPROACH)).unwrap();
        for side in 0..2 {
            let of_side = pairs.iter().zip(&loads).filter(|(pair, _)| pair.side == side);
            let expected = moment * of_side.map(|(_, load)| load).sum::<f64>();
            let found = planet.forces(&at).readings[side][0];
            assert!((found - expected).abs() <= 1e-6 * expected, "{pairs:?}: {found} {expected}");
        }
        let left = pairs.iter().filter(|pair| pair.side == 0).count();
        counts[left][pairs.len() - left] += 1;
        // the coupling is a few hundredths of a pair's own compliance
        assert!(left != 1 || pairs.len() != 2 || compliance[(0, 1)] > 0.03 * compliance[(0, 0)], "{compliance}");
    }
    assert!([[1, 0], [2, 0], [1, 1]].iter().all(|&[left, right]| counts[left][right] > 10), "{counts:?}");
}

/// Teeth and bores [m] of planet and side gear: few and many teeth, thin and thick shafts.
const SETS: [([i32; 2], [f64; 2]); 8] = [
    ([10, 16], [0.0, 0.0]),
    ([40, 40], [0.0, 0.0]),
    ([100, 100], [0.0, 0.2]),
    ([160, 160], [0.0, 0.0]),
    ([160, 160], [0.3, 0.3]),
    ([200, 200], [0.0, 0.1]),
    ([200, 10], [0.0, 0.0]),
    ([10, 200], [0.0, 0.0]),
];

#[test]
fn many_coupled_pairs_match_the_bodies_lose_no_energy_and_have_equal_loads_in_both_evaluators() {
    let mut crowded = 0;
    for (teeth, bores) in SETS {
        let planet = Planet::new(Contact { law: Kind::LineWeber, ..ELASTIC }, &Gears::new(teeth, bores, 1.5, 1e-4));
        let (gears, stiffness) = (&planet.gears, &planet.gears.stiffness[1]);
        // the Hertz part is smallest under the highest load, because of its slope
        let ratio = stiffness.limit / stiffness.reference;
        let stiffer = STEEL.hertz_factor() * (1.0 + if ratio >= 1.0 { ratio.ln() } else { ratio - 1.0 });
        let alone = |pair: &LoadedPair| stiffness.line().compliance(pair.s) - stiffer;
        let whole = Planet::new(Contact { face: Face::Whole, ..planet.contact }, gears);
        // up to half a base pitch of approach
        for (share, j) in [0.01, 0.1, 0.5, 1.0].into_iter().flat_map(|share| (0..6).map(move |j| (share, j))) {
            let pitch = gears.pair.base_pitch;
            let at = pressed(&planet, 0.5 * share * pitch, 2, pitch * f64::from(j) / 6.0);
            let (pairs, _) = pairs(&planet, &at);
            crowded += usize::from(pairs.len() > MAX_PAIRS);
            // if there are more pairs than fit, both evaluators choose the same ones
            let ((a, _), (b, _)) = (planet.linearised(&at), whole.linearised(&at));
            for i in planet.coordinates(0..6) {
                let off = (a.readings[i / 3][i % 3] - b.readings[i / 3][i % 3]).abs();
                assert!(off <= 1e-10 * planet.scale(&at), "{teeth:?} {at:?} {i}: off {off:e}");
            }
            assert_eq!((a, b), (planet.forces(&at), whole.forces(&at)));
            let scale = pairs.iter().map(alone).fold(0.0, f64::max);
            let together = DMatrix::from_fn(pairs.len(), pairs.len(), |k, l| {
                if k == l {
                    return alone(&pairs[k]) / scale;
                }
                let t = gears.couplings.coupling::<false>(&pairs[k], &pairs[l]).value;
                // one value is used for positions further past the ends
                let off = (t - between(gears, 0.25 * gears.pair.base_pitch, &pairs[k], &pairs[l])).abs();
                assert!(off < 0.03 * scale, "{teeth:?} {bores:?}: {off:e} of {scale:e}");
                t / scale
            });
            let least = together.symmetric_eigenvalues().min();
            assert!(least > 0.0, "{teeth:?} {bores:?}: {least}");
        }
    }
    assert!(crowded > 20, "{crowded}");
}

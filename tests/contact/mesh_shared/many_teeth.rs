//! Bodies under many small teeth: all pairs that can touch give way together as one elastic body does.

use bevel_differential::contact::bodies::{GearBody, PairPlace};
use bevel_differential::contact::pairs::Flank;
use nalgebra::DMatrix;

use super::setup::{Gears, Kind, STEEL, UNDAMPED};

/// MeshTeeth and bores [m] of planet and side gear: few and many, thin shafts and thick ones.
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
/// Base pitches past the ends of the path to which the places of loads are told apart.
const PAST: f64 = 0.25;

/// Pairs on the drive flanks of both meshes of a planet at `x` [rad] that approach by `a` [rad].
fn pairs(gears: &Gears, a: f64, x: f64) -> Vec<PairPlace> {
    let mut found = Vec::new();
    for side in 0..2 {
        let q = -(gears.mesh.half_backlash() + a);
        gears.mesh.engagement.pairs([q, if side == 0 { x } else { -x }], |pair| {
            let tooth = if side == 0 { pair.number } else { gears.teeth.opposite(0) - pair.number };
            found.push(PairPlace { side, flank: Flank::Drive, number: pair.number, tooth, s: pair.s });
        });
    }
    found
}

/// t of two pairs, as the bodies have it for loads within the ends of the path [1/Pa].
fn between(gears: &Gears, a: &PairPlace, b: &PairPlace) -> f64 {
    let past = PAST * gears.pair.base_pitch;
    let [low, high] = [gears.stiffness.path[0] - past, gears.stiffness.path[1] + past];
    let teeth = &gears.on_bodies.teeth;
    let shared = if a.side == b.side { 2 } else { 1 };
    (0..shared)
        .map(|i| {
            let load = |pair: &PairPlace| {
                let roll = teeth.rolls(gears.pair.outer_cone * pair.s.clamp(low, high))[i];
                let [across, along, moment] = gears.on_bodies.bodies[i].root.load(teeth.sections[i].load(roll).angle);
                // the drive flank presses the planet toward lower numbers on the left
                let sign = if i == 0 && pair.side == 0 { -1.0 } else { 1.0 };
                [sign * across, along, sign * moment]
            };
            let further = if i == 0 { a.tooth - b.tooth } else { a.number - b.number };
            GearBody::displacement(&gears.on_bodies.between_teeth(i, further as f64), &load(a), &load(b))
        })
        .sum()
}

#[test]
fn couplings_of_all_pairs_that_touch_are_those_of_the_bodies_and_lose_no_energy() {
    let mut most = 0;
    for (teeth, bores) in SETS {
        let gears = Gears::new((teeth, bores, 1e-4), Kind::LineWeber, UNDAMPED, false, None);
        let stiffness = &gears.stiffness;
        // Hertz's part is least under the highest load, by its slope
        let local = 2.0 * (1.0 - STEEL.poisson * STEEL.poisson) / (std::f64::consts::PI * STEEL.young);
        let ratio = stiffness.limit / stiffness.reference;
        let stiffer = local * (1.0 + if ratio >= 1.0 { ratio.ln() } else { ratio - 1.0 });
        let alone = |s: f64| stiffness.line().compliance(s) - stiffer;
        let (mut least, mut off) = (f64::INFINITY, 0.0f64);
        for share in [0.01, 0.1, 0.5, 1.0] {
            for j in 0..6 {
                let x = gears.pair.base_pitch * f64::from(j) / 6.0;
                let pairs = pairs(&gears, share * 0.5 * gears.pair.base_pitch, x);
                let n = pairs.len();
                most = most.max(n);
                let scale = pairs.iter().map(|pair| alone(pair.s)).fold(0.0, f64::max);
                let mut together = DMatrix::from_diagonal_element(n, n, 0.0);
                for k in 0..n {
                    together[(k, k)] = alone(pairs[k].s) / scale;
                    for l in 0..k {
                        let t = gears.bodies.coupling::<false>(&pairs[k], &pairs[l]).value;
                        (together[(k, l)], together[(l, k)]) = (t / scale, t / scale);
                        off = off.max((t - between(&gears, &pairs[k], &pairs[l])).abs() / scale);
                    }
                }
                least = least.min(together.symmetric_eigenvalues().min());
            }
        }
        println!("{teeth:?}: least eigenvalue {least:.3}, couplings off by {off:.1e}");
        assert!(least > 0.0, "{teeth:?} {bores:?}: {least}");
        // one value serves for places past the ends
        assert!(off < 0.03, "{teeth:?} {bores:?}: {off}");
    }
    assert!(most > 20, "{most}");
}

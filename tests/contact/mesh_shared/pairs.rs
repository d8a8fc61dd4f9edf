//! Loads of pairs as the compliance between them says: within a mesh, and between a planet's two meshes.

use bevel_differential::contact::mesh::MeshState;
use bevel_differential::contact::pairs::Spot;
use fastrand::Rng;

use super::setup::{GEARS, Gears, Kind, UNDAMPED, plain, random_states};

/// A planet pressed against side gear `side` by the approach `approach` [rad], its middle pair at `x` [rad], the other mesh free.
fn pressed(gears: &Gears, approach: f64, x: f64) -> [MeshState; 2] {
    let free = MeshState { position: [0.0, -x], ..MeshState::default() };
    let half = gears.mesh.half_backlash();
    [MeshState { position: [-half - approach, x], ..MeshState::default() }, free]
}

#[test]
fn pairs_of_one_mesh_carry_what_their_common_compliance_says() {
    // teeth that have play, so that the other mesh stays free
    for of in [GEARS[0], GEARS[2]] {
        let gears = Gears::new(of, Kind::Line, UNDAMPED, false, None);
        let load = gears.stiffness.reference;
        let [mut single, mut double] = [0; 2];
        for j in 0..200 {
            let x = gears.pair.base_pitch * (f64::from(j) / 200.0 - 0.5);
            let states = pressed(&gears, 1e-5, x);
            let mut places = Vec::new();
            let engagement = &gears.mesh.engagement;
            engagement.pairs(states[0].position, |pair| places.push((pair.s, pair.spot)));
            places.sort_by(|a, b| a.0.total_cmp(&b.0));
            if places
                .iter()
                .any(|&(s, spot)| spot != Spot::Path || s <= gears.stiffness.range[0] || s >= gears.stiffness.range[1])
            {
                continue;
            }
            let found = gears.force(&states).force[0].force[0] / (gears.moment * 1e-5);
            let expected = match places[..] {
                [(s, _)] => {
                    single += 1;
                    gears.on_bodies.alone(s, load).stiffness()
                }
                [(s, _), _] => {
                    double += 1;
                    gears.on_bodies.two_pairs(s, load)[0]
                }
                _ => continue,
            };
            assert!((found / expected - 1.0).abs() < 1e-6, "{places:?}: {found:e} {expected:e}");
        }
        assert!(single > 20 && double > 20, "{single} {double}");
    }
}

#[test]
fn a_planet_s_meshes_move_each_other_as_its_body_does() {
    let gears = Gears::new(GEARS[0], Kind::Line, UNDAMPED, false, None);
    let body = &gears.on_bodies.bodies[0];
    let (approach, half) = (1e-5, gears.mesh.half_backlash());
    let mut compared = 0;
    for j in 0..100 {
        // the planet turns: up the path on the left, down on the right
        let x = gears.pair.base_pitch * (f64::from(j) / 100.0 - 0.5);
        let at = |q: f64, x: f64| MeshState { position: [q, x], ..MeshState::default() };
        let states = [at(-half - approach, x), at(-half - approach, -x)];
        let pairs = states.map(|state| {
            let mut pairs = Vec::new();
            gears.mesh.engagement.pairs(state.position, |pair| pairs.push(*pair));
            pairs
        });
        let ([left], [right]) = (&pairs[0][..], &pairs[1][..]) else { continue };
        let inside = |s: f64| s > gears.stiffness.range[0] && s < gears.stiffness.range[1];
        if left.spot != Spot::Path || right.spot != Spot::Path || !inside(left.s) || !inside(right.s) {
            continue;
        }
        // one tooth is opposite the other as they pass the pitch point, and their numbers stay while they are in contact;
        // the load on the left tooth points along −ζ, on the right tooth along ζ
        let root = |s: f64| {
            let section = &gears.stiffness.teeth.sections[0];
            let roll = gears.stiffness.teeth.rolls(gears.pair.outer_cone * s)[0];
            body.root.load(section.load(roll).angle)
        };
        let half_turns = (left.number + right.number) as f64;
        let angle = std::f64::consts::PI + half_turns * std::f64::consts::TAU / 10.0;
        let between = body.compliance_between(angle);
        let ([q, n, m], r) = (root(left.s), root(right.s));
        let acting = [-q, n, -m];
        let t: f64 = (0..3).map(|a| r[a] * (0..3).map(|b| between[a][b] * acting[b]).sum::<f64>()).sum();
        let alone = [left.s, right.s].map(|s| gears.on_bodies.alone(s, gears.stiffness.reference).total());
        let determinant = alone[0] * alone[1] - t * t;
        let expected = [(alone[1] - t) * approach / determinant, (alone[0] - t) * approach / determinant];
        let found = gears.force(&states).force.map(|force| force.force[0] / gears.moment);
        for side in 0..2 {
            assert!((found[side] / expected[side] - 1.0).abs() < 1e-6, "{j}: {found:?} {expected:?} t {t:e}");
        }
        // a twentieth of a pair's own
        assert!(t > 0.03 * alone[0], "{t:e} {alone:?}");
        compared += 1;
    }
    assert!(compared > 10, "{compared}");
}

#[test]
fn flanks_that_do_not_touch_carry_nothing() {
    let mut random = Rng::with_seed(65);
    for of in GEARS {
        let gears = Gears::new(of, Kind::Line, UNDAMPED, false, None);
        for _ in 0..300 {
            let mut states = plain(&random_states(&mut random, &gears.pair, 0.0));
            // flanks that just do not touch
            states
                .iter_mut()
                .for_each(|s| s.position[0] = gears.mesh.half_backlash() * 0.999_999 * s.position[0].signum());
            let force = gears.force(&states);
            assert_eq!((force.energy, force.force.map(|f| f.force)), (0.0, [[0.0; 2]; 2]));
        }
    }
}

//! Without errors, friction and displacements the mesh in detail is the plain mesh.

use bevel_differential::contact::mesh::MeshState;
use fastrand::Rng;

use super::setup::{Both, KINDS, STATES, plain_state, random_state};
use crate::mesh_laws::{GEARS, Kind, RESTITUTION, STEP, UNDAMPED};

#[test]
fn without_effects_it_is_the_plain_mesh() {
    for kind in KINDS {
        let mut random = Rng::with_seed(21);
        let (mut worst, mut spots) = (0.0f64, [[0; 3]; 2]);
        for damping in [UNDAMPED, STEP, RESTITUTION] {
            if kind == Kind::Impact && damping == RESTITUTION {
                continue;
            }
            for of in GEARS {
                let both = Both::new(of, kind, damping);
                for _ in 0..STATES {
                    let state = random_state(&mut random, &both.pair, 0.0);
                    let (plain, load) = (both.plain.force(&plain_state(&state)), both.load(None, &state));
                    let resting = MeshState { rate: [0.0; 2], ..plain_state(&state) };
                    let scale = plain.force[0].abs().max(both.plain.force(&resting).force[0].abs());
                    for axis in 0..2 {
                        let off = (load.force[axis] - plain.force[axis]).abs() / scale;
                        worst = worst.max(off);
                        assert!(off < 1e-12, "{kind:?} {damping:?} {state:?} axis {axis}: off {off:e}");
                    }
                    assert!((load.heat[0] - plain.heat).abs() < 1e-12 * scale && load.heat[1] == 0.0);
                    let energy = both.plain.energy(&resting);
                    assert!((both.energy(None, &state) - energy).abs() < 1e-12 * energy);
                    let mut normal = 0.0;
                    both.plain.loaded(&plain_state(&state), |p, force| {
                        normal += force.total;
                        spots[p.flank as usize][p.spot as usize] += 1;
                    });
                    assert!((load.normal - normal).abs() < 1e-12 * scale / both.plain.cone);
                }
            }
        }
        println!("{kind:?}: worst {worst:e}, [path, planet tip, side tip] of [drive, coast]: {spots:?}");
        assert!(spots.iter().flatten().all(|&n| n > 100) || !kind.has_pairs(), "{kind:?} {spots:?}");
    }
}

#[test]
fn a_cut_face_without_errors_is_a_whole_one() {
    for kind in [Kind::Line, Kind::LineWeber] {
        let mut random = Rng::with_seed(22);
        let mut worst = 0.0f64;
        for of in GEARS {
            let (one, cut) = (Both::new(of, kind, UNDAMPED), Both::sliced(of, kind, UNDAMPED, None));
            assert!(!one.detailed.face.is_cut() && cut.detailed.face.is_cut());
            for _ in 0..STATES {
                let state = random_state(&mut random, &one.pair, 0.0);
                let (a, b) = (one.load(None, &state), cut.load(None, &state));
                let mut compare = |a: f64, b: f64, scale: f64| {
                    worst = worst.max((a - b).abs() / scale);
                    assert!((a - b).abs() < 1e-12 * scale, "{kind:?} {state:?}: {a} {b}");
                };
                compare(a.force[0], b.force[0], a.force[0].abs());
                compare(a.force[1], b.force[1], a.force[0].abs());
                compare(a.force[2], b.force[2], a.normal);
                compare(a.normal, b.normal, a.normal);
                compare(a.planet_axial, b.planet_axial, a.normal);
                compare(a.side_axial, b.side_axial, a.normal);
                compare(a.tangential, b.tangential, a.normal);
                let energy = one.energy(None, &state);
                compare(energy, cut.energy(None, &state), energy);
            }
        }
        println!("{kind:?}: worst {worst:e}");
    }
}

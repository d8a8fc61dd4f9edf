//! Drive and coast are mirror images, a base pitch changes nothing, and paths without corners carry as counted.

use bevel_differential::contact::mesh::{Law, MeshState};
use fastrand::Rng;

use super::setup::{OTHERS, STATES, at, impact_meshes, random_state};
use crate::mesh_laws::{RESTITUTION, UNDAMPED, meshes};

#[test]
fn coasting_is_the_mirror_image_of_driving() {
    let mut random = Rng::with_seed(15);
    for corner_contact in [true, false] {
        let others = OTHERS.into_iter().flat_map(|kind| meshes(kind, RESTITUTION, corner_contact));
        for (mesh, pair) in impact_meshes(5e4, corner_contact).into_iter().chain(others) {
            for _ in 0..STATES {
                let state = random_state(&mut random, &pair);
                let mirror = MeshState {
                    position: state.position.map(|x| -x),
                    rate: state.rate.map(|x| -x),
                    ..MeshState::default()
                };
                let ((a, da), (b, db)) = (mesh.linearise(&state), mesh.linearise(&mirror));
                assert_eq!(a.force, b.force.map(|f| -f), "{state:?}");
                assert_eq!((a.heat, da.by_position, da.by_rate), (b.heat, db.by_position, db.by_rate), "{state:?}");
                assert_eq!(mesh.energy(&state), mesh.energy(&mirror));
            }
        }
    }
}

#[test]
fn energy_is_the_same_a_base_pitch_further() {
    let mut random = Rng::with_seed(16);
    let others = OTHERS.into_iter().flat_map(|kind| meshes(kind, UNDAMPED, true));
    for (mesh, pair) in impact_meshes(0.0, true).into_iter().chain(others) {
        for _ in 0..STATES {
            let [q, x] = random_state(&mut random, &pair).position;
            let (here, next) = (mesh.energy(&at([q, x])), mesh.energy(&at([q, x + pair.base_pitch])));
            assert!((here - next).abs() <= 1e-11 * here, "{q} {x}: {here} {next}");
        }
    }
}

#[test]
fn without_corner_contact_each_pair_on_the_path_carries_the_whole_approach() {
    let mut random = Rng::with_seed(17);
    for (mesh, pair) in impact_meshes(0.0, false) {
        for _ in 0..STATES {
            let [q, x] = random_state(&mut random, &pair).position;
            let approach = q.abs() - pair.normal_backlash / 2.0;
            // teeth on the path, counted one by one: s = γ_p sinδ_bp ± x + k p_b
            let start = pair.centred_position() - q.signum() * x;
            let (low, high) = (-mesh.engagement.corner[1].end, mesh.engagement.corner[0].end);
            let count =
                (-20..=20).filter(|&k| (low..=high).contains(&(start + f64::from(k) * pair.base_pitch))).count();
            let Law::Impact(law) = &mesh.law else { panic!("the law is IMPACT") };
            let expected = count as f64 * law.energy(mesh.cone * approach);
            let energy = mesh.energy(&at([q, x]));
            assert!((energy - expected).abs() <= 1e-12 * expected, "{q} {x}: {energy} {expected}");
            // straight along the path: no force by x
            assert_eq!(
                mesh.force(&MeshState { position: [q, x], rate: [0.0; 2], ..MeshState::default() }).force[1],
                0.0
            );
        }
    }
}

//! The parts of a normal force along both axes are those of the flank's normal in space, at tip corners too.

use bevel_differential::geometry::action::LineOfAction;
use fastrand::Rng;
use nalgebra::Vector3;

use super::setup::{Both, STATES, random_state};
use crate::mesh_laws::{GEARS, Kind, UNDAMPED};

#[test]
fn parts_of_a_normal_force_are_those_of_the_normal_in_space() {
    let mut random = Rng::with_seed(31);
    let mut spots = [0; 3];
    for of in GEARS {
        let both = Both::new(of, Kind::Line, UNDAMPED);
        let action = LineOfAction::new(&both.pair);
        let side_axis = Vector3::new(both.pair.shaft_angle.sin(), 0.0, both.pair.shaft_angle.cos());
        for _ in 0..STATES {
            let state = random_state(&mut random, &both.pair, 0.0);
            both.look(None, &state, |slice| {
                spots[slice.spot as usize] += 1;
                // from the planet into the side gear: it pushes the planet back
                let normal = action.contact(slice.spot, slice.place, 1.0).normal;
                let expected = [-normal.z, normal.dot(&side_axis)];
                for (found, expected) in slice.parts.into_iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-8, "{of:?} {:?}: {found} {expected}", slice.spot);
                }
                // what is left is along the rotation
                let left = (1.0 - expected[0] * expected[0] - expected[1] * expected[1]).sqrt();
                assert!((slice.parts[2].abs() - left).abs() < 1e-8, "{of:?} {:?}", slice.spot);
            });
        }
    }
    assert!(spots.iter().all(|&n| n > 100), "{spots:?}");
}

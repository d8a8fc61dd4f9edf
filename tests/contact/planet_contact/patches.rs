//! A partly loaded face: loads and deflections compared with a separate sum over 4000 slices of the same law, for
//! patches of every length, in the middle, at one end and over both ends.

use bevel_differential::contact::errors::ToothErrorSpec;

use super::kinds::{At, Contact, Face, GEARS, OF_TEETH, PLAIN, Planet, SOUND, Teeth};
use crate::mesh_laws::Kind;

/// Number of slices of the separate sum.
const SLICES: usize = 4000;
/// Crowning at both ends of the face [m].
const CROWNS: [f64; 10] = [0.0, 1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 48e-6, 1e-4, 2e-4, 3e-4];

/// A planet whose teeth have crowning of `crown` [m] at both ends of the face, and a gap `even` [m] that closes in the
/// middle at the pitch point. One tooth is broken by a depth [m] beyond a cone distance.
fn crowned(law: Kind, crown: f64, even: f64, edge: Option<[f64; 2]>) -> Planet {
    let pair = &GEARS[0].pair;
    let per_even = pair.pressure_angle.sin();
    let spec = ToothErrorSpec {
        crowning: crown,
        side_axial_offset: even / (per_even * pair.gears[1].pitch.sin()),
        shaft_angle_error: -even / (per_even * pair.mean_cone),
        ..ToothErrorSpec::default()
    };
    let width = pair.outer_cone - pair.inner_cone;
    let missing = edge.map_or(SOUND, |[edge, depth]| [(pair.outer_cone - edge) / width, depth]);
    Planet::new(Contact { law, face: Face::Distributed, teeth: Teeth::Made(spec, missing), ..PLAIN }, &GEARS[0])
}

/// ∫ω R² dR and ∫ω R dR over the faces of all pairs at the point `at`, summed over slices.
fn slices(planet: &Planet, at: &At) -> [f64; 2] {
    let [inner, outer] = [planet.gears.pair.inner_cone, planet.gears.pair.outer_cone];
    let width = (outer - inner) / SLICES as f64;
    let mut sums = [0.0; 2];
    for pair in planet.pairs(at, 0) {
        let opening = planet.opening(&pair);
        for j in 0..SLICES {
            let r = inner + (j as f64 + 0.5) * width;
            let arc = pair.depth - opening.at(r) / r;
            if arc > 0.0 {
                let load = planet.torque(arc, pair.s) * r * width;
                sums = [sums[0] + load * r, sums[1] + load];
            }
        }
    }
    sums
}

#[test]
fn a_patch_of_any_length_has_the_load_of_4000_slices_of_the_law() {
    let (mut compared, mut partial, middle) = (0, 0, GEARS[0].pair.mean_cone);
    for (law, crown) in OF_TEETH.into_iter().flat_map(|law| CROWNS.map(|crown| (law, crown))) {
        for even in [-30e-6, 0.0, 40e-6] {
            for edge in [None, Some([middle + 2e-3, 1e-3]), Some([middle - 3e-3, 4e-6])] {
                let planet = crowned(law, crown, even, edge);
                let kind = planet.contact;
                // under 835 N·m on one of two planets, teeth without crowning approach by 2e-3
                for approach in [3e-6, 2e-5, 1e-4, 5e-4, 1e-3, 2e-3, 4e-3] {
                    let q = planet.pressed(-1.0, approach);
                    let at = At { position: [[q, -planet.gears.pair.centred_position(), 0.0], [0.0; 3]], ..At::FREE };
                    let (torque, normal) =
                        (planet.forces(&at).readings[0][0], planet.normal(&at, |load| load.side == 0));
                    let own = slices(&planet, &at);
                    if own[1] < 1e-3 {
                        assert!(normal < 2e-3, "{kind:?} {at:?}: {normal}");
                        continue;
                    }
                    (compared, partial) = (compared + 1, partial + usize::from(planet.pattern(&at).is_partly_loaded()));
                    // error of the midpoint rule if the load ends within a slice
                    let off = [torque / own[0] - 1.0, normal / own[1] - 1.0];
                    assert!(off.iter().all(|off| off.abs() < 3e-4), "{kind:?} {at:?}: {own:?} off {off:?}");
                }
            }
        }
    }
    assert!(compared > 500 && partial > 150, "{compared} {partial}");
}

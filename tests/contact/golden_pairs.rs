//! Tooth pairs computed with 3-D finite elements: golden_fe3d_pairs.csv, by gear set and support.

use bevel_differential::contact::bodies::Support;
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair};

/// Fillet radius of the reference [modules].
pub const FILLET: f64 = 0.40;

/// Rows of one gear set with one kind of support.
pub struct Set {
    pub name: String,
    pub spec: GearSpec,
    /// Modelled part: "tooth" down to below the root, "full" down to the bore.
    pub body: &'static str,
    pub supports: [Support; 2],
    /// Rows of s [rad], q of planet and side gear, q_H [mm·µm/N], c [N/(mm·µm)].
    pub single: Vec<[f64; 5]>,
    /// Rows of s [rad] and c of two pairs with and without coupling [N/(mm·µm)].
    pub double: Vec<[f64; 3]>,
}

/// All sets, in the order of the file.
pub fn sets() -> Vec<Set> {
    let mut sets: Vec<Set> = Vec::new();
    let lines = include_str!("../data/golden_fe3d_pairs.csv").lines().filter(|l| !l.starts_with('#'));
    for line in lines.skip(1) {
        let columns: Vec<&'static str> = line.split(',').collect();
        let number = |i: usize| columns[i].parse::<f64>().expect("a number");
        let name = columns[..9].join(" ");
        if sets.last().is_none_or(|set| set.name != name) {
            let spec = GearSpec {
                module: number(0) * 1e-3,
                planet_teeth: number(1) as i32,
                side_teeth: number(2) as i32,
                pressure_angle: number(3).to_radians(),
                addendum_system: match columns[5] {
                    "gleason" => AddendumSystem::Gleason,
                    "iso" => AddendumSystem::Iso23509,
                    other => panic!("{other}"),
                },
                ..GearSpec::default()
            };
            let spec = GearSpec { face_width: number(4) * Pair::new(&spec).outer_cone, ..spec };
            let supports = match columns[6] {
                "tooth" => [Support::NearRoot; 2],
                // the reference specifies radii
                "full" => [number(7), number(8)].map(|radius| Support::Bore(2e-3 * radius)),
                other => panic!("{other}"),
            };
            sets.push(Set { name, spec, body: columns[6], supports, single: Vec::new(), double: Vec::new() });
        }
        let set = sets.last_mut().expect("a set");
        match columns[9] {
            "one" => set.single.push([number(10).to_radians(), number(11), number(12), number(13), number(14)]),
            "two" => set.double.push([number(10).to_radians(), number(15), number(16)]),
            other => panic!("{other}"),
        }
    }
    sets
}

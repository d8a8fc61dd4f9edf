//! Tests of outlines and surfaces: tangent fillets, closed manifolds, crowning.

use std::collections::HashMap;

use bevel_differential::geometry::involute::direction;
use bevel_differential::geometry::solid::{GearSolid, Outline, Part, Shape};
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair, checks};
use nalgebra::Vector3;

/// Gears of all kinds without `checks::errors`, named by their special property.
pub(crate) fn specs() -> Vec<(&'static str, GearSpec)> {
    let base = GearSpec::default();
    let teeth = |planet_teeth, side_teeth| GearSpec { planet_teeth, side_teeth, ..base };
    let slender = |planet_teeth, side_teeth| GearSpec { face_width: 5e-3, ..teeth(planet_teeth, side_teeth) };
    let explicit = GearSpec { addendum_system: AddendumSystem::Explicit, ..base };
    let specs = vec![
        ("default", base),
        ("bored", GearSpec { planet_bore: 0.012, side_bore: 0.02, ..base }),
        ("odd", teeth(9, 14)),
        ("odd both", teeth(11, 15)),
        ("mitre", teeth(14, 14)),
        ("root above base", GearSpec { side_bore: 0.06, ..teeth(12, 40) }),
        ("many teeth", GearSpec { pressure_angle: 0.45, ..teeth(40, 60) }),
        ("few teeth", slender(5, 5)),
        ("25 degrees", GearSpec { pressure_angle: 25f64.to_radians(), ..base }),
        ("flat 10 degrees", GearSpec { pressure_angle: 10f64.to_radians(), ..base }),
        ("standard", GearSpec { addendum_system: AddendumSystem::Standard, ..base }),
        ("iso", GearSpec { addendum_system: AddendumSystem::Iso23509, ..base }),
        (
            "stub",
            GearSpec { planet_addendum: 0.6, side_addendum: 0.6, planet_dedendum: 0.7, side_dedendum: 0.7, ..explicit },
        ),
        (
            "flanks meet above the root",
            GearSpec { planet_teeth: 40, side_teeth: 60, planet_dedendum: 3.0, side_dedendum: 3.0, ..explicit },
        ),
        ("sharp", GearSpec { root_fillet: 0.0, ..base }),
        ("sharp with bore", GearSpec { root_fillet: 0.0, planet_bore: 0.01, side_bore: 0.01, ..base }),
        ("sharp, root above base", GearSpec { root_fillet: 0.0, ..teeth(12, 40) }),
        ("small fillet", GearSpec { root_fillet: 0.2, ..base }),
        ("full round", GearSpec { root_fillet: 1.0, ..base }),
        ("thin teeth, full round", GearSpec { root_fillet: 1.0, backlash: 2.5e-3, ..teeth(12, 40) }),
        ("obtuse", GearSpec { shaft_angle: 100f64.to_radians(), ..base }),
    ];
    for (name, spec) in &specs {
        let problems = checks::errors(spec, &Pair::new(spec));
        assert!(problems.is_empty(), "{name}: {problems:?}");
    }
    specs
}

/// Requested angular radius of the fillets [rad].
pub(super) fn fillet(spec: &GearSpec, pair: &Pair) -> f64 {
    spec.root_fillet * pair.module / pair.outer_cone
}

/// Enclosed volume [m³]: sum of the tetrahedra between the triangles and the apex, negative if they face inward.
pub(super) fn volume(solid: &GearSolid) -> f64 {
    let corner = |i: u32| solid.vertices[i as usize];
    solid.triangles.iter().map(|&[a, b, c]| corner(a).dot(&corner(b).cross(&corner(c))) / 6.0).sum()
}

#[test]
fn every_surface_is_closed_consistently_oriented_and_without_degenerate_triangles() {
    for (name, spec) in specs() {
        let pair = Pair::new(&spec);
        for (gear, bore) in [spec.planet_bore, spec.side_bore].into_iter().enumerate() {
            for facets in [1, 2, 4, 7, 32] {
                for strips in [1, 3] {
                    for crowning in [0.0, 2e-5] {
                        let shape = Shape { facets, strips, crowning };
                        let solid = GearSolid::shaped(&pair, &spec, gear, &shape);
                        check_manifold(&solid, bore > 0.0, &format!("{name} {gear} {shape:?}"));
                    }
                }
                let sector = GearSolid::sector(&pair, &spec, gear, facets);
                check_manifold(&sector, false, &format!("{name} {gear} sector {facets}"));
            }
        }
    }
}

fn check_manifold(solid: &GearSolid, torus: bool, what: &str) {
    let mut edges: HashMap<[u32; 2], usize> = HashMap::new();
    let mut used = vec![false; solid.vertices.len()];
    for &[a, b, c] in &solid.triangles {
        for edge in [[a, b], [b, c], [c, a]] {
            *edges.entry(edge).or_default() += 1;
            used[edge[0] as usize] = true;
        }
        let [p, q, r] = [a, b, c].map(|i| solid.vertices[i as usize]);
        let longest = (p - q).norm().max((q - r).norm()).max((r - p).norm());
        let height = (q - p).cross(&(r - p)).norm() / longest;
        assert!(height > 1e-7 * longest && longest > 1e-8, "{what}: {p} {q} {r}");
    }
    assert!(used.iter().all(|&u| u), "{what}: a vertex is not used");
    for (&[a, b], &count) in &edges {
        assert_eq!((count, edges.get(&[b, a])), (1, Some(&1)), "{what}: edge {a} {b}");
    }
    let euler = solid.vertices.len() as i64 - edges.len() as i64 / 2 + solid.triangles.len() as i64;
    assert_eq!(euler, if torus { 0 } else { 2 }, "{what}");
    assert!(volume(solid) > 0.0, "{what}");
}

#[test]
fn flank_nodes_lie_on_the_spherical_involute() {
    for (name, spec) in specs() {
        let pair = Pair::new(&spec);
        for gear in &pair.gears {
            let outline = Outline::new(gear, fillet(&spec, &pair), 16);
            let flanks: Vec<_> = outline.nodes.iter().filter(|n| n.part == Part::Flank).collect();
            assert_eq!(flanks.len(), 2 * 17, "{name}");
            for node in flanks {
                let exact = gear.flank_point(node.polar, node.azimuth.signum());
                let off = (direction(node.polar, node.azimuth) - exact).norm();
                assert!(off < 1e-12, "{name}: {off:e}");
            }
            assert!((outline.nodes[outline.nodes.len() / 2].polar - gear.tip).abs() < 1e-14, "{name}");
        }
    }
}

#[test]
fn outlines_run_forward_from_gap_to_gap_and_are_symmetric() {
    for (name, spec) in specs() {
        let pair = Pair::new(&spec);
        for gear in &pair.gears {
            let nodes = Outline::new(gear, fillet(&spec, &pair), 12).nodes;
            assert!((nodes[0].azimuth + gear.tooth_pitch() / 2.0).abs() < 1e-15, "{name}");
            for (node, mirrored) in nodes.iter().zip(nodes.iter().rev()) {
                let unlike = (node.azimuth + mirrored.azimuth).abs() + (node.polar - mirrored.polar).abs();
                assert!(unlike < 1e-15 && node.part == mirrored.part, "{name}: {node:?} {mirrored:?}");
            }
            for pair in nodes.windows(2) {
                assert!(pair[1].azimuth >= pair[0].azimuth, "{name}: {pair:?}");
            }
        }
    }
}

#[test]
fn fillets_are_tangent_to_the_root_circle_and_to_the_flank() {
    let mut kinds = [0; 4];
    for (name, spec) in specs() {
        let pair = Pair::new(&spec);
        for gear in &pair.gears {
            let wanted = fillet(&spec, &pair);
            let foot = Outline::new(gear, wanted, 4).foot;
            if foot.radius == 0.0 {
                kinds[0] += 1;
                continue;
            }
            assert!(foot.radius <= wanted && foot.centre <= foot.middle, "{name}");
            let point = |u: f64| {
                let [polar, azimuth] = foot.fillet_at(u);
                direction(polar, azimuth)
            };
            let centre = direction(foot.floor + foot.radius, foot.centre);
            for u in [0.0, 0.3, 1.0] {
                assert!((point(u).angle(&centre) - foot.radius).abs() < 1e-8, "{name}");
                // to the accuracy of the angle, and exactly by the chord
                assert!(((point(u) - centre).norm() - 2.0 * (foot.radius / 2.0).sin()).abs() < 1e-14, "{name}");
            }
            // ends: on the root circle below the centre, and on the flank or meridian
            let [begin, end] = [0.0, 1.0].map(point);
            assert!((begin - direction(foot.floor, foot.centre)).norm() < 1e-13, "{name}");
            assert!((end - direction(foot.end[0], foot.end[1])).norm() < 1e-13, "{name}");
            // tangents: the radius is the normal of the root circle, and of the flank or meridian at the other end
            let normal = if foot.start_arc > 0.0 {
                kinds[1] += 1;
                assert!((end - gear.flank_point(foot.end[0], 1.0)).norm() < 1e-12, "{name}");
                gear.flank_normal(foot.end[0], 1.0)
            } else {
                kinds[2] += 1;
                assert!((foot.end[1] - gear.half_angle(gear.base)).abs() < 1e-15, "{name}");
                Vector3::new(-foot.end[1].sin(), foot.end[1].cos(), 0.0)
            };
            let toward = |p: &Vector3<f64>| (centre - p * p.dot(&centre)).normalize();
            assert!((toward(&end) - normal).norm() < 1e-10, "{name}: {} {normal}", toward(&end));
            let up = Vector3::new(0.0, 0.0, -1.0);
            let up = (up - begin * begin.dot(&up)).normalize();
            assert!((toward(&begin) - up).norm() < 1e-10, "{name}");
            if foot.radius < wanted {
                kinds[3] += 1;
                let at_pitch = (foot.end[0] - gear.pitch).abs() < 1e-9;
                assert!(foot.centre == foot.middle || at_pitch, "{name}: {foot:?}");
            }
        }
    }
    assert!(kinds.iter().all(|&k| k >= 3), "every kind of foot: {kinds:?}");
}

#[test]
fn crowning_removes_the_parabola_from_the_flanks_and_leaves_their_middle() {
    let spec = GearSpec::default();
    let pair = Pair::new(&spec);
    let crowning = 2e-5;
    let shape = |crowning| Shape { facets: 8, strips: 4, crowning };
    let [plain, crowned] = [0.0, crowning].map(|c| GearSolid::shaped(&pair, &spec, 1, &shape(c)));
    assert_eq!(plain.triangles, crowned.triangles);
    let mut moved = 0;
    for (a, b) in plain.vertices.iter().zip(&crowned.vertices) {
        let off = (a - b).norm();
        if off > 0.0 {
            let u = (a.norm() - pair.mean_cone) / (spec.face_width / 2.0);
            assert!((off - crowning * u * u).abs() < 1e-15, "{off} {u}");
            moved += 1;
        }
    }
    // two flanks with nine nodes each on sixteen teeth, in four of five rows
    assert_eq!(moved, 2 * 9 * 16 * 4);
    let (less, whole) = (volume(&crowned), volume(&plain));
    assert!(less < whole, "{less:e} {whole:e}");
}

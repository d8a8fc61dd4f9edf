//! Solid teeth against the path of contact: depth, force, derivatives, misalignment.

use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::errors::{MeshId, PairId, ToothErrorSpec, ToothErrors};
use bevel_differential::contact::impact::Impact;
use bevel_differential::contact::mesh::MeshState;
use bevel_differential::contact::pairs::{Engagement, Flank, Spot};
use bevel_differential::contact::solid::loads::SolidLoad;
use bevel_differential::contact::solid::mesh::{SolidMesh, SolidSlice, SolidSpec};
use bevel_differential::contact::solid::pose::Displacement;
use bevel_differential::geometry::{GearSpec, Pair};

const IMPACT: Impact = Impact { stiffness: 1.82463e10, exponent: 1.5, damping: 5e4, per_full_depth: 1e4 };
const DAMPING: Damping = Damping::Step { coefficient: 5e4, per_full_depth: 1e4 };
/// Approach under the study's load if one pair transmits it [m].
const DEPTH: f64 = 0.1e-3;

fn slice(pair: &Pair, cone: f64) -> SolidSlice {
    SolidSlice { cone, share: 1.0, width: pair.outer_cone - pair.inner_cone, relief: 0.0 }
}

fn displaced(pair: &Pair, facets: usize, smoothing: f64, slices: Vec<SolidSlice>, d: Displacement) -> SolidMesh {
    let fillet = 0.4 * pair.module / pair.outer_cone;
    let spec = SolidSpec { fillet, facets, smoothing, slices, displaced: vec![[d; 2]] };
    SolidMesh::new(pair, &spec, IMPACT, DAMPING, 1e-3)
}

fn aligned(pair: &Pair, facets: usize, smoothing: f64) -> SolidMesh {
    displaced(pair, facets, smoothing, vec![slice(pair, pair.mean_cone)], Displacement::default())
}

fn pairs_of_gears() -> Vec<Pair> {
    [(10, 16, 20.0), (9, 14, 22.5), (14, 14, 25.0), (12, 18, 20.0)]
        .map(|(z_p, z_s, alpha): (i32, i32, f64)| {
            Pair::new(&GearSpec {
                planet_teeth: z_p,
                side_teeth: z_s,
                pressure_angle: alpha.to_radians(),
                ..GearSpec::default()
            })
        })
        .to_vec()
}

fn loads(mesh: &SolidMesh, position: [f64; 2]) -> Vec<SolidLoad> {
    let mut found = Vec::new();
    mesh.loaded(&MeshState { position, ..MeshState::default() }, |load| found.push(*load));
    found
}

/// Positions over one pitch, with the relative position at which drive (−1) or coast (+1) flanks overlap by `depth`
/// [m].
fn sweep(pair: &Pair, flank: Flank, depth: f64, n: i32) -> Vec<[f64; 2]> {
    let sign = if flank == Flank::Drive { -1.0 } else { 1.0 };
    let q = sign * (depth / pair.mean_cone + pair.normal_backlash / 2.0);
    (0..n).map(|i| [q, pair.base_pitch * (f64::from(i) + 0.37) / f64::from(n)]).collect()
}

/// Largest difference of depth between solid teeth and the path of contact over one pitch [m].
fn worst_depth(pair: &Pair, mesh: &SolidMesh, flank: Flank) -> f64 {
    let engagement = Engagement::new(pair, true, 0.1);
    let mut worst = 0.0f64;
    for position in sweep(pair, flank, DEPTH, 60) {
        let solid = loads(mesh, position);
        for p in engagement.pairs(position) {
            // below the base circle, a flank is a meridian, which the gap of tip corners does not include
            if p.spot == Spot::Path {
                let depth = solid.iter().find(|l| l.number == p.number).map_or(0.0, |l| l.depth);
                assert!(solid.iter().all(|l| l.flank == flank));
                worst = worst.max((depth - p.depth).abs() * pair.mean_cone);
            }
        }
    }
    worst
}

#[test]
fn depth_converges_with_the_square_of_the_facets_to_the_approach_on_the_path_of_contact() {
    for pair in pairs_of_gears() {
        for flank in [Flank::Drive, Flank::Coast] {
            for smoothing in [1.0, 0.1] {
                let at = |facets| worst_depth(&pair, &aligned(&pair, facets, smoothing), flank);
                let (coarse, middle, fine) = (at(64), at(128), at(256));
                for order in [(coarse / middle).log2(), (middle / fine).log2()] {
                    assert!(order > 1.8, "{} {smoothing} {flank:?}: {coarse} {middle} {fine}", pair.gears[0].teeth);
                }
                assert!(fine < 0.2e-6, "{fine}");
            }
        }
    }
}

#[test]
fn both_tip_corners_penetrate_as_deeply_as_in_spherical_trigonometry() {
    let pair = Pair::new(&GearSpec::default());
    let engagement = Engagement::new(&pair, true, 0.1);
    let mesh = aligned(&pair, 512, 0.1);
    let mut corners = [0, 0];
    for flank in [Flank::Drive, Flank::Coast] {
        for position in sweep(&pair, flank, DEPTH, 200) {
            let solid = loads(&mesh, position);
            for p in engagement.pairs(position) {
                let which = match p.spot {
                    Spot::Path => continue,
                    Spot::PlanetTip => 0,
                    // beyond this point the planet's flank is a meridian, but the closed form continues along the
                    // involute
                    Spot::SideTip if p.s < -pair.pitch_arc[0] + 0.005 => continue,
                    Spot::SideTip => 1,
                };
                let depth = solid.iter().find(|l| l.number == p.number).map_or(0.0, |l| l.depth);
                let off = (depth - p.depth) * pair.mean_cone;
                // the patch at a corner is on only one side of the corner
                assert!(
                    off.abs() < 0.2e-6,
                    "{:?} {} off by {off} m of {}",
                    p.spot,
                    p.spot_arc,
                    p.depth * pair.mean_cone
                );
                corners[which] += 1;
            }
        }
    }
    assert!(corners.iter().all(|&n| n > 10), "{corners:?}");
}

#[test]
fn forces_are_the_gradient_of_the_energy_and_jacobians_match_the_forces() {
    let pair = Pair::new(&GearSpec::default());
    let d = Displacement { along: [40e-6, -20e-6], across: 30e-6, lean: 0.6e-3 };
    let faces: Vec<SolidSlice> = [0.1, 0.5, 0.9]
        .map(|t| SolidSlice {
            share: 1.0 / 3.0,
            relief: 10e-6 * (2.0 * t - 1.0) * (2.0 * t - 1.0),
            ..slice(&pair, pair.inner_cone + t * (pair.outer_cone - pair.inner_cone))
        })
        .to_vec();
    for facets in [4, 8, 32, 64] {
        let mesh = displaced(&pair, facets, 1.0, faces.clone(), d);
        for flank in [Flank::Drive, Flank::Coast] {
            for position in sweep(&pair, flank, DEPTH, 23) {
                let state = MeshState { position, rate: [0.3, -0.7], which: [0, 1] };
                let (force, jacobian) = mesh.linearise(&state);
                let plain = mesh.force(&state);
                assert_eq!(force.force, plain.force);
                assert_eq!(force.heat, plain.heat);
                let h = 1e-8;
                let moved = |k: usize, by: f64, of_rate: bool| {
                    let mut s = state;
                    if of_rate {
                        s.rate[k] += by
                    } else {
                        s.position[k] += by
                    }
                    s
                };
                let still = mesh.force(&MeshState { rate: [0.0; 2], ..state });
                for k in 0..2 {
                    let energy = |by: f64| mesh.energy(state.which, moved(k, by, false).position);
                    let gradient = (energy(h) - energy(-h)) / (2.0 * h);
                    let scale = still.force[0].abs() + 1.0;
                    assert!((gradient + still.force[k]).abs() < 1e-6 * scale, "{facets} {gradient} {:?}", still.force);
                    for a in 0..2 {
                        let scale = jacobian.by_position[0][0].abs() + 1.0;
                        let slope = (mesh.force(&moved(k, h, false)).force[a]
                            - mesh.force(&moved(k, -h, false)).force[a])
                            / (2.0 * h);
                        let found = jacobian.by_position[a][k];
                        assert!((slope - found).abs() < 1e-5 * scale, "{facets} {a}{k}: {slope} {found}");
                        let (h, scale) = (1e-4, jacobian.by_rate[0][0].abs() + 1e-3);
                        let slope = (mesh.force(&moved(k, h, true)).force[a]
                            - mesh.force(&moved(k, -h, true)).force[a])
                            / (2.0 * h);
                        let found = jacobian.by_rate[a][k];
                        assert!((slope - found).abs() < 1e-6 * scale, "{facets} {a}{k}: {slope} {found}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_force_has_no_jumps_beyond_a_thousandth_from_eight_facets_on() {
    let pair = Pair::new(&GearSpec::default());
    for (facets, smoothing) in [(8, 1.0), (16, 1.0), (32, 1.0), (128, 1.0)] {
        let mesh = aligned(&pair, facets, smoothing);
        let points = sweep(&pair, Flank::Drive, DEPTH, 5_000);
        let force = |x: f64| mesh.force(&MeshState { position: [points[0][0], x], ..MeshState::default() }).force;
        let apart = |a: f64, b: f64| (0..2).map(|i| (force(a)[i] - force(b)[i]).abs()).fold(0.0, f64::max);
        // follow the steepest change down to a scale at which only a jump would remain
        let steepest = |n: usize| {
            let [mut a, mut b] = [points[n][1], points[n + 1][1]];
            for _ in 0..24 {
                let middle = 0.5 * (a + b);
                if apart(a, middle) > apart(middle, b) { b = middle } else { a = middle }
            }
            apart(a, b)
        };
        let mut steps: Vec<usize> = (0..points.len() - 1).collect();
        steps.sort_by(|&m, &n| {
            let change = |n: usize| apart(points[n][1], points[n + 1][1]);
            change(n).total_cmp(&change(m))
        });
        let jump = steps.iter().take(40).map(|&n| steepest(n)).fold(0.0, f64::max);
        let scale = force(points[0][1])[0].abs();
        // overlaps are assumed linear between corners, which is only approximate because the slopes of the normals vary
        assert!(jump < 1e-3 * scale, "{facets} {smoothing}: {jump} of {scale}");
    }
}

#[test]
fn resultants_are_on_the_line_of_action_with_the_moment_arms_of_virtual_work() {
    let pair = Pair::new(&GearSpec::default());
    let mesh = aligned(&pair, 256, 1.0);
    let engagement = Engagement::new(&pair, true, 0.1);
    for flank in [Flank::Drive, Flank::Coast] {
        for position in sweep(&pair, flank, DEPTH, 40) {
            for load in loads(&mesh, position) {
                if engagement.rigid_spot(load.s).0 != Spot::Path {
                    continue;
                }
                let sign = if flank == Flank::Drive { 1.0 } else { -1.0 };
                let [np, ns, nt] = load.normal;
                let [p, s, t] = load.point;
                // (axis × point)·normal about both axes, which are perpendicular: sinδ_b
                for (i, lever) in [(0, s * nt - t * ns), (1, p * nt - t * np)] {
                    let wanted = sign * pair.sin_base()[i];
                    assert!((lever - wanted).abs() < 2e-3, "{flank:?} gear {i}: {lever} {wanted}");
                }
                assert!((np * np + ns * ns + nt * nt - 1.0).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn misaligned_gaps_agree_with_the_first_order_formulas_on_both_flanks_and_sides() {
    let pair = Pair::new(&GearSpec::default());
    let size = 10e-6;
    let specs = [
        ToothErrorSpec { planet_axial_offset: size, ..ToothErrorSpec::default() },
        ToothErrorSpec { planet_axial_offset: -size, ..ToothErrorSpec::default() },
        ToothErrorSpec { side_axial_offset: size, ..ToothErrorSpec::default() },
        ToothErrorSpec { axis_offset: size, ..ToothErrorSpec::default() },
        ToothErrorSpec { axis_offset: -size, ..ToothErrorSpec::default() },
        ToothErrorSpec { shaft_angle_error: size / pair.mean_cone, ..ToothErrorSpec::default() },
        ToothErrorSpec { shaft_angle_error: -size / pair.mean_cone, ..ToothErrorSpec::default() },
        ToothErrorSpec { crowning: size, ..ToothErrorSpec::default() },
    ];
    let width = pair.outer_cone - pair.inner_cone;
    for spec in specs {
        let errors = ToothErrors::new(&spec, &pair, 2).unwrap();
        for side in 0..2 {
            let d = Displacement {
                along: [spec.planet_axial_offset, -spec.side_axial_offset],
                across: spec.axis_offset,
                lean: if side == 0 { spec.shaft_angle_error } else { -spec.shaft_angle_error },
            };
            for t in [0.0, 0.3, 1.0] {
                let cone = pair.inner_cone + t * width;
                let relief = spec.crowning * (2.0 * t - 1.0) * (2.0 * t - 1.0);
                let one = SolidSlice { relief, ..slice(&pair, cone) };
                let mesh = displaced(&pair, 256, 0.2, vec![one], d);
                let plain = displaced(&pair, 256, 0.2, vec![slice(&pair, cone)], Displacement::default());
                for flank in [Flank::Drive, Flank::Coast] {
                    for position in sweep(&pair, flank, DEPTH, 12) {
                        for load in loads(&plain, position) {
                            // well within the path, because at its ends contact moves to the corners
                            if load.s < pair.path.low + 0.03 || load.s > pair.path.high - 0.03 {
                                continue;
                            }
                            let moved = loads(&mesh, position).into_iter().find(|l| l.number == load.number);
                            let opened = (load.depth - moved.map_or(0.0, |l| l.depth)) * cone;
                            let id = PairId { planet_tooth: 0, side_tooth: 0, flank };
                            let gap = errors.gap(MeshId { planet: 0, side }, id, cone, load.s);
                            // the difference is of second order in the displacement, over the radius of curvature:
                            // size² / some mm
                            assert!(
                                (opened - gap).abs() < 0.01 * size,
                                "{spec:?} {side} {flank:?} {cone}: {opened} {gap}"
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn gears_turned_by_whole_pitches_touch_identically_with_the_next_pair_numbers() {
    let pair = Pair::new(&GearSpec::default());
    let mesh = aligned(&pair, 16, 1.0);
    for [q, x] in sweep(&pair, Flank::Coast, DEPTH, 7) {
        let (here, there) = (loads(&mesh, [q, x]), loads(&mesh, [q, x + 5.0 * pair.base_pitch]));
        assert_eq!(here.len(), there.len());
        for (a, b) in here.iter().zip(&there) {
            assert_eq!(b.number - a.number, 5, "coast pairs are counted against the planet's travel");
            assert!((a.depth - b.depth).abs() < 1e-13 && (a.s - b.s).abs() < 1e-13);
        }
    }
}

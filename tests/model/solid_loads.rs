//! Loads of single sections of solid teeth, aligned and displaced. They derive from the energy, balance the torques,
//! and have the positions that a calculation by slices gives.

use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::errors::ToothErrorSpec;
use bevel_differential::contact::impact::Impact;
use bevel_differential::contact::mesh::MeshState;
use bevel_differential::contact::pairs::Flank;
use bevel_differential::contact::solid::loads::SolidLoad;
use bevel_differential::contact::solid::mesh::{SolidMesh, SolidSlice, SolidSpec};
use bevel_differential::contact::solid::pose::Displacement;
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::model::{GearContact, Inputs, Parameters, PlanetSpin, Simulation, Start, ToothLoad};

const IMPACT: Impact = Impact { stiffness: 1.82463e10, exponent: 1.5, damping: 0.0, per_full_depth: 1e4 };
const DAMPING: Damping = Damping::Step { coefficient: 0.0, per_full_depth: 1e4 };
/// Number of sections across the face. The midpoint rule is accurate enough with this number.
const SECTIONS: usize = 20;
/// Tolerated deviation as a fraction of the force. A section reports its force along the mean normal of its patch,
/// which is not exact if a tip corner is loaded.
const ROUGH: f64 = 0.01;

fn pair() -> Pair {
    Pair::new(&GearSpec::default())
}

fn mesh(pair: &Pair, crowning: f64, displaced: Displacement) -> SolidMesh {
    let width = (pair.outer_cone - pair.inner_cone) / SECTIONS as f64;
    let slice = |i: usize| {
        let cone = pair.inner_cone + width * (i as f64 + 0.5);
        let x = (cone - pair.mean_cone) / (0.5 * (pair.outer_cone - pair.inner_cone));
        let share = cone / (SECTIONS as f64 * pair.mean_cone);
        SolidSlice { cone, share, width, relief: crowning * x * x }
    };
    let spec = SolidSpec {
        fillet: 0.4 * pair.module / pair.outer_cone,
        facets: 64,
        smoothing: 1.0,
        slices: (0..SECTIONS).map(slice).collect(),
        displaced: vec![[displaced; 2]],
    };
    SolidMesh::new(pair, &spec, IMPACT, DAMPING, 1e-3)
}

/// Mesh position in which a tooth pair is at position `s`, and all pairs are pressed together by `approach` [m] at the
/// mean cone distance.
fn position(pair: &Pair, flank: Flank, s: f64, approach: f64) -> [f64; 2] {
    let sign = if flank == Flank::Drive { 1.0 } else { -1.0 };
    [-sign * (approach / pair.mean_cone + pair.normal_backlash / 2.0), sign * (s - pair.centred_position())]
}

fn loads(mesh: &SolidMesh, position: [f64; 2]) -> Vec<SolidLoad> {
    let mut all = Vec::new();
    mesh.loaded(&MeshState { position, ..Default::default() }, |load| all.push(*load));
    all
}

fn displacements() -> [Displacement; 5] {
    let none = Displacement::default();
    [
        none,
        Displacement { along: [8e-5, 0.0], ..none },
        Displacement { along: [0.0, -8e-5], ..none },
        Displacement { across: 8e-5, ..none },
        Displacement { lean: 2e-3, along: [-3e-5, 4e-5], across: -4e-5 },
    ]
}

#[test]
fn forces_of_the_sections_are_the_gradient_of_the_energy() {
    let pair = pair();
    let h = 1e-7;
    for displaced in displacements() {
        for flank in [Flank::Drive, Flank::Coast] {
            for s in [-0.15, -0.05, 0.0, 0.08] {
                let at = position(&pair, flank, s, 9e-5);
                let all = loads(&mesh(&pair, 1e-5, displaced), at);
                assert!(!all.is_empty());
                let slope = |move_by: &dyn Fn(f64) -> Displacement| {
                    let energy = |by: f64| mesh(&pair, 1e-5, move_by(by)).energy([0, 0], at);
                    (energy(h) - energy(-h)) / (2.0 * h)
                };
                let sum = |of: &dyn Fn(&SolidLoad) -> f64| all.iter().map(|l| l.force.total * of(l)).sum::<f64>();
                let whole = sum(&|_| 1.0);
                for gear in 0..2 {
                    let by_energy = slope(&|by| {
                        let mut moved = displaced;
                        moved.along[gear] += by;
                        moved
                    });
                    let by_forces = sum(&|l| l.normal[gear]);
                    assert!((by_energy - by_forces).abs() < ROUGH * whole, "{displaced:?} {flank:?} {s} along {gear}");
                }
                let by_energy = slope(&|by| Displacement { across: displaced.across + by, ..displaced });
                let by_forces = sum(&|l| l.normal[2]);
                assert!((by_energy - by_forces).abs() < ROUGH * whole, "{displaced:?} {flank:?} {s} across");
            }
        }
    }
}

#[test]
fn torques_of_the_sections_about_both_axes_are_those_of_the_mesh() {
    let pair = pair();
    let [planet_lever, side_lever] = pair.sin_base();
    for displaced in displacements().into_iter().filter(|d| d.lean == 0.0) {
        for s in [-0.15, -0.05, 0.0, 0.08] {
            let at = position(&pair, Flank::Drive, s, 9e-5);
            let mesh = mesh(&pair, 1e-5, displaced);
            // the axes are at right angles: the components are along the planet's axis, along the side gear's axis, and
            // across
            let (mut on_planet, mut on_side) = (0.0, 0.0);
            for load in loads(&mesh, at) {
                let [n_planet, n_side, n_across] = load.normal.map(|n| n * load.force.total);
                let point = load.point.map(|p| p * load.slice.cone);
                on_side -= point[2] * n_planet - point[0] * n_across;
                let [side, across] = [point[1] - displaced.along[1], point[2] - displaced.across];
                on_planet -= side * n_across - across * n_side;
            }
            let force = mesh.force(&MeshState { position: at, ..Default::default() }).force;
            let wanted = [on_side / side_lever, on_planet / planet_lever + on_side / side_lever];
            let scale = force[0].abs();
            assert!((force[0] - wanted[0]).abs() < ROUGH * scale, "{displaced:?} {s}: {force:?} {wanted:?}");
            assert!((force[1] - wanted[1]).abs() < ROUGH * scale, "{displaced:?} {s}: {force:?} {wanted:?}");
        }
    }
}

/// Distance of the load centroid from mid-face [m] and total force [N] of slices under the `approach` [m]. `gap`
/// returns the first-order gap [m] at a cone distance [m].
fn slices(pair: &Pair, approach: f64, gap: impl Fn(f64) -> f64) -> [f64; 2] {
    let (mean, face) = (pair.mean_cone, pair.outer_cone - pair.inner_cone);
    let (mut force, mut moment) = (0.0, 0.0);
    for i in 0..SECTIONS {
        let cone = pair.inner_cone + face * (i as f64 + 0.5) / SECTIONS as f64;
        let depth: f64 = approach - mean * gap(cone) / cone;
        let f = IMPACT.stiffness * depth.max(0.0).powf(1.5) / SECTIONS as f64;
        force += f;
        moment += f * (cone - mean);
    }
    [moment / force, force]
}

/// Distance of the load centroid from mid-face [m] and total force [N] of sections of solid teeth.
fn solids(pair: &Pair, all: &[SolidLoad]) -> [f64; 2] {
    let force: f64 = all.iter().map(|l| l.force.total).sum();
    [all.iter().map(|l| l.force.total * (l.slice.cone - pair.mean_cone)).sum::<f64>() / force, force]
}

/// Approach at which `force` equals `target`.
fn solved(target: f64, force: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 5e-4);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if force(middle) < target { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[test]
fn the_load_shifts_by_the_amount_of_the_first_order_gap() {
    let pair = pair();
    let (alpha, [planet, side]) = (pair.pressure_angle, pair.gears.map(|g| g.pitch));
    let none = Displacement::default();
    // gaps at the pitch point if a planet moves outward or forward, or if a side gear moves outward
    // (src/contact/errors/misalignment.rs); +1 if the heel is loaded
    let by = 8e-5;
    let outward = by * alpha.sin() * planet.sin();
    let side_outward = by * alpha.sin() * side.sin();
    let forward = by * alpha.cos();
    for (displaced, flank, gap, sense) in [
        (Displacement { along: [by, 0.0], ..none }, Flank::Drive, outward, 1.0),
        (Displacement { along: [by, 0.0], ..none }, Flank::Coast, outward, 1.0),
        (Displacement { along: [-by, 0.0], ..none }, Flank::Drive, -outward, -1.0),
        (Displacement { along: [0.0, -by], ..none }, Flank::Drive, side_outward, 1.0),
        (Displacement { along: [0.0, by], ..none }, Flank::Coast, -side_outward, -1.0),
        (Displacement { across: by, ..none }, Flank::Drive, -forward, -1.0),
        (Displacement { across: by, ..none }, Flank::Coast, forward, 1.0),
        (Displacement { across: -by, ..none }, Flank::Drive, forward, 1.0),
        (Displacement { across: -by, ..none }, Flank::Coast, -forward, -1.0),
    ] {
        let mesh = mesh(&pair, 0.0, displaced);
        for target in [6e3, 16e3] {
            let one = |approach: f64| -> Vec<SolidLoad> {
                let all = loads(&mesh, position(&pair, flank, 0.0, approach));
                all.into_iter().filter(|l| l.s.abs() < 1e-9).collect()
            };
            let all = one(solved(target, |a| solids(&pair, &one(a))[1]));
            let [found, _] = solids(&pair, &all);
            let a = solved(target, |a| slices(&pair, a, |_| gap)[1]);
            let [wanted, _] = slices(&pair, a, |_| gap);
            assert!(all.iter().all(|l| l.flank == flank));
            assert!(found * sense > 1e-4, "{displaced:?} {flank:?}: {found}");
            assert!((found - wanted).abs() < 0.03 * wanted.abs() + 2e-5, "{displaced:?} {flank:?}: {found} {wanted}");
        }
    }
}

#[test]
fn crowning_barely_moves_the_centroid_and_takes_load_from_the_ends() {
    let pair = pair();
    let mesh = mesh(&pair, 2e-5, Displacement::default());
    let all = loads(&mesh, position(&pair, Flank::Drive, 0.0, 9e-5));
    let one: Vec<&SolidLoad> = all.iter().filter(|l| l.s.abs() < 1e-9).collect();
    assert_eq!(one.len(), SECTIONS);
    let line = |i: usize| one[i].force.total / one[i].slice.width;
    let half = 0.5 * (pair.outer_cone - pair.inner_cone);
    let [found, _] = solids(&pair, &all);
    let [wanted, _] = slices(&pair, 9e-5, |cone| 2e-5 * ((cone - pair.mean_cone) / half).powi(2));
    // the approach is proportional to the cone distance R, so equal gaps relieve the toe more than the heel, and a
    // little load moves to the heel
    assert!((found - wanted).abs() < 2e-5, "{found} {wanted}");
    assert!(found > 0.0 && found < 0.03 * half, "{found}");
    assert!(line(0) < 0.75 * line(SECTIONS / 2) && line(SECTIONS - 1) < 0.85 * line(SECTIONS / 2));
}

#[test]
fn a_shaft_angle_error_leaves_the_load_even_and_moves_contact_to_the_common_tangent_of_both_base_circles() {
    let pair = pair();
    let base = pair.gears.map(|g| g.base);
    for lean in [-3e-3, 0.0, 3e-3] {
        let mesh = mesh(&pair, 0.0, Displacement { lean, ..Default::default() });
        // great circle tangent to both base circles, whose axes now have the angle Σ + δΣ
        let length = (((pair.shaft_angle + lean).cos() + base[0].sin() * base[1].sin())
            / (base[0].cos() * base[1].cos()))
        .acos();
        if lean == 0.0 {
            assert!((length - pair.line_of_action()).abs() < 1e-12);
        }
        // approach without the gap R sinα δΣ
        let approach = 8e-5 + pair.mean_cone * pair.pressure_angle.sin() * lean;
        let all = loads(&mesh, position(&pair, Flank::Drive, 0.0, approach));
        let one: Vec<&SolidLoad> = all.iter().filter(|l| l.s.abs() < 1e-9).collect();
        assert_eq!(one.len(), SECTIONS);
        let line: Vec<f64> = one.iter().map(|l| l.force.total / l.slice.width).collect();
        for (load, w) in one.iter().zip(&line) {
            assert!((w / line[0] - 1.0).abs() < 1e-9, "{lean}: {w} {}", line[0]);
            let arcs: f64 = (0..2).map(|i| pair.gears[i].action_arc(load.polar[i])).sum();
            // the tolerance allows for the overlap of 80 µm and for the mean position over a patch of several facets
            assert!((arcs - length).abs() < 1e-3, "{lean}: {arcs} {length}");
        }
        let force: f64 = one.iter().map(|l| l.force.total).sum();
        let aligned = IMPACT.stiffness * 8e-5f64.powf(1.5);
        assert!((force / aligned - 1.0).abs() < 0.03, "{lean}: {force} {aligned}");
    }
}

/// Turn with solid teeth and the tooth errors `errors`, 0.02 s after a start in equilibrium. The planets spin at `spin`
/// and the carrier rotates at `carrier` [rad/s]; `load` is the load torque of both sides [N·m].
fn turn(errors: ToothErrorSpec, spin: f64, carrier: f64, load: [f64; 2]) -> Simulation {
    let mut p = Parameters::default();
    p.scene.gear_contact = GearContact::Solid;
    p.scene.planet_spin = PlanetSpin::Imposed;
    p.scene.start = Start::Equilibrium;
    p.solver.merge_planets = false;
    p.solid.facets = 64;
    p.effects.tooth_errors = true;
    p.specs.tooth_errors = errors;
    let inputs = Inputs { planet_spin: spin, carrier_speed: carrier, load_torque: load, ..Inputs::default() };
    let mut simulation = Simulation::start(&p, &inputs, 0.0).expect("a scene");
    simulation.advance(0.02).expect("a step");
    simulation
}

fn shown(simulation: &Simulation, side: usize) -> Vec<ToothLoad> {
    let mut all = Vec::new();
    simulation.tooth_loads(|load| {
        if load.side == side {
            all.push(*load);
        }
    });
    all
}

fn assert_alike(one: &[ToothLoad], other: &[ToothLoad], flanks_differ: bool, sense: f64) {
    assert!(one.len() == other.len() && one.len() > 8, "{} {}", one.len(), other.len());
    let touches = |l: &ToothLoad| l.touch.expect("solid teeth");
    for a in one {
        let b = other
            .iter()
            .find(|b| b.planet == a.planet && b.cone == a.cone && (b.s - a.s).abs() < 1e-6)
            .expect("a section like it");
        assert_eq!(a.flank != b.flank, flanks_differ);
        assert!((a.normal - b.normal).abs() < 1e-4 * a.normal + 1.0, "{} {}", a.normal, b.normal);
        for (x, y) in touches(a).polar.iter().zip(touches(b).polar) {
            assert!((x - y).abs() < 1e-6, "{x} {y}");
        }
        for (i, (x, y)) in a.components.iter().zip(b.components).enumerate() {
            let y = if i == 2 { sense * y } else { y };
            assert!((x - y).abs() < 1e-6, "{i}: {x} {y}");
        }
    }
}

#[test]
fn mirrored_scenes_have_mirrored_loads() {
    let errors = ToothErrorSpec {
        crowning: 1e-5,
        shaft_angle_error: 1.5e-3,
        planet_axial_offset: 4e-5,
        side_axial_offset: -3e-5,
        axis_offset: 5e-5,
        ..ToothErrorSpec::default()
    };
    let (spin, carrier) = (200f64.to_radians(), 954f64.to_radians());
    let scene = turn(errors, spin, carrier, [835.0, 700.0]);
    // mirror plane between the side gears: left is right, planets spin and lean the other way
    let swapped = ToothErrorSpec { shaft_angle_error: -errors.shaft_angle_error, ..errors };
    let swapped = turn(swapped, -spin, carrier, [700.0, 835.0]);
    for side in 0..2 {
        assert_alike(&shown(&scene, side), &shown(&swapped, 1 - side), false, 1.0);
    }
    // mirror plane through the axes of the side gears and of planet 0: forward is backward, drive is coast
    let turned = ToothErrorSpec { axis_offset: -errors.axis_offset, ..errors };
    let turned = turn(turned, -spin, -carrier, [-835.0, -700.0]);
    for side in 0..2 {
        assert_alike(&shown(&scene, side), &shown(&turned, side), true, -1.0);
    }
}

#[test]
fn sections_of_all_planets_carry_the_side_gears_torque() {
    let errors = ToothErrorSpec { planet_axial_offset: 5e-5, axis_offset: 5e-5, ..ToothErrorSpec::default() };
    for errors in [ToothErrorSpec::default(), errors] {
        let mut simulation = turn(errors, 200f64.to_radians(), 954f64.to_radians(), [835.0; 2]);
        let (pair, tangential) = (*simulation.pair(), simulation.forces().side_tangential);
        for side in 0..2 {
            let wanted = tangential[side] * 0.5 * pair.outer_pitch_diameter(1);
            let torque: f64 = shown(&simulation, side)
                .iter()
                .map(|l| {
                    let [point, [planet, _, across]] = [l.touch.expect("solid teeth").point, l.components];
                    // the component along the planet's axis is reported as it acts on the planet
                    l.cone * (point[0] * across + point[2] * planet) * l.normal
                })
                .sum();
            assert!((torque.abs() / wanted.abs() - 1.0).abs() < ROUGH, "side {side}: {torque} {wanted}");
        }
    }
}

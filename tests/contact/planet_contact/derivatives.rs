//! Under every kind of contact, forces are the gradient of the energy, are continuous, and have the stated derivatives.

use bevel_differential::contact::damping::Damping;

use super::kinds::{Contact, Face, Planet, READINGS, Teeth};
use super::points::{for_each_point, those};
use crate::mesh_laws::{Kind, PER_FULL_DEPTH, UNDAMPED};

#[test]
fn forces_at_rest_are_minus_the_gradient_of_the_energy() {
    let mut counts = [0; 5];
    for_each_point(1, 20, those(|_| true), |planet, at| {
        let (contact, mut tested) = (&planet.contact, false);
        for side in 0..2 {
            // with a stiff planet, the energy of the other mesh would only add rounding errors
            let at = if contact.is_elastic { at.at_rest() } else { at.at_rest().only(side) };
            let coordinates = planet.coordinates(3 * side..3 * side + 3);
            let scale = planet.scale(&at);
            let Some((h, pattern)) = planet.smooth_steps(&at, 1e-3, &coordinates).filter(|_| scale > 0.0) else {
                continue;
            };
            (tested, _) = (true, pattern.count(&mut counts));
            assert_eq!(planet.energy_gained(&at, &at), 0.0);
            // twelve points over a partly loaded face compute force and energy of a logarithmic law to 1e-8 each, and
            // own arcs on elastic bodies are solved to rounding of the deepest arc
            let is_summed = contact.law == Kind::LineWeber && pattern.is_partly_loaded();
            let limit = if is_summed || contact.is_elastic { 3e-8 } else { 1e-8 };
            for i in coordinates {
                let force = planet.forces(&at).readings[side][i % 3];
                let [gradient] = at.difference(i, h[i], |to| [planet.energy_gained(&at, to)]);
                let off = (force + gradient).abs() * planet.unit(i) / scale;
                assert!(off < limit, "by {i}: {force} {gradient} off {off:e}");
            }
        }
        tested
    });
    assert!(counts[..4].iter().all(|&n| n > 500), "{counts:?}");
}

/// Checks that the stiffness of a contact without damping and friction is symmetric.
fn check_symmetry(planet: &Planet, by: &[[[f64; 12]; READINGS]; 2]) {
    let entry = |i: usize, j: usize| by[i / 3][i % 3][j] * planet.unit(i) * planet.unit(j);
    let largest = (0..36).map(|k| entry(k / 6, k % 6).abs()).fold(0.0, f64::max);
    for (i, j) in (0..36).map(|k| (k / 6, k % 6)) {
        let (a, b) = (entry(i, j), entry(j, i));
        let limit = match planet.contact {
            // the same product in both orders
            Contact { face: Face::Plain, is_elastic: false, .. } => 1e-14 * a.abs(),
            // twelve points over a partly loaded face integrate a logarithmic law to 1e-8
            Contact { face: Face::Distributed, law: Kind::LineWeber, .. } => 1e-8 * largest,
            _ => 1e-12 * largest,
        };
        assert!((a - b).abs() <= limit, "{i} {j}: {a} {b}");
    }
}

/// True if damping is a step, which is not a polynomial over the face.
fn is_step(contact: &Contact) -> bool {
    matches!(contact.damping, Damping::Step { coefficient, .. } if coefficient > 0.0)
}

/// Largest error of a derivative relative to the largest derivative of its mesh with respect to positions or rates.
fn slope_limit(contact: &Contact, is_partly_loaded: bool) -> f64 {
    if !(is_partly_loaded && contact.law == Kind::Line && is_step(contact)) {
        // rounding error ε F/(h F′) ~ 1e-12, which grows if forces nearly cancel
        return 1e-6;
    }
    // Four points over a partly loaded face are exact for a linear law, so its derivatives omit the motion of the
    // points. The step of damping, and friction that depends on the damped load, are not polynomials over the face. If
    // crowning exceeds the depth of full damping, the step even has its bend on the face, and four points integrate its
    // damping only to one hundredth.
    let has_bend = matches!(contact.teeth, Teeth::Made(spec, _) if spec.crowning * PER_FULL_DEPTH > 1.0);
    if has_bend { 1e-2 } else { 3e-4 }
}

#[test]
fn derivatives_match_the_forces_and_are_symmetric_without_dissipation() {
    let (mut counts, mut across) = ([0; 5], 0);
    for_each_point(2, 40, those(|_| true), |planet, at| {
        let (forces, slopes) = planet.linearised(at);
        assert_eq!(forces, planet.forces(at));
        let energy = planet.energy(at);
        // arcs of flanks that barely touch are dominated by rounding
        assert!((slopes.energy - energy).abs() <= 1e-10 * energy.max(1e-6), "{} {energy}", slopes.energy);
        let contact = &planet.contact;
        if contact.damping == UNDAMPED && contact.friction.is_none() {
            check_symmetry(planet, &slopes.by);
            across += usize::from(slopes.by[0][0][3] != 0.0);
        }
        let coordinates = planet.coordinates(0..12);
        let Some((h, pattern)) = planet.smooth_steps(at, 1e-4, &coordinates) else { return false };
        pattern.count(&mut counts);
        let limit = slope_limit(contact, pattern.is_partly_loaded());
        let unit = |row: usize| if row < 2 { 1.0 / planet.cone() } else { 1.0 };
        for i in coordinates {
            let found: [f64; 2 * READINGS] = at.difference(i, h[i], |at| {
                let readings = planet.forces(at).readings;
                std::array::from_fn(|n| readings[n / READINGS][n % READINGS])
            });
            for (n, found) in found.into_iter().enumerate() {
                let (side, row) = (n / READINGS, n % READINGS);
                let (by, own) = (&slopes.by[side], 3 * side + i / 6 * 6);
                let sizes = (0..3 * READINGS).map(|k| (by[k / 3][own + k % 3] * unit(k / 3) * planet.unit(k)).abs());
                let (scale, exact) = (sizes.fold(1e-30, f64::max), by[row][i]);
                let off = (found - exact).abs() * unit(row) * planet.unit(i) / scale;
                // a stiff planet has no terms of its other mesh
                assert!(found == exact || off < limit, "side {side} row {row} by {i}: {exact} {found} off {off:e}");
            }
        }
        true
    });
    assert!(counts.iter().all(|&n| n > 500) && across > 1000, "{counts:?} {across}");
}

#[test]
fn forces_and_energy_do_not_jump_while_teeth_come_into_contact_pass_their_corners_and_leave() {
    const STEPS: usize = 100;
    let mut switches = 0;
    for_each_point(4, 2, those(|of| of.has_corners), |planet, at| {
        let start = planet.joined(*at);
        // the planet turns up the path on the left, down on the right
        let at = |x: f64| start.moved(1, x).moved(4, -x);
        let pattern = |x: f64| planet.pattern(&at(x)).points;
        let place = |k: usize| planet.gears.pair.base_pitch * k as f64 / STEPS as f64;
        // strong damping may leave no force at all
        let scale = (0..STEPS).map(|k| planet.scale(&at(place(k)).at_rest())).fold(0.0, f64::max);
        // the sums switch between eight and twelve points over a face; on a broken tooth they integrate a logarithmic
        // law to 1e-8, and a step of damping with its bend on the face to 1e-6
        let limit = match planet.contact {
            Contact { law: Kind::LineWeber, face: Face::Distributed, .. } if is_step(&planet.contact) => 1e-6,
            Contact { law: Kind::LineWeber, teeth: Teeth::Made(_, [_, depth]), .. } if depth > 0.0 => 1e-8,
            _ => 1e-9,
        };
        let mut next = pattern(0.0);
        for k in 0..STEPS {
            let (mut before, mut after) = (place(k), place(k + 1));
            let here = std::mem::replace(&mut next, pattern(after));
            if here == next {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (before + after);
                if pattern(middle) == here { before = middle } else { after = middle }
            }
            switches += 1;
            let [a, b] = [before, after].map(|x| (planet.forces(&at(x)).readings, planet.energy(&at(x))));
            for i in 0..6 {
                let jump = (a.0[i / 3][i % 3] - b.0[i / 3][i % 3]).abs() * planet.unit(i);
                assert!(jump <= limit * scale, "{i} jumps by {jump:e} of {scale:e} at x {before}");
            }
            // together with continuous energy, forces are the gradient of the energy also across switches
            assert!((a.1 - b.1).abs() <= 1e-9 * a.1.max(1e-3 * scale), "energy jumps at x {before}: {} {}", a.1, b.1);
        }
        true
    });
    assert!(switches > 4000, "{switches}");
}

//! Damping and friction only dissipate, and the power that they take from the motion becomes heat.

use bevel_differential::contact::Flank;

use super::kinds::{At, Contact, Face, Planet, READINGS, coulomb};
use super::points::{for_each_point, those};
use crate::mesh_explicit::V3;
use crate::mesh_laws::{Kind, UNDAMPED};

/// Power of forces with these `readings` at the rates of `at` [W].
fn power(readings: &[[f64; READINGS]; 2], at: &At) -> f64 {
    (0..6).map(|i| readings[i / 3][i % 3] * at.rate[i / 3][i % 3]).sum()
}

#[test]
fn power_of_the_forces_plus_heat_equals_the_loss_of_energy() {
    let mut hot = [0; 2];
    for_each_point(11, 40, those(|_| true), |planet, at| {
        let (forces, resting) = (planet.forces(at), planet.forces(&at.at_rest()));
        assert!(forces.heat.as_flattened().iter().all(|heat| *heat >= 0.0), "heat is negative");
        let [contact, friction] = [0, 1].map(|i| forces.heat[0][i] + forces.heat[1][i]);
        hot = [hot[0] + usize::from(contact > 0.0), hot[1] + usize::from(friction > 0.0)];
        // forces at rest are minus the gradient of the energy
        let off = (power(&forces.readings, at) + contact + friction - power(&resting.readings, at)).abs();
        let scale = planet.scale(at) + planet.scale(&at.at_rest());
        assert!(off <= 1e-8 * scale, "off {off:e} of {scale:e}");
        true
    });
    assert!(hot.iter().all(|&n| n > 4000), "{hot:?}");
}

#[test]
fn friction_opposes_the_sliding_of_flanks_that_turn_in_space_with_its_moment_arms_and_its_power_becomes_heat() {
    const MU: f64 = 0.07;
    let mut seen = [0; 3];
    let wanted = |of: &Contact| of.face == Face::Plain && of.law != Kind::Lumped && of.damping == UNDAMPED;
    for_each_point(12, 2000, those(|of| wanted(of) && !of.is_elastic && of.has_corners), |planet, at| {
        let whole = Contact { face: Face::Whole, ..planet.contact };
        let smooth = Planet::new(whole, &planet.gears);
        let rough = Planet::new(Contact { friction: coulomb(MU, 1e-9), ..whole }, &planet.gears);
        let (at, pair) = (at.only(0), &planet.gears.pair);
        // Directions to the pitch point of a right-angled pair and, along the line of action, toward the planet's tip.
        // The line is inclined by α to the direction of motion, away from the planet's axis.
        let (delta, axes) = (pair.gears[0].pitch, [V3::z(), V3::x()]);
        let start = V3::new(delta.sin(), 0.0, delta.cos());
        let outward = V3::new(delta.cos(), 0.0, -delta.sin());
        let tangent = V3::y() * pair.pressure_angle.cos() + outward * pair.pressure_angle.sin();
        let along_profile = start.cross(&tangent);
        // away from the planet's axis
        let tip_ward = along_profile * -(along_profile.dot(&axes[0])).signum();
        let ([p, q], [dq, dx, _]) = (pair.sin_base(), at.rate[0]);
        let speeds = [dx / p, (dq + dx) / q];
        let (mut torques, mut heat, mut scale, mut slowest) = ([0.0; 2], 0.0, 0.0f64, f64::INFINITY);
        rough.loaded(&at, |point, _| {
            // On the drive flank, the planet's tooth moves against the line of action, and its tip is in the direction
            // of this line. The coast flank is the mirror image.
            let sign = if point.flank == Flank::Coast { 1.0 } else { -1.0 };
            let contact = (start * point.s.cos() + tangent * point.s.sin()) * point.cone;
            // travel along the tangent is positive rotation about the planet's axis, negative about the side gear's
            // axis
            let ways = [axes[0] * -sign, axes[1] * sign];
            let sliding = (ways[0] * speeds[0] - ways[1] * speeds[1]).cross(&contact).dot(&tip_ward);
            slowest = slowest.min(sliding.abs());
            // the force on the planet along the profile, its reaction on the side gear
            let force = -MU * point.normal * sliding.signum();
            for (i, reaction) in [1.0, -1.0].into_iter().enumerate() {
                torques[i] += reaction * force * ways[i].cross(&contact).dot(&tip_ward);
            }
            heat -= force * sliding;
            scale += MU * point.normal * point.cone;
            if sliding.abs() > 1e-3 {
                assert!((-point.friction - force).abs() < 1e-6 * MU * point.normal, "{} {force}", point.friction);
                seen[point.spot as usize] += 1;
            }
        });
        if slowest < 1e-3 || scale == 0.0 {
            return false;
        }
        let (with, without) = (rough.forces(&at), smooth.forces(&at));
        let [q_added, x_added] = [0, 1].map(|i| with.readings[0][i] - without.readings[0][i]);
        for (found, torque) in [(p * (x_added - q_added), torques[0]), (q * q_added, torques[1])] {
            assert!((found - torque).abs() < 1e-9 * scale, "{found} N·m for {torque}");
        }
        assert!((with.heat[0][1] - heat).abs() < 1e-9 * scale && heat > 0.0, "{} W for {heat}", with.heat[0][1]);
        assert_eq!((&with.readings[0][3..], with.heat[0][0]), (&without.readings[0][3..], without.heat[0][0]));
        true
    });
    assert!(seen.iter().all(|&n| n > 200), "{seen:?}");
}

//! Friction along the flanks: power, direction and moment arms of sliding in space.

use bevel_differential::contact::detailed::DetailedState;
use bevel_differential::contact::pairs::{Flank, Spot};
use bevel_differential::geometry::Pair;
use fastrand::Rng;

use super::setup::{Both, STATES, coulomb, random_state};
use crate::mesh_explicit::V3;
use crate::mesh_laws::{GEARS, Kind, UNDAMPED};

/// Angular velocities [rad/s] of planet and side gear relative to the carrier that make the rates of q and x.
fn turning(pair: &Pair, state: &DetailedState) -> [f64; 2] {
    let [planet, side] = pair.sin_base();
    [state.rate[1] / planet, (state.rate[0] + state.rate[1]) / side]
}

#[test]
fn friction_dissipates_the_power_of_sliding_flanks() {
    const MU: f64 = 0.07;
    let (mut worst, mut shares) = (0.0f64, 0);
    for kind in [Kind::Impact, Kind::Line, Kind::LineWeber] {
        let mut random = Rng::with_seed(25);
        for of in GEARS {
            let plain = Both::new(of, kind, UNDAMPED);
            let rough = Both::made(of, kind, UNDAMPED, false, Some(coulomb(MU, 1e-9)));
            for _ in 0..STATES {
                let mut state = random_state(&mut random, &plain.pair, 0.0);
                // conjugate motion
                state.rate[0] = 0.0;
                let [planet, side] = turning(&plain.pair, &state);
                let relative = (planet * planet + side * side).sqrt();
                let (mut power, mut pairs, mut parts, mut slowest) = (0.0, 0, 0.0, f64::INFINITY);
                let with = rough.look(None, &state, |slice| {
                    let v = relative * slice.cone * slice.s.sin().abs();
                    slowest = slowest.min(v);
                    assert!(slice.friction.abs() <= MU * slice.normal);
                    power -= MU * slice.normal * v;
                    parts += slice.normal * relative * slice.cone;
                    pairs += 1;
                });
                let without = plain.load(None, &state);
                let added = [0, 1].map(|i| with.force[i] - without.force[i]);
                let found = added[0] * state.rate[0] + added[1] * state.rate[1];
                // friction changes its sign over 1e-9 m/s
                if slowest < 1e-4 {
                    continue;
                }
                let off = (found - power).abs() / parts;
                worst = worst.max(off);
                assert!(off < 1e-9, "{kind:?} {state:?}: {found} W for {power} W");
                assert!((with.heat[1] + found).abs() < 1e-9 * parts && with.heat[1] > 0.0);
                assert_eq!((with.normal, with.heat[0]), (without.normal, without.heat[0]));
                shares += pairs;
            }
        }
    }
    println!("worst {worst:e} of F |ω_rel| R, {shares} pairs");
}

/// The line of action of a right-angled pair: direction to the pitch point, unit tangent toward the planet's tip, and
/// the axes of planet and side gear. The line leans by α out of the direction of motion, toward the planet's tip away from
/// its axis.
fn line_of_action(pair: &Pair) -> (V3, V3, [V3; 2]) {
    let delta = pair.gears[0].pitch;
    let start = V3::new(delta.sin(), 0.0, delta.cos());
    let outward = V3::new(delta.cos(), 0.0, -delta.sin());
    let tangent = V3::y() * pair.pressure_angle.cos() + outward * pair.pressure_angle.sin();
    (start, tangent, [V3::z(), V3::x()])
}

#[test]
fn friction_opposes_the_sliding_of_flanks_that_turn_in_space_with_its_moment_arms() {
    const MU: f64 = 0.1;
    let (mut worst_arm, mut worst_power) = (0.0f64, 0.0f64);
    for of in GEARS {
        let plain = Both::new(of, Kind::Line, UNDAMPED);
        let pair = &plain.pair;
        let rough = Both::made(of, Kind::Line, UNDAMPED, false, Some(coulomb(MU, 1e-9)));
        let (start, tangent, axes) = line_of_action(pair);
        let mut random = Rng::with_seed(26);
        let mut seen = 0;
        for _ in 0..20 * STATES {
            let state = random_state(&mut random, pair, 0.0);
            let mut slices = Vec::new();
            let with = rough.look(None, &state, |slice| {
                // reported positive toward the planet's root
                let tip_ward = -slice.friction;
                slices.push((slice.s, slice.cone, slice.normal, tip_ward, slice.pair.spot, slice.pair.flank));
            });
            let [(s, r, normal, force, Spot::Path, flank)] = slices[..] else { continue };
            seen += 1;
            let without = plain.load(None, &state);
            let added = [0, 1].map(|i| with.force[i] - without.force[i]);
            // on the drive flank the planet's tooth moves against the line of action, toward which its tip is;
            // the coast flank is its mirror image
            let sign = if flank == Flank::Drive { -1.0 } else { 1.0 };
            let at = start * s.cos() + tangent * s.sin();
            let along_profile = start.cross(&tangent);
            // toward the planet's tip: away from its axis
            let tip_ward = along_profile * -(along_profile.dot(&axes[0])).signum();
            let [planet, side] = turning(pair, &state);
            // travel along the tangent is positive rotation about the planet's axis, negative about the side gear's
            let about = [axes[0] * (-sign * planet), axes[1] * (sign * side)];
            let sliding = (about[0] - about[1]).cross(&(at * r)).dot(&tip_ward);
            if sliding.abs() < 1e-3 {
                continue;
            }
            assert!(
                (force + MU * normal * sliding.signum()).abs() < 1e-6 * MU * normal,
                "{state:?}: {force} {sliding}"
            );
            // torques about the axes by the levers and by the vectors
            let [p, q] = pair.sin_base();
            let found = [p * (added[1] - added[0]), q * added[0]];
            let psi = [pair.pitch_arc[0] + s, pair.pitch_arc[1] - s];
            for i in 0..2 {
                let arm = r * pair.gears[i].base.cos() * psi[i].sin();
                let by_vectors = (at * r).cross(&tip_ward).dot(&axes[i]);
                assert!((arm - by_vectors.abs()).abs() < 1e-13, "{arm} {by_vectors}");
                let off = (found[i].abs() / (force.abs() * arm) - 1.0).abs();
                worst_arm = worst_arm.max(off);
                assert!(off < 1e-9, "gear {i} {state:?}: {} for {}", found[i], force * arm);
                // the force on the planet along the profile, its reaction on the side gear
                let power = force * if i == 0 { 1.0 } else { -1.0 } * about[i].cross(&(at * r)).dot(&tip_ward);
                let conjugate = found[i] * [planet, side][i];
                worst_power = worst_power.max((power - conjugate).abs() / (force.abs() * r));
                assert!((power - conjugate).abs() < 1e-9 * force.abs() * r, "gear {i}: {power} {conjugate}");
            }
        }
        assert!(seen > STATES, "{seen}");
    }
    println!("worst arm {worst_arm:e}, power {worst_power:e}");
}

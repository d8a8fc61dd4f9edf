//! Safety factors of roots and flanks: strength over the largest stress so far.

use crate::common::Host;
use bevel_differential::fmi2::Status;
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::strength::{Rating, ToothStrength};

const SAFETY: [&str; 2] = ["safety.root_min", "safety.flank_min"];
const TORQUE: f64 = 835.0;

fn safety(host: &Host) -> [f64; 2] {
    SAFETY.map(|name| host.get(name))
}

fn close(program: f64, expected: f64, relative: f64) {
    assert!((program / expected - 1.0).abs() <= relative, "program {program:e}, expected {expected:e}");
}

/// A host with strength enabled and `values` set, before its first step.
fn started(values: &[(&str, f64)], spin: bool) -> Host {
    let host = Host::new();
    assert_eq!(host.set_boolean("effects.strength", 1), Status::Ok);
    assert_eq!(host.set_integer("scene.planet_spin", if spin { 2 } else { 1 }), Status::Ok);
    for &(name, value) in values {
        assert_eq!(host.set(name, value), Status::Ok);
    }
    host.start();
    host
}

/// Rated stresses of root and flank under the torque on each side gear [Pa]: planet, side gear, flank.
fn rated(torque: f64) -> [f64; 3] {
    let pair = Pair::new(&GearSpec::default());
    let rating = Rating::new(&pair, (2.07e11, 0.25), &ToothStrength::default(), 0.25).expect("sound teeth");
    let force = torque / (2.0 * pair.mean_cone * pair.sin_base()[1]);
    [
        rating.root[0].stress(force),
        rating.root[1].stress(force),
        rating.contact.rated_pressure(force).expect("a pressure"),
    ]
}

#[test]
fn teeth_that_do_not_roll_have_the_full_strength_over_the_stress_of_their_load() {
    let host = started(&[], false);
    assert_eq!(safety(&host), [1e3; 2], "before the first step");
    host.steps(0.0, 1e-3, 5);
    let [_, _, flank] = rated(TORQUE);
    let [root_min, flank_min] = safety(&host);
    println!("S_F = {root_min:.4}, S_H = {flank_min:.4}");
    let [planet, side] = ["stress.root_planet_max", "stress.root_side_max"].map(|name| host.get(name));
    close(root_min, 1e9 / planet.max(side), 1e-6);
    close(flank_min, 1.5e9 / flank, 1e-6);
    // safety is proportional to strength
    let strong = started(&[("strength.bending_strength", 2e9), ("strength.contact_strength", 3e9)], false);
    strong.steps(0.0, 1e-3, 5);
    assert_eq!(safety(&strong), [2.0 * root_min, 2.0 * flank_min]);
    // safety does not increase under less load
    assert_eq!(host.set_many(&["left.load_torque", "right.load_torque"], &[100.0; 2]), Status::Ok);
    host.steps(5e-3, 1e-3, 20);
    assert!(safety(&host)[0] <= root_min && safety(&host)[0] > 0.9 * root_min, "{:?}", safety(&host));
}

#[test]
fn planets_that_roll_have_their_idler_strength_and_safety_only_falls() {
    // more than half a revolution, after which a tooth has met both side gears
    let host = started(&[("carrier.speed_command", 16.65), ("spin.command", 12.0)], true);
    let mut last = [1e3; 2];
    let (mut largest, mut most) = ([0.0f64; 2], f64::NEG_INFINITY);
    for k in 0..300 {
        host.steps(f64::from(k) * 1e-3, 1e-3, 1);
        let now = safety(&host);
        // the load at a point within a solver step counts only while the time is at this point
        let grown = (now[0] / last[0] - 1.0).max(now[1] / last[1] - 1.0);
        assert!(grown < 1e-4, "{last:?} {now:?}");
        most = most.max(grown);
        last = now;
        largest[0] = largest[0].max(host.get("stress.root_planet_max"));
        largest[1] = largest[1].max(host.get("stress.root_side_max"));
    }
    // recordings miss the highest peaks
    let recorded = 1.0 / (largest[0] / 0.7e9).max(largest[1] / 1e9);
    println!("S_F = {:.4}, recorded {recorded:.4}, grown by {most:e}", last[0]);
    assert!(last[0] < recorded * (1.0 + 1e-4) && last[0] > 0.97 * recorded, "{} {recorded}", last[0]);
}

#[test]
fn a_safety_below_one_is_a_stress_that_is_reported() {
    for (strength, below) in [(0.5e9, true), (1.5e9, false)] {
        let host = started(&[("strength.bending_strength", strength), ("strength.contact_strength", 1e11)], false);
        host.steps(0.0, 1e-3, 5);
        assert_eq!(safety(&host)[0] < 1.0, below);
        assert_eq!(host.log().iter().any(|line| line.message.contains("root stress")), below, "{:?}", host.log());
    }
}

#[test]
fn safety_is_0_if_strength_is_off() {
    let host = Host::new();
    host.start();
    host.steps(0.0, 1e-3, 3);
    assert_eq!(safety(&host), [0.0; 2]);
    assert_eq!(host.get("stress.root_planet_max"), 0.0);
}

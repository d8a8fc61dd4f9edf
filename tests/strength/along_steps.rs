//! Damage and largest stresses along steps, compared with integrals and oscillations in closed form.

use crate::common::{Host, assert_contains, reference};
use crate::textbook::root;
use bevel_differential::fmi2::{Status, fmi2SetRealInputDerivatives};
use bevel_differential::geometry::{GearSpec, Pair};
use bevel_differential::strength::{LoadCycle, Rating, ToothStrength, pulsating_range};
use std::f64::consts::TAU;

const LOADS: [&str; 2] = ["left.load_torque", "right.load_torque"];
const DAMAGES: [&str; 4] = ["damage.planet", "damage.side", "damage.planet_flank", "damage.side_flank"];
const METHODS: [(&str, i32); 3] = [("adaptive", 1), ("fixed_step", 2), ("radau", 3)];
const PLANETS: f64 = 2.0;
const SPIN: f64 = 20.0;

fn close(program: f64, expected: f64, relative: f64) {
    assert!((program / expected - 1.0).abs() <= relative, "program {program:e}, expected {expected:e}");
}

fn rating() -> Rating {
    let pair = Pair::new(&GearSpec::default());
    Rating::new(&pair, (2.07e11, 0.25), &ToothStrength::default(), 0.25).expect("sound teeth")
}

/// Normal force of a mesh under a torque on a side gear [N].
fn force(torque: f64) -> f64 {
    let pair = Pair::new(&GearSpec::default());
    torque / (PLANETS * pair.mean_cone * pair.sin_base()[1])
}

/// Normal force of a mesh [N] under a line law, whose load per length grows with the cone distance R. The resultant is
/// then at ∫R² dR / ∫R dR.
fn flank_force(torque: f64) -> f64 {
    let pair = Pair::new(&GearSpec::default());
    let [inner, outer] = [pair.inner_cone, pair.outer_cone];
    let cone = 2.0 / 3.0 * (outer.powi(3) - inner.powi(3)) / (outer.powi(2) - inner.powi(2));
    force(torque) * pair.mean_cone / cone
}

fn set_slopes(host: &Host, slope: f64) {
    let references = LOADS.map(reference);
    // SAFETY: a live component and arrays of two
    let status =
        unsafe { fmi2SetRealInputDerivatives(host.c, references.as_ptr(), 2, [1; 2].as_ptr(), [slope; 2].as_ptr()) };
    assert_eq!(status, Status::Ok, "{:?}", host.log());
}

/// Gears at level 2 (lumped) or 3 (tooth) with strength enabled, before their start in equilibrium.
fn host(level: i32, integers: &[(&str, i32)], values: &[(&str, f64)]) -> Host {
    let host = Host::new();
    assert_eq!(host.set_boolean("effects.strength", 1), Status::Ok);
    for &(name, value) in
        [("scene.gear_contact", level), ("scene.planet_spin", 2), ("scene.start", 1)].iter().chain(integers)
    {
        assert_eq!(host.set_integer(name, value), Status::Ok, "{name}");
    }
    for &(name, value) in values {
        assert_eq!(host.set(name, value), Status::Ok, "{name}");
    }
    host
}

/// Damage after one second at constant speed under loads that grow from `low` to `high` [N·m], in `steps` communication
/// steps.
fn ramp(level: i32, method: i32, sign: f64, [low, high]: [f64; 2], steps: usize) -> [f64; 4] {
    let integers = [("solver.method", method)];
    let values = [
        ("carrier.speed_command", 50.0 * sign),
        ("spin.command", SPIN * sign),
        (LOADS[0], low * sign),
        (LOADS[1], low * sign),
    ];
    let host = host(level, &integers, &values);
    set_slopes(&host, (high - low) * sign);
    host.start();
    let h = 1.0 / steps as f64;
    for i in 0..steps {
        set_slopes(&host, (high - low) * sign);
        host.steps(i as f64 * h, h, 1);
    }
    DAMAGES.map(|name| host.get(name))
}

/// Damage under loads that change from `low` to `high` [N·m] in a second in which the planets roll at `SPIN`, between
/// the times `from` and `until` [s], and the largest root stress of a pulsating cycle with the damage of a cycle [Pa].
/// Each tooth is followed through its meshes. A tooth has the load of its mesh over one pitch, and a tooth in mesh at
/// the start is loaded from the start. `on_flank` is the force that presses flanks.
fn followed([low, high]: [f64; 2], on_flank: fn(f64) -> f64, [from, until]: [f64; 2]) -> ([f64; 4], f64) {
    let (rating, pair, material) = (rating(), Pair::new(&GearSpec::default()), ToothStrength::default());
    let [z_p, z_s] = rating.teeth;
    let per_pitch = rating.pitch[0] / SPIN;
    let torque = |t: f64| low + (high - low) * t;
    let cycle = |t: f64| rating.pitting.damage_per_cycle(rating.contact.rated_pressure(on_flank(torque(t))).unwrap());
    let rated = (rating.contact.rated_position() - pair.centred_position()) / pair.base_pitch;
    // stress histories and flank damage of each tooth of a planet, and of a side gear
    let mut stress = [vec![vec![0.0]; z_p], vec![vec![0.0]; z_s]];
    let mut flanks = [vec![[0.0; 2]; z_p], vec![[0.0; 2]; z_s], vec![[0.0; 2]; z_s]];
    let last = (1.0 / per_pitch).ceil() as usize;
    for k in 0..=last {
        let begin = ((k as f64 - 0.5) * per_pitch).max(from);
        let end = ((k as f64 + 0.5) * per_pitch).min(until);
        let passes = [-1.0, 1.0].map(|way| (k as f64 + way * rated) * per_pitch);
        let passes = passes.map(|t| if t > from && t <= until { cycle(t) } else { 0.0 });
        flanks[0][k % z_p][0] += passes[0];
        flanks[0][(k + z_p / 2) % z_p][1] += passes[1];
        for side in 0..2 {
            (0..2).for_each(|planet| flanks[1 + side][(k + planet * z_s / 2) % z_s][0] += passes[side]);
        }
        if end <= begin {
            continue;
        }
        let loads = [0, 1].map(|gear| [begin, end].map(|t| rating.root[gear].stress(force(torque(t)))));
        let mut add = |gear: usize, tooth: usize, sign: f64| {
            let history = &mut stress[gear][tooth];
            // a tooth that is in mesh when the count begins has no load before
            if begin == from {
                history.clear();
            }
            history.extend(loads[gear].map(|stress| sign * stress));
            if end < until {
                history.push(0.0);
            }
        };
        add(0, k % z_p, 1.0);
        add(0, (k + z_p / 2) % z_p, -1.0);
        (0..2).for_each(|planet| add(1, (k + planet * z_s / 2) % z_s, 1.0));
    }
    let mut largest = 0.0f64;
    let roots = stress.map(|teeth| {
        teeth.iter().fold(0.0f64, |worst, history| {
            let (damage, stress) = root(history, &material);
            largest = largest.max(stress).max(history.iter().fold(0.0, |a: f64, b| a.max(b.abs())));
            worst.max(damage)
        })
    });
    let flanks = flanks.map(|teeth| teeth.into_iter().flatten().fold(0.0, f64::max));
    ([roots[0], roots[1], flanks[0], flanks[1].max(flanks[2])], largest)
}

#[test]
fn damage_of_a_load_ramp_is_that_of_its_teeth_in_one_step_and_in_millisecond_steps() {
    let range = [80.0, 835.0];
    let (expected, _) = followed(range, flank_force, [0.0, 1.0]);
    for (name, method) in METHODS {
        for steps in [1, 1000] {
            let found = ramp(2, method, 1.0, range, steps);
            let off: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a / b - 1.0).collect();
            println!("{name}, {steps} steps: {off:?}");
            for (found, expected) in found.into_iter().zip(expected) {
                // the loads are known up to the torque that accelerates the side gears
                close(found, expected, 3e-4);
            }
        }
    }
}

#[test]
fn the_mirrored_ramp_does_the_same_damage() {
    for level in [2, 3] {
        let range = [80.0, 835.0];
        let (one, mirrored) = (ramp(level, 1, 1.0, range, 1), ramp(level, 1, -1.0, range, 1));
        one.into_iter().zip(mirrored).for_each(|(a, b)| close(b, a, 1e-9));
    }
}

#[test]
fn damage_of_teeth_that_pass_does_not_depend_on_communication_steps() {
    // teeth enter and leave along the path, and the meshes vibrate
    let range = [300.0, 835.0];
    let (one, many) = (ramp(3, 1, 1.0, range, 1), ramp(3, 1, 1.0, range, 1000));
    println!("{one:?} {many:?}");
    one.into_iter().zip(many).for_each(|(a, b)| close(b, a, 1e-3));
    // the force equals the load torque over its arm, except for changes when teeth enter and leave; impact acts at the
    // mean cone
    let flanks = followed(range, force, [0.0, 1.0]).0;
    (2..4).for_each(|kind| close(one[kind], flanks[kind], 0.05));
}

/// Gears without rolling and damping, whose loads jump from `low` to `high` [N·m] at the start. They swing forever
/// between `low` and 2 `high` − `low`. Returns the host and the period of the oscillation [s].
fn swinging(method: i32, [low, high]: [f64; 2]) -> (Host, f64) {
    // spring constant from two loads
    let angle = |torque: f64| {
        let still = host(2, &[], &[("spin.command", 0.0), (LOADS[0], torque), (LOADS[1], torque)]);
        still.start();
        still.get("left.angle") - still.get("carrier.angle")
    };
    let stiffness = (high - low) / (angle(low) - angle(high));
    let inertia = 2e-3;
    let values = [
        ("contact.damping", 0.0),
        ("carrier.speed_command", 0.0),
        ("spin.command", 0.0),
        ("inertia.side_gear", inertia),
        ("inertia.left_end", 0.0),
        ("inertia.right_end", 0.0),
        (LOADS[0], low),
        (LOADS[1], low),
    ];
    let host = host(2, &[("solver.method", method)], &values);
    assert_eq!(host.set_boolean("inertia.from_geometry", 0), Status::Ok);
    host.start();
    assert_eq!(host.set_many(&LOADS, &[high; 2]), Status::Ok);
    (host, TAU * (inertia / stiffness).sqrt())
}

#[test]
fn teeth_that_do_not_roll_are_damaged_by_load_reversals_between_the_ends_of_steps() {
    let (rating, [low, high]) = (rating(), [300.0, 500.0]);
    let peak = 2.0 * high - low;
    let per_cycle = |gear: usize| {
        let stress = |torque: f64| rating.root[gear].stress(force(torque));
        let cycle = |sign: f64| LoadCycle { range: stress(peak - low), mean: sign * stress(high), count: 1.0 };
        [1.0, -1.0].map(|sign| {
            rating.bending.curve.damage_per_cycle(pulsating_range(&cycle(sign), rating.bending.sensitivity))
        })
    };
    for (name, method) in METHODS.into_iter().filter(|(_, method)| *method != 2) {
        for steps in [1, 100] {
            let (host, period) = swinging(method, [low, high]);
            // ends halfway between reversals
            let periods = 100.25;
            let h = periods * period / steps as f64;
            host.steps(0.0, h, steps);
            // half a cycle for each half of an oscillation; the last one has reached the middle
            let halves = (2.0 * periods).floor();
            for (gear, damage) in ["damage.planet", "damage.side"].into_iter().enumerate() {
                let [drive, coast] = per_cycle(gear);
                let expected = 0.5 * halves * drive.max(coast);
                println!("{name}, {steps} steps: {damage} {:+.1e} off", host.get(damage) / expected - 1.0);
                close(host.get(damage), expected, 2e-3);
            }
            // the largest stress is that of the highest peak
            let worst = (0..2).map(|gear| rating.root[gear].stress(force(peak))).fold(0.0, f64::max);
            close(host.get("safety.root_min"), rating.bending.curve.strength / worst, 2e-4);
            let pressure = rating.contact.rated_pressure(flank_force(peak)).unwrap();
            close(host.get("safety.flank_min"), rating.pitting.strength / pressure, 1e-4);
        }
    }
}

#[test]
fn ratings_start_at_their_time_and_omit_earlier_loads() {
    let range = [835.0, 535.0];
    let run = |from: f64, until: f64| {
        let values = [("carrier.speed_command", 50.0), ("spin.command", SPIN), ("strength.rate_from", from)];
        let host = host(2, &[], &values);
        host.start();
        set_slopes(&host, -300.0);
        host.steps(0.0, until, 1);
        let [damage, safety] = [DAMAGES.to_vec(), vec!["safety.root_min", "safety.flank_min"]];
        (
            damage.into_iter().map(|name| host.get(name)).collect::<Vec<_>>(),
            safety.into_iter().map(|name| host.get(name)).collect::<Vec<_>>(),
        )
    };
    for [from, until] in [[0.0, 1.0], [0.0, 0.4], [0.4, 1.0]] {
        let (damage, safety) = run(from, until);
        let (expected, largest) = followed(range, flank_force, [from, until]);
        damage.iter().zip(expected).for_each(|(&found, expected)| close(found, expected, 3e-4));
        close(safety[0], rating().bending.curve.strength / largest, 3e-4);
        let pressure = rating().contact.rated_pressure(flank_force(835.0 - 300.0 * from)).unwrap();
        close(safety[1], rating().pitting.strength / pressure, 3e-4);
    }
    let nothing = run(2.0, 1.0);
    assert_eq!((nothing.0, nothing.1), (vec![0.0; 4], vec![1e3; 2]));
}

#[test]
fn a_run_that_counts_a_start_out_of_equilibrium_reports_the_time_of_the_worst_stress() {
    // scene.start: equilibrium, rolling, rest
    for (start, from, strength, has_note) in
        [(3, 0.0, 1, true), (2, 0.0, 1, true), (1, 0.0, 1, false), (2, 0.05, 1, false), (2, 0.0, 0, false)]
    {
        let values = [("spin.command", 3.5), ("strength.rate_from", from)];
        let host = host(3, &[("scene.start", start)], &values);
        assert_eq!(host.set_boolean("effects.strength", strength), Status::Ok);
        host.start();
        host.steps(0.0, 0.1, 1);
        let safety = host.get("safety.root_min");
        let about =
            || host.log().into_iter().filter(|line| line.message.contains("strength.rate_from")).collect::<Vec<_>>();
        assert!(about().is_empty());
        assert_eq!(host.terminate(), Status::Ok);
        assert_eq!(about().len(), usize::from(has_note), "start {start}, from {from}: {:?}", host.log());
        if has_note {
            assert_contains(
                &about()[0].message,
                &["not in equilibrium", &format!("roots was {safety:.3} at t = 0.00")],
            );
        }
    }
}

#[test]
fn a_pulse_between_two_communication_points_is_counted() {
    // half a wave of load that is 0 at both ends of one step
    let host = host(2, &[], &[("spin.command", 0.0), (LOADS[0], 300.0), (LOADS[1], 300.0)]);
    set_slopes(&host, 0.0);
    host.start();
    let references = LOADS.map(reference);
    // T = 300 + 2000 t − 2000 t²
    for (order, value) in [(1, 2000.0), (2, -4000.0)] {
        // SAFETY: a live component and arrays of two
        let status = unsafe {
            fmi2SetRealInputDerivatives(host.c, references.as_ptr(), 2, [order; 2].as_ptr(), [value; 2].as_ptr())
        };
        assert_eq!(status, Status::Ok, "{:?}", host.log());
    }
    host.steps(0.0, 1.0, 1);
    let rating = rating();
    let worst = (0..2).map(|gear| rating.root[gear].stress(force(800.0))).fold(0.0, f64::max);
    close(host.get("safety.root_min"), rating.bending.curve.strength / worst, 1e-3);
    let cycle = |sign: f64, gear: usize| {
        let stress = |torque: f64| rating.root[gear].stress(force(torque));
        LoadCycle { range: stress(500.0), mean: sign * stress(550.0), count: 1.0 }
    };
    for (gear, damage) in ["damage.planet", "damage.side"].into_iter().enumerate() {
        let of = |sign: f64| {
            rating.bending.curve.damage_per_cycle(pulsating_range(&cycle(sign, gear), rating.bending.sensitivity))
        };
        close(host.get(damage), of(1.0).max(of(-1.0)), 2e-3);
    }
}

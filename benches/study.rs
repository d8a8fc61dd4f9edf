//! How much faster than real time the study's cases run, on one core, driven through the C functions of FMI as a host
//! drives them: communication steps of 1 ms, with and without reading ten outputs after each.

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::Instant;

use bevel_differential::fmi2::{Status, fmi2DoStep, fmi2GetReal};
use common::{Host, reference};

/// Simulated time of the study [s] and its communication step [s].
const LENGTH: f64 = 0.5;
const STEP: f64 = 1e-3;
/// Runs of each case; the median is what to quote.
const RUNS: usize = 41;

const OUTPUTS: [&str; 10] = [
    "carrier.speed",
    "left.speed",
    "right.speed",
    "carrier.torque",
    "left.tangential_force",
    "right.tangential_force",
    "planet[1].left_normal_force",
    "planet[1].right_normal_force",
    "planet[1].left_transmission_error",
    "solver.energy_residual",
];

struct Case {
    name: &'static str,
    level: i32,
    turning: bool,
}

fn prepared(case: &Case) -> Host {
    let host = Host::new();
    let mut done = vec![host.set_integer("scene.gear_contact", case.level), host.set_integer("scene.start", 2)];
    if case.turning {
        done.push(host.set_integer("scene.planet_spin", 2));
        done.push(host.set("carrier.speed_command", 954f64.to_radians()));
        done.push(host.set("spin.command", 200f64.to_radians()));
    }
    assert!(done.iter().all(|&status| status == Status::Ok), "{:?}", host.log());
    host.start();
    host
}

/// Wall time of the case [s] and its integrator steps.
fn run(case: &Case, outputs: &[u32]) -> (f64, f64) {
    let host = prepared(case);
    let mut values = [0.0; OUTPUTS.len()];
    let mut ok = true;
    let begin = Instant::now();
    for k in 0..(LENGTH / STEP).round() as u32 {
        // SAFETY: a live component and arrays of the given lengths
        unsafe {
            ok &= fmi2DoStep(host.c, f64::from(k) * STEP, STEP, 1) == Status::Ok;
            ok &= fmi2GetReal(host.c, outputs.as_ptr(), outputs.len(), values.as_mut_ptr()) == Status::Ok;
        }
    }
    let wall = begin.elapsed().as_secs_f64();
    assert!(ok, "{:?}", host.log());
    (wall, host.get("solver.steps"))
}

/// CPU-bound wall time of an hour straight ahead in communication steps of 0.1 s [s].
fn hour() -> f64 {
    let host = prepared(&Case { name: "an hour", level: 3, turning: false });
    let step = 0.1;
    let begin = Instant::now();
    for k in 0..36_000u32 {
        // SAFETY: a live component
        assert_eq!(unsafe { fmi2DoStep(host.c, f64::from(k) * step, step, 1) }, Status::Ok, "{:?}", host.log());
    }
    begin.elapsed().as_secs_f64()
}

fn main() {
    let ten: Vec<u32> = OUTPUTS.iter().map(|name| reference(name)).collect();
    let cases = [
        Case { name: "straight, tooth", level: 3, turning: false },
        Case { name: "turning, tooth", level: 3, turning: true },
        Case { name: "turning, solid", level: 4, turning: true },
        Case { name: "straight, ideal", level: 1, turning: false },
        Case { name: "turning, ideal", level: 1, turning: true },
    ];
    println!("{LENGTH} s simulated in communication steps of {STEP} s, {RUNS} runs each");
    println!(
        "{:<16} {:>7} {:>6}   times faster than real time: median (slowest - fastest)",
        "case", "outputs", "steps"
    );
    for case in &cases {
        for outputs in [&[][..], &ten] {
            let (mut walls, steps): (Vec<f64>, Vec<f64>) = (0..RUNS).map(|_| run(case, outputs)).unzip();
            walls.sort_by(f64::total_cmp);
            let speed = |i: usize| LENGTH / walls[i];
            println!(
                "{:<16} {:>7} {:>6}   {:>8.1} ({:.1} - {:.1})",
                case.name,
                outputs.len(),
                steps[0],
                speed(RUNS / 2),
                speed(RUNS - 1),
                speed(0)
            );
        }
    }
    println!("an hour straight ahead, tooth, communication steps of 0.1 s: {:.3} s", hour());
}

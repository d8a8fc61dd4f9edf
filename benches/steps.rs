//! Executes communication steps of a scene and prints the bits of the values that it reads. It serves to compare builds
//! without effects, and to count instructions.
//!
//! Arguments: straight | turn, number of steps, effects to switch on (names without "effects."). Options: "rolling" for
//! the start, "reversal" of the loads every 50 steps, "varying" for loads that change slightly before every step,
//! "fixed_step=SIZE", "solid=FACETS" for solid teeth, VARIABLE=VALUE. "unread" does not read the forces at the end, so
//! that only steps are counted. "counts" prints accepted and rejected steps, evaluations and the seconds of all steps.

use std::time::Instant;

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{EFFECTS, GearContact, Inputs, Method, Parameters, PlanetSpin, Simulation, Start};
use bevel_differential::variables::{assign, named};

/// Sets the variable `name` to `value`.
fn set(p: &mut Parameters, i: &mut Inputs, name: &str, value: f64) {
    let row = named(name).expect("the variable exists");
    assign(row, value, p, i).unwrap_or_else(|problem| panic!("{problem}"));
}

/// Switches on an effect with the values of its example, or a law.
fn switch(p: &mut Parameters, i: &mut Inputs, name: &str) {
    match name {
        "line" => p.contact.law = ContactLaw::Line,
        "line_weber" => p.contact.law = ContactLaw::LineWeber,
        "each_planet" => p.solver.merge_planets = false,
        _ => {
            let effect = EFFECTS.iter().find(|effect| effect.name == name);
            let effect = effect.unwrap_or_else(|| panic!("there is no effect {name}"));
            if let Some(switch) = effect.switch {
                set(p, i, switch, 1.0);
            }
            for &(name, value) in effect.example {
                set(p, i, name, value);
            }
        }
    }
}

/// A separate function, so that its instructions can be counted.
#[inline(never)]
fn one_communication_step(simulation: &mut Simulation, until: f64) {
    simulation.advance(until).expect("the step succeeds");
}

fn main() {
    // `cargo bench` calls every bench with this option
    if std::env::args().any(|a| a == "--bench") {
        return;
    }
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scene, steps, effects @ ..] = arguments.as_slice() else { panic!("scene and number of steps") };
    let (mut p, mut i) = (Parameters::default(), Inputs::default());
    if scene == "turn" {
        p.scene.planet_spin = PlanetSpin::Imposed;
        (i.carrier_speed, i.planet_spin) = (954f64.to_radians(), 200f64.to_radians());
    }
    for name in effects {
        match name.as_str() {
            "unread" | "counts" | "reversal" | "varying" => {}
            "rolling" => p.scene.start = Start::Rolling,
            name => match name.split_once('=') {
                Some(("fixed_step", size)) => {
                    (p.solver.method, p.solver.fixed_step) = (Method::FixedStep, size.parse().expect("a size"));
                }
                Some(("solid", facets)) => {
                    p.scene.gear_contact = GearContact::Solid;
                    p.solid.facets = facets.parse().expect("a number of facets");
                }
                Some((name, value)) => set(&mut p, &mut i, name, value.parse().expect("a number")),
                None => switch(&mut p, &mut i, name),
            },
        }
    }
    let mut simulation = Simulation::start(&p, &i, 0.0).expect("the scene starts");
    let [reversal, varying, counts] = ["reversal", "varying", "counts"].map(|name| effects.iter().any(|e| e == name));
    let begin = Instant::now();
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for k in 1..=steps.parse::<u32>().expect("a number of steps") {
        if reversal && k % 50 == 0 {
            i.load_torque = i.load_torque.map(|torque| -torque);
            simulation.set_inputs(&i);
        }
        if varying {
            let more = if k % 2 == 0 { 0.1 } else { -0.1 };
            i.load_torque = i.load_torque.map(|torque| torque + more * f64::from(k % 7));
            simulation.set_inputs(&i);
        }
        one_communication_step(&mut simulation, f64::from(k) * 1e-3);
        let m = simulation.motion();
        for value in m.side_speed.iter().chain(&m.side_angle).chain(&m.spin_angle).chain([&m.carrier_angle]) {
            hash = (hash ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3);
        }
    }
    if counts {
        let s = simulation.state().statistics;
        let rejected = s.rejected_error + s.rejected_invalid + s.rejected_ledger + s.rejected_switch;
        println!("{} {rejected} {} {}", s.accepted, s.evaluations, begin.elapsed().as_secs_f64());
    }
    if effects.iter().any(|e| e == "unread") {
        return;
    }
    let (f, b) = (*simulation.forces(), simulation.ledger());
    for value in [f.carrier_torque, f.mesh[0][0].normal, f.side_thrust[1], b.energy_residual, b.steps] {
        hash = (hash ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3);
    }
    println!("{hash:016x}");
}

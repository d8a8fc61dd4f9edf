//! Takes communication steps of a scene and prints the bits of what it reads: for comparing builds that leave effects
//! out, and for counting instructions.
//!
//! Arguments: straight | turn, number of steps, effects to switch on (names without "effects."); "rolling" for the start,
//! "reversal" of the loads every 50 steps, "fixed_step=SIZE"; "unread" leaves the forces at the end unread, so that nothing
//! but steps is counted.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{Effects, Inputs, Method, Parameters, PlanetSpin, Simulation, Start};

fn switch(p: &mut Parameters, name: &str) {
    let e: &mut Effects = &mut p.effects;
    match name {
        "tooth_errors" => {
            e.tooth_errors = true;
            (p.tooth_errors.accuracy_grade, p.tooth_errors.seed) = (7, 1);
            p.tooth_errors.planet_tip_relief = 20e-6;
        }
        "tooth_fault" => {
            e.tooth_fault = true;
            (p.tooth_fault.onset, p.tooth_fault.missing_fraction) = (1e-9, 0.6);
        }
        "tooth_friction" => e.tooth_friction = true,
        "thrust_friction" => e.thrust_friction = true,
        "limited_slip" => e.limited_slip = true,
        "half_shaft" => {
            e.half_shaft = true;
            (p.inertia.left_end, p.inertia.right_end) = (0.5, 0.5);
        }
        "pin_compliance" => e.pin_compliance = true,
        "bearing_drag" => e.bearing_drag = true,
        "final_drive" => e.final_drive = true,
        "strength" => e.strength = true,
        "line" => p.contact.law = ContactLaw::Line,
        "line_weber" => p.contact.law = ContactLaw::LineWeber,
        "each_planet" => p.solver.merge_planets = false,
        _ => panic!("no effect is called {name}"),
    }
}

/// A function of its own, so that its instructions can be counted.
#[inline(never)]
fn one_communication_step(simulation: &mut Simulation, until: f64) {
    simulation.advance(until).expect("the step succeeds");
}

fn main() {
    // `cargo bench` calls every bench with this
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
            "lock" => i.lock = 1.0,
            "unread" | "reversal" => {}
            "rolling" => p.scene.start = Start::Rolling,
            name => match name.split_once('=') {
                Some(("fixed_step", size)) => {
                    (p.solver.method, p.solver.fixed_step) = (Method::FixedStep, size.parse().expect("a size"));
                }
                _ => switch(&mut p, name),
            },
        }
    }
    let mut simulation = Simulation::start(&p, &i, 0.0).expect("the scene starts");
    let reversal = effects.iter().any(|e| e == "reversal");
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    for k in 1..=steps.parse::<u32>().expect("a number of steps") {
        if reversal && k % 50 == 0 {
            i.load_torque = i.load_torque.map(|torque| -torque);
            simulation.set_inputs(&i);
        }
        one_communication_step(&mut simulation, f64::from(k) * 1e-3);
        let m = simulation.motion();
        for value in m.side_speed.iter().chain(&m.side_angle).chain(&m.spin_angle).chain([&m.carrier_angle]) {
            hash = (hash ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3);
        }
    }
    if effects.iter().any(|e| e == "unread") {
        return;
    }
    let (f, b) = (*simulation.forces(), simulation.books());
    for value in [f.carrier_torque, f.mesh[0][0].normal, f.side_thrust[1], b.energy_residual, b.steps] {
        hash = (hash ^ value.to_bits()).wrapping_mul(0x0100_0000_01b3);
    }
    println!("{hash:016x}");
}

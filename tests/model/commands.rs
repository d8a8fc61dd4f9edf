//! Commands of brakes and lock at standstill cause events, both if the step applies them and if they are applied before
//! it.

use bevel_differential::model::{
    AdvanceOptions, CarrierDrive, Event, GearContact, Happening, Inputs, Parameters, Simulation, Start,
};

/// Wheels at rest without loads, with brakes.
fn at_rest(contact: GearContact) -> (Simulation, Inputs) {
    let mut parameters = Parameters::default();
    parameters.scene.gear_contact = contact;
    parameters.scene.carrier_drive = CarrierDrive::Torque;
    parameters.scene.start = Start::Rest;
    parameters.effects.wheel_brake = true;
    (parameters.inertia.left_end, parameters.inertia.right_end) = (1.0, 1.4);
    let inputs = Inputs { carrier_speed: 0.0, carrier_torque: 0.0, load_torque: [0.0; 2], ..Inputs::default() };
    (Simulation::start(&parameters, &inputs, 0.0).unwrap(), inputs)
}

/// Commands that start or stop holding bodies, with the events that they cause.
fn commands(inputs: &Inputs) -> Vec<(Inputs, Vec<(Happening, i32)>)> {
    use Happening::*;
    let braked = Inputs { brake_torque: [100.0; 2], ..*inputs };
    let locked = Inputs { lock: 1.0, ..braked };
    let one_braked = Inputs { brake_torque: [0.0, 50.0], ..locked };
    vec![
        (braked, vec![(WheelStops, 1), (WheelStops, 2)]),
        (locked, vec![(ClutchSticks, 1), (ClutchSticks, 2)]),
        (one_braked, vec![(WheelBreaksLoose, 1)]),
        (*inputs, vec![(ClutchSlips, 1), (ClutchSlips, 2), (WheelBreaksLoose, 2)]),
    ]
}

/// Events after event number `count`.
fn after(simulation: &Simulation, count: u32) -> Vec<Event> {
    let mut events: Vec<Event> = Vec::new();
    while let Some(event) = simulation.events().after(events.last().map_or(count, |last| last.count)) {
        events.push(*event);
    }
    events
}

#[test]
fn commands_that_hold_or_release_at_standstill_are_events_at_the_start_of_the_step() {
    for contact in [GearContact::Ideal, GearContact::Lumped, GearContact::Tooth] {
        let (mut simulation, inputs) = at_rest(contact);
        for (k, (command, expected)) in (0u8..).zip(commands(&inputs)) {
            let (time, count) = (f64::from(k) * 0.125, simulation.events().count());
            simulation.set_inputs(&command);
            simulation.advance(time + 0.125).unwrap();
            let events = after(&simulation, count);
            let found: Vec<_> = events.iter().map(|event| (event.what, event.number())).collect();
            assert_eq!(found, expected, "{contact:?}");
            assert!(events.iter().all(|event| event.time == time), "{contact:?}: {events:?}");
        }
    }
}

#[test]
fn inputs_that_are_applied_before_the_step_give_the_same_state() {
    for contact in [GearContact::Ideal, GearContact::Lumped, GearContact::Tooth] {
        let (start, inputs) = at_rest(contact);
        let options = [AdvanceOptions::default(), AdvanceOptions { pauses: true, ..AdvanceOptions::default() }];
        let mut simulations = [0; 3].map(|_| start.clone());
        for (k, (command, expected)) in (1u8..).zip(commands(&inputs)) {
            let until = f64::from(k) * 0.125;
            let [by_step, before, twice] = &mut simulations;
            // a load that moves free wheels
            let command = Inputs { load_torque: [0.0, 1e-3], ..command };
            by_step.set_inputs(&command);
            by_step.advance(until).unwrap();
            before.set_inputs(&command);
            assert_eq!(before.begin(), !expected.is_empty());
            assert!(!before.begin(), "{contact:?}: the inputs act already");
            while before.time() < until {
                before.advance_by(until, options[1]).unwrap();
            }
            // a reaction to the event at the same time
            twice.set_inputs(&Inputs { carrier_torque: 3.0, ..command });
            twice.begin();
            twice.set_inputs(&command);
            assert!(!twice.begin(), "{contact:?}: the reaction holds nothing");
            while twice.time() < until {
                twice.advance_by(until, options[usize::from(k % 2)]).unwrap();
            }
            assert!(before.state() == by_step.state(), "{contact:?}, {until} s");
            assert!(twice.state() == by_step.state(), "{contact:?}, {until} s");
        }
    }
}

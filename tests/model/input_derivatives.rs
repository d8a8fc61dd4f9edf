//! Inputs that change with time.

use bevel_differential::model::*;

#[test]
fn inputs_follow_a_parabola_from_any_point_on_it() {
    let rate = Inputs { carrier_torque: 3.0, ..Inputs::ZERO };
    let second = Inputs { carrier_torque: -4.0, planet_spin: 2.0, ..Inputs::ZERO };
    let input_derivatives = InputDerivatives { rates: [rate, second] };
    let start = Inputs { carrier_torque: 5.0, ..Inputs::ZERO };
    let (half, rest) = input_derivatives.after(0.25, &start);
    let (end, _) = rest.after(0.5, &half);
    let (t, whole) = (0.75, input_derivatives.after(0.75, &start).0);
    assert_eq!(whole.carrier_torque, 5.0 + 3.0 * t - 2.0 * t * t);
    assert_eq!((end.carrier_torque, end.planet_spin), (whole.carrier_torque, t * t));
}

#[test]
fn commands_stay_within_their_limits() {
    let input_derivatives =
        InputDerivatives { rates: [Inputs { lock: 1.0, fault: -1.0, ..Inputs::ZERO }, Inputs::ZERO] };
    let (later, _) = input_derivatives.after(3.0, &Inputs { lock: 0.5, fault: 0.5, ..Inputs::ZERO });
    assert_eq!((later.lock, later.fault), (1.0, 0.0));
}

#[test]
fn an_input_at_its_limit_has_no_rate() {
    let rate = Inputs { brake_torque: [-100.0, -10.0], carrier_torque: 5.0, ..Inputs::ZERO };
    let course = InputDerivatives { rates: [rate, Inputs::ZERO] };
    let (later, rest) = course.after(1.0, &Inputs { brake_torque: [50.0; 2], ..Inputs::ZERO });
    assert_eq!((later.brake_torque, later.carrier_torque), ([0.0, 40.0], 5.0));
    assert_eq!((rest.rates[0].brake_torque, rest.rates[0].carrier_torque), ([0.0, -10.0], 5.0));
}

//! Actuators against an integration with small steps of the fourth order, and against closed forms.

use super::*;

/// Integrates an actuator with limited rate by the method of Runge and Kutta in `steps`.
fn integrated(of: &Actuator, state: ActuatorState, command: &Parabola, (time, steps): (f64, usize)) -> ActuatorState {
    let h = time / steps as f64;
    let tau = of.response_time;
    let (mut limited, mut y) = (state.limited, [state.value, state.rate]);
    // the command stays at the limit that it reaches first
    let leaves = |at: &f64| !(0.0..=1.0).contains(&moved(command, *at)[0]);
    let stays_from = (0..=steps).map(|k| k as f64 * h).find(leaves).unwrap_or(time);
    let target = |t: f64| {
        let command = moved(command, t.min(stays_from))[0].clamp(0.0, 1.0);
        ((command - of.dead_band) / (1.0 - of.dead_band)).max(0.0)
    };
    for k in 0..steps {
        let t = k as f64 * h;
        let next = target(t + h);
        let most = if of.stroke_time > 0.0 { h / of.stroke_time } else { f64::INFINITY };
        let end = limited + (next - limited).clamp(-most, most);
        if tau == 0.0 {
            (limited, y) = (end, [end, (end - limited) / h]);
            continue;
        }
        let rate = |share: f64, [value, rate]: [f64; 2]| {
            let r = limited + share * (end - limited);
            [rate, (r - value - 2.0 * of.response_damping * tau * rate) / (tau * tau)]
        };
        let plus = |by: f64, slope: [f64; 2]| [y[0] + by * slope[0], y[1] + by * slope[1]];
        let a = rate(0.0, y);
        let b = rate(0.5, plus(0.5 * h, a));
        let c = rate(0.5, plus(0.5 * h, b));
        let d = rate(1.0, plus(h, c));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        limited = end;
    }
    ActuatorState { limited, value: y[0], rate: y[1] }
}

#[test]
fn the_response_agrees_with_an_integration() {
    let commands = [[1.0, 0.0, 0.0], [0.3, 0.0, 0.0], [0.0, 4.0, 0.0], [0.9, -6.0, 30.0], [0.05, 3.0, -20.0], [0.0; 3]];
    let starts = [[0.0; 3], [0.6, 0.5, -2.0], [1.0, 1.0, 0.0]];
    for (dead_band, stroke_time) in [(0.0, 0.0), (0.1, 0.0), (0.0, 0.2), (0.2, 0.15)] {
        for (response_time, response_damping) in [(0.0, 1.0), (0.05, 0.4), (0.03, 1.0), (0.03, 1.0 + 1e-9), (0.02, 3.0)]
        {
            let of = Actuator { dead_band, stroke_time, response_time, response_damping };
            for (command, [limited, value, rate]) in commands.iter().flat_map(|c| starts.map(|s| (c, s))) {
                let start = ActuatorState { limited, value, rate };
                let time = 0.31;
                let exact = of.after(&start, command, time);
                let other = integrated(&of, start, command, (time, 4000));
                let what = format!("{of:?} {command:?} {start:?}: {exact:?} {other:?}");
                assert!((exact.limited - other.limited).abs() < 1e-3, "{what}");
                assert!((exact.value - other.value).abs() < 1e-3, "{what}");
                // two parts are one whole
                if (0.0..=1.0).contains(&moved(command, 0.1)[0]) {
                    let parts = of.after(&of.after(&start, command, 0.1), &moved(command, 0.1), time - 0.1);
                    assert!((parts.value - exact.value).abs() < 1e-8, "{what} {parts:?}");
                }
            }
        }
    }
}

#[test]
fn a_step_under_a_rate_limit_has_its_closed_form() {
    // critically damped: under a ramp R t, y = R (t − 2 τ + (t + 2 τ) e^(−t/τ))
    let of = Actuator { dead_band: 0.0, stroke_time: 0.5, response_time: 0.04, response_damping: 1.0 };
    let (rate, tau) = (1.0 / of.stroke_time, of.response_time);
    for t in [1e-4, 0.01, 0.1, 0.3, 0.499] {
        let expected = rate * (t - 2.0 * tau + (t + 2.0 * tau) * (-t / tau).exp());
        let state = of.after(&ActuatorState::default(), &[1.0, 0.0, 0.0], t);
        assert!((state.value - expected).abs() < 1e-13, "{t}: {} {expected}", state.value);
        let ahead = of.after(&state, &[1.0, 0.0, 0.0], 1e-6);
        let [value, slope, second] = of.acting(&state, &[1.0, 0.0, 0.0]);
        assert!((value + 1e-6 * (slope + 0.5e-6 * second) - ahead.value).abs() < 1e-12);
    }
    // the dead band shortens the way, and the output settles exactly
    let of = Actuator { dead_band: 0.25, ..of };
    assert_eq!(of.after(&ActuatorState::default(), &[0.25, 0.0, 0.0], 1.0), ActuatorState::default());
    assert_eq!(of.after(&ActuatorState::default(), &[0.625, 0.0, 0.0], 5.0), of.settled(0.625));
    assert_eq!(of.settled(0.625).value, 0.5);
}

#[test]
fn what_acts_is_never_negative() {
    let of = Actuator { dead_band: 0.0, stroke_time: 0.0, response_time: 0.05, response_damping: 0.2 };
    let released = of.after(&of.settled(1.0), &[0.0; 3], 0.16);
    assert!(released.value < -0.4, "{released:?}");
    assert_eq!(of.acting(&released, &[0.0; 3]), [0.0; 3]);
}

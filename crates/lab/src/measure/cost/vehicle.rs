//! The host's part of the coupled run: a car that accelerates with its left wheel on ice.
//!
//! Wheels stand on the shafts of the differential; the tyres' forces, the car's speed and the drive torque are the host's:
//!
//! ```text
//! F = μN tanh(C κ/μN),  κ = (ω r − v)/v,   m v̇ = F_L + F_R,   T_c = T₀ + (T₁ − T₀) sin²(π t/2t₁)
//! ```
//!
//! A tyre that grips is a damper of C r²/v between wheel and car, by far the stiffest thing that crosses the interface; the
//! teeth do not.

use bevel_differential::model::{CarrierDrive, Inputs, Parameters};

use super::cases::Fidelity;

/// Mass that the axle pushes [kg].
const MASS: f64 = 1400.0;
/// Rolling radius of a tyre [m].
const RADIUS: f64 = 0.3;
/// Longitudinal stiffness of a tyre [N].
const SLIP_STIFFNESS: f64 = 6e4;
/// Load on a wheel [N].
const LOAD: f64 = 3500.0;
/// Grip of left and right tyre: ice and dry road.
const GRIP: [f64; 2] = [0.15, 0.9];
/// Inertia of a wheel [kg·m²].
const WHEEL: f64 = 1.0;
/// Speed of the wheels at the start [rad/s].
pub const SPEED: f64 = 70.0;
/// Drive torque at the start and at the end of its rise [N·m], and how long it rises [s].
const TORQUE: [f64; 2] = [50.0, 400.0];
const RISE: f64 = 0.3;

/// Drive torque at `time` [N·m].
pub fn drive_torque(time: f64) -> f64 {
    let rise = (0.5 * std::f64::consts::PI * (time / RISE).min(1.0)).sin().powi(2);
    TORQUE[0] + (TORQUE[1] - TORQUE[0]) * rise
}

/// Force of a tyre at the wheel's and the car's speed [N].
fn tyre(side: usize, wheel: f64, car: f64) -> f64 {
    let most = GRIP[side] * LOAD;
    most * (SLIP_STIFFNESS * (wheel * RADIUS - car) / (car * most)).tanh()
}

/// Inputs of the differential at `time`, with wheels and car at these speeds.
pub fn inputs(time: f64, wheels: [f64; 2], car: f64) -> Inputs {
    Inputs {
        carrier_speed: SPEED,
        carrier_torque: drive_torque(time),
        load_torque: [0, 1].map(|side| RADIUS * tyre(side, wheels[side], car)),
        ..Inputs::default()
    }
}

/// Acceleration of the car under the loads of `inputs` [m/s²].
pub fn acceleration(inputs: &Inputs) -> f64 {
    inputs.load_torque.iter().sum::<f64>() / (RADIUS * MASS)
}

/// Speed of the car at which the tyres carry the torque of the start [m/s].
pub fn speed_at_start() -> f64 {
    // the right tyre, far below its grip, is all but linear; one side's half of the torque
    let force = 0.5 * TORQUE[0] / RADIUS;
    RADIUS * SPEED / (1.0 + force / SLIP_STIFFNESS)
}

/// The differential in this car.
pub fn parameters(fidelity: Fidelity) -> Parameters {
    let mut parameters = fidelity.of(Parameters::default());
    parameters.scene.carrier_drive = CarrierDrive::Torque;
    (parameters.inertia.left_end, parameters.inertia.right_end) = (WHEEL, WHEEL);
    parameters
}

/// Communication step at which a tyre that grips makes plain stepping unstable [s]: 2 J v/(C r²).
pub fn longest_stable_step() -> f64 {
    2.0 * WHEEL * speed_at_start() / (SLIP_STIFFNESS * RADIUS * RADIUS)
}

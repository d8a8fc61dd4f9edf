//! What can be read from a model at an instant, in three groups by what they cost.

use crate::model::scene::layout::MAX_PLANETS;
use crate::model::setup::effect_outputs::{HEATS, READINGS};

/// Angles and speeds: read straight from the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Carrier angle since the start [rad].
    pub carrier_angle: f64,
    /// Carrier speed [rad/s].
    pub carrier_speed: f64,
    /// Side gear angles, left and right [rad]; 0 as assembled, teeth in mid-gap: lash and deflection are in it.
    pub side_angle: [f64; 2],
    /// Side gear speeds, left and right [rad/s].
    pub side_speed: [f64; 2],
    /// Spin angles of the planets relative to the carrier since the start [rad].
    pub spin_angle: [f64; MAX_PLANETS],
    /// Spin speeds of the planets relative to the carrier [rad/s].
    pub spin_speed: [f64; MAX_PLANETS],
    /// Tooth engagements per second of one mesh [Hz].
    pub mesh_frequency: f64,
}

/// One mesh (a planet with one side gear).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshForces {
    /// Sum of the normal forces of its tooth pairs [N].
    pub normal: f64,
    /// Tooth pairs carrying load.
    pub pairs: f64,
    /// Thrust on the side gear, along its axis away from the apex [N].
    pub side_thrust: f64,
    /// Thrust on the planet, along its axis away from the apex [N].
    pub planet_thrust: f64,
    /// Force on the side gear along the carrier's direction of rotation [N]; negative on the coast flank.
    pub tangential: f64,
    /// Transmission error: approach of the drive flanks at the mean cone distance [m].
    pub transmission_error: f64,
}

/// Forces, torques and accelerations: one evaluation of the tooth forces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forces {
    /// Carrier acceleration [rad/s²].
    pub carrier_acceleration: f64,
    /// Side gear accelerations [rad/s²].
    pub side_acceleration: [f64; 2],
    /// Torque the drive delivers to the carrier [N·m].
    pub carrier_torque: f64,
    /// Torque the half-shafts deliver to the wheels [N·m].
    pub shaft_torque: [f64; 2],
    /// Torque of all meshes on a side gear, referred to its outer pitch circle [N].
    pub side_tangential: [f64; 2],
    /// Normal forces of all meshes of a side gear [N].
    pub side_normal: [f64; 2],
    /// Thrust of all meshes on a side gear, away from the apex [N].
    pub side_thrust: [f64; 2],
    /// Torque that imposes the spin, all planets together [N·m].
    pub spin_torque: f64,
    /// Meshes, by planet and side.
    pub mesh: [[MeshForces; 2]; MAX_PLANETS],
    /// Resultant of a planet's mesh forces across its pin [N].
    pub pin_force: [f64; MAX_PLANETS],
    /// Thrust of both meshes on a planet, away from the apex [N].
    pub planet_thrust: [f64; MAX_PLANETS],
    /// Power delivered by the drives [W].
    pub power_in: f64,
    /// Power delivered to the wheels [W].
    pub power_out: f64,
    /// Power turned into heat within the differential [W].
    pub power_loss: f64,
    /// Signed torque bias ratio T_slow/T_fast, over the last whole mesh cycle where shafts twist; 1 at zero torque.
    pub torque_bias_ratio: f64,
    /// Locking value |ΔT|/|T_L + T_R|, over the last whole mesh cycle where shafts twist; 0 at zero torque.
    pub locking_value: f64,
    /// Readings of the effects.
    pub readings: [f64; READINGS],
}

/// Ledger and solver statistics.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Books {
    /// Heat since the start by cause [J].
    pub heat: [f64; HEATS],
    /// Readings of the effects that change with accepted steps.
    pub readings: [f64; READINGS],
    /// Side gears, groups of planets, and wheels that dry friction holds [how many].
    pub held: [f64; 3],
    /// Energy balance: stored energy − work of the inputs + heat [J]; 0 for an exact solution.
    pub energy_residual: f64,
    /// Accepted steps.
    pub steps: f64,
    /// Rejected steps.
    pub rejected: f64,
    /// Evaluations of the tooth forces.
    pub rhs_calls: f64,
    /// Size of the last accepted step [s].
    pub step_size: f64,
}

/// Torque bias ratio and locking value of shaft torques at given speeds.
pub fn bias(torque: [f64; 2], speed: [f64; 2]) -> (f64, f64) {
    let [slow, fast] = if speed[0] <= speed[1] { torque } else { [torque[1], torque[0]] };
    let sum = (torque[0] + torque[1]).abs();
    if sum == 0.0 {
        return (1.0, 0.0);
    }
    // a fast side without torque would make the ratio infinite
    let ratio = if fast != 0.0 { (slow / fast).clamp(-MOST_BIAS, MOST_BIAS) } else { MOST_BIAS * slow.signum() };
    (ratio, (torque[0] - torque[1]).abs() / sum)
}

/// Torque bias ratios are shown up to this.
const MOST_BIAS: f64 = 1e6;

/// Share of the power fed in that is not lost, whichever end feeds; 1 at zero power. What the teeth store and give back
/// within a mesh cycle is no loss.
pub fn efficiency(forces: &Forces) -> f64 {
    let fed = forces.power_in.max(0.0) + (-forces.power_out).max(0.0);
    if fed > 0.0 { (1.0 - forces.power_loss / fed).max(0.0) } else { 1.0 }
}

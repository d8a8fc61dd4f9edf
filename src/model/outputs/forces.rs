//! Forces, torques and powers of a differential, and the ratios that follow from them.

use super::mesh_forces::MeshForces;
use crate::model::scene::layout::MAX_PLANETS;
use crate::model::setup::effect_outputs::READINGS;

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

/// Largest magnitude of the torque bias ratio.
const MOST_BIAS: f64 = 1e6;

/// Share of the power fed in that is not lost, whichever end feeds; 1 at zero power. What the teeth store and give back
/// within a mesh cycle is no loss.
pub fn efficiency(forces: &Forces) -> f64 {
    let fed = forces.power_in.max(0.0) + (-forces.power_out).max(0.0);
    if fed > 0.0 { (1.0 - forces.power_loss / fed).max(0.0) } else { 1.0 }
}

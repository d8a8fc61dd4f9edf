//! Forces, torques and powers of a differential, and the ratios that follow from them.

use crate::model::effect_kinds::dry_friction::SPEED_TOLERANCE;
use crate::model::scene::MAX_PLANETS;
use crate::model::setup::effect_outputs::INSTANT_READINGS;

/// How much of the forces is computed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Extent {
    /// Torques, accelerations and powers of the bodies; meshes stay zero.
    Bodies,
    /// The meshes' normal forces as well.
    Loads,
    /// Their parts in space as well, which cost as much as all others.
    Parts,
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
    /// Sum of the powers of those ports that feed: carrier, left wheel, right wheel and spin drive [W].
    pub power_fed: f64,
    /// Power turned into heat within the differential [W].
    pub power_loss: f64,
    /// Signed torque bias ratio T_slow/T_fast, slow and fast in the sense of the torques, over the last whole mesh cycle
    /// where shafts twist; 1 below 1e-3 N·m in sum.
    pub torque_bias_ratio: f64,
    /// Locking value |ΔT|/|T_L + T_R|, over the last whole mesh cycle where shafts twist; 0 below 1e-3 N·m in
    /// sum.
    pub locking_value: f64,
    /// Readings of the effects that change at any instant.
    pub readings: [f64; INSTANT_READINGS],
    /// Whether thrusts, tangential and pin forces are in it: the parts of normal forces in space.
    pub has_parts: bool,
}

/// Torque bias ratio and locking value of shaft torques at given speeds; 1 and 0 where the sum of the torques is below
/// [`LEAST_TORQUE`]. The sum's sign decides which side is fast. If the sum vanishes, only rounding would decide, and its result
/// would depend on the level of gear contact.
///
/// The fast side is the one ahead in the sense in which the torques act, (ω_L − ω_R)(T_L + T_R) > 0 for the left one,
/// forward or backward, in drive or overrun, and whether or not the carrier turns. Friction turns the power
/// (T_R − T_L)(ω_L − ω_R)/2 ≥ 0 into heat, so that it always takes torque from that side: a bias by friction is 1 or more.
/// Where both turn alike, as far as dry friction tells speeds apart, the side that carries less is the fast one: it would
/// be ahead if it slipped.
pub fn bias(torque: [f64; 2], speed: [f64; 2]) -> (f64, f64) {
    let sum = torque[0] + torque[1];
    // a torque that is NaN has no bias
    if sum.abs().is_nan() || sum.abs() < LEAST_TORQUE {
        return (1.0, 0.0);
    }
    let ahead = (speed[0] - speed[1]) * sum.signum();
    let is_left_fast = if ahead.abs() > ALIKE { ahead > 0.0 } else { torque[0].abs() < torque[1].abs() };
    let [slow, fast] = if is_left_fast { [torque[1], torque[0]] } else { torque };
    // a fast side without torque would make the ratio infinite
    let ratio = if fast != 0.0 { (slow / fast).clamp(-MOST_BIAS, MOST_BIAS) } else { MOST_BIAS };
    (ratio, ((torque[0] - torque[1]).abs() / sum.abs()).min(MOST_BIAS))
}

/// Difference of speeds up to which sides turn alike [rad/s].
const ALIKE: f64 = SPEED_TOLERANCE;
/// Sum of the shaft torques below which there is no bias [N·m].
const LEAST_TORQUE: f64 = 1e-3;
/// Largest magnitude of the torque bias ratio and of the locking value.
const MOST_BIAS: f64 = 1e6;

/// Share of the power fed in that is not lost, not below 0; 1 if nothing is fed. Bodies and teeth that store energy and give it
/// back cause no loss.
pub fn efficiency(forces: &Forces) -> f64 {
    let fed = forces.power_fed;
    if fed > 0.0 { (1.0 - forces.power_loss / fed).max(0.0) } else { 1.0 }
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

#[cfg(test)]
mod tests {
    use super::bias;

    #[test]
    fn a_bias_by_friction_is_the_same_in_drive_and_overrun_forward_and_backward_and_from_side_to_side() {
        // the wheels share 1000 N·m; friction takes 55 N·m from the one that is ahead and gives it to the other
        for torque in [1000.0, -1000.0] {
            for carrier in [50.0, -50.0, 0.0] {
                for spin in [2.5, -2.5] {
                    let speed = [carrier + spin, carrier - spin];
                    let moved = 27.5 * f64::signum(spin);
                    let (ratio, locking) = bias([0.5 * torque - moved, 0.5 * torque + moved], speed);
                    assert!((locking - 0.055).abs() < 1e-15, "{locking}");
                    assert!(
                        (ratio - (1.0 + 0.055) / (1.0 - 0.055)).abs() < 1e-14,
                        "{torque} {carrier} {spin}: {ratio}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_bias_against_friction_is_below_one_and_torques_of_opposite_signs_have_a_negative_one() {
        assert_eq!(bias([600.0, 400.0], [2.0, 1.0]).0, 400.0 / 600.0);
        assert_eq!(bias([-600.0, -400.0], [-2.0, -1.0]).0, 400.0 / 600.0);
        assert_eq!(bias([-100.0, 400.0], [2.0, 1.0]).0, -4.0);
        assert_eq!(bias([100.0, -400.0], [-2.0, -1.0]).0, -4.0);
    }

    #[test]
    fn sides_that_turn_alike_have_the_ratio_of_the_larger_to_the_smaller_torque() {
        for torque in [[900.0, 100.0], [100.0, 900.0], [-900.0, -100.0], [-100.0, -900.0]] {
            // a locked differential trembles
            for apart in [0.0, 1e-9, -1e-9] {
                assert_eq!(bias(torque, [3.0 + apart, 3.0]), (9.0, 0.8));
            }
        }
    }

    #[test]
    fn no_torque_is_no_bias_and_a_side_without_torque_has_the_largest() {
        assert_eq!(bias([0.0, 0.0], [1.0, 2.0]), (1.0, 0.0));
        for rounding in [1e-13, -1e-9, 9e-4] {
            assert_eq!(bias([-50.0, 50.0 + rounding], [22.0, 20.0]), (1.0, 0.0));
        }
        assert_eq!(bias([f64::NAN, 1.0], [1.0, 2.0]), (1.0, 0.0));
        assert_eq!(bias([-1e6, 1e6 + 0.002], [2.0, 1.0]).1, super::MOST_BIAS);
        assert_eq!(bias([0.0, 5.0], [2.0, 1.0]), (super::MOST_BIAS, 1.0));
        assert_eq!(bias([0.0, -5.0], [-2.0, -1.0]), (super::MOST_BIAS, 1.0));
    }
}

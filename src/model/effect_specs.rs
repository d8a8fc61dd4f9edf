//! What a user gives to define the effects.

use serde::{Deserialize, Serialize};

use crate::strength::{Material, SnCurve};

/// Friction of thrust washers and pins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ThrustFrictionSpec {
    /// Coefficient of the thrust washers μ_w.
    pub coefficient: f64,
    /// Coefficient of the pins μ_p.
    pub pin_coefficient: f64,
    /// Radius of the pins [m].
    pub pin_radius: f64,
    /// Mean radius of the planets' washers [m].
    pub planet_washer_radius: f64,
    /// Mean radius of the side gears' washers [m].
    pub side_washer_radius: f64,
    /// Stiffness against turning before a side gear's washer slips [N·m/rad]; planets by the square of the gear ratio.
    pub stiffness: f64,
}

/// Clutch packs between side gears and carrier.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitedSlipSpec {
    /// Torque of each clutch without load [N·m].
    pub preload: f64,
    /// Torque of each clutch per torque of the meshes on its side gear.
    pub torque_coefficient: f64,
    /// Torque at which a stuck clutch breaks loose over its sliding torque.
    pub static_ratio: f64,
    /// Stiffness of a stuck clutch [N·m/rad].
    pub stiffness: f64,
}

/// A lock between side gears and carrier, by command.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LockSpec {
    /// Torque that each side holds at full command [N·m].
    pub torque: f64,
    /// Stiffness of each side at full command [N·m/rad].
    pub stiffness: f64,
}

/// Torsion of the half-shafts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HalfShaftSpec {
    /// Stiffness, left and right [N·m/rad].
    pub stiffness: [f64; 2],
    /// Damping, left and right [N·m·s/rad].
    pub damping: [f64; 2],
}

/// What gives way in series with the teeth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PinComplianceSpec {
    /// Stiffness of a pin against the tangential force of its planet at the mean cone distance [N/m].
    pub pin_stiffness: f64,
    /// Stiffness of the case against the thrust of a side gear [N/m].
    pub case_stiffness: f64,
    /// Damping over stiffness [s].
    pub damping_time: f64,
}

/// Drag of bearings and oil.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingDragSpec {
    /// Load-independent bearing torque on the carrier [N·m].
    pub carrier_torque: f64,
    /// Viscous drag on the carrier [N·m·s/rad].
    pub carrier_viscous: f64,
    /// Churning on the carrier, with the square of its speed [N·m·s²/rad²].
    pub carrier_churning: f64,
    /// Load-independent bearing torque on each side gear [N·m].
    pub side_torque: f64,
    /// Viscous drag on each side gear [N·m·s/rad].
    pub side_viscous: f64,
    /// Speed at which bearing torque has built up [rad/s].
    pub breakaway_speed: f64,
}

/// Excitation by the final drive's ring gear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FinalDriveSpec {
    /// Teeth of the ring gear.
    pub ring_teeth: i32,
    /// Amplitude relative to the carrier's command, of torque or of speed.
    pub amplitude: f64,
}

/// Strength of the gears.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrengthSpec {
    /// Tip radius of the tool that cuts the roots, in modules.
    pub tool_radius: f64,
    /// Bending strength of the roots at the knee under pulsating load σ_FE [Pa].
    pub bending_strength: f64,
    /// Cycles at the knee of bending.
    pub bending_cycles: f64,
    /// Life factor of bending at 10³ cycles Y_NT.
    pub bending_life_factor: f64,
    /// Part of the bending strength that teeth loaded on alternate flanks keep Y_M.
    pub idler_factor: f64,
    /// Contact strength of the flanks at the knee σ_Hlim [Pa].
    pub contact_strength: f64,
    /// Cycles at the knee of pitting.
    pub contact_cycles: f64,
    /// Life factor of pitting at 10⁵ cycles Z_NT.
    pub contact_life_factor: f64,
}

impl StrengthSpec {
    /// S–N curves of the material.
    pub fn material(&self) -> Material {
        Material {
            bending: SnCurve::through(self.bending_strength, self.bending_cycles, self.bending_life_factor, 1e3),
            pitting: SnCurve::through(self.contact_strength, self.contact_cycles, self.contact_life_factor, 1e5),
            idler_factor: self.idler_factor,
        }
    }
}

/// All of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffectSpecs {
    /// Washers and pins.
    pub thrust_friction: ThrustFrictionSpec,
    /// Clutch packs.
    pub limited_slip: LimitedSlipSpec,
    /// Lock.
    pub lock: LockSpec,
    /// Half-shafts.
    pub half_shaft: HalfShaftSpec,
    /// Pins and case.
    pub pin_compliance: PinComplianceSpec,
    /// Drag.
    pub bearing_drag: BearingDragSpec,
    /// Final drive.
    pub final_drive: FinalDriveSpec,
    /// Strength.
    pub strength: StrengthSpec,
}

impl Default for EffectSpecs {
    /// Values of a passenger car's differential of the study's size.
    fn default() -> Self {
        Self {
            thrust_friction: ThrustFrictionSpec {
                coefficient: 0.05,
                pin_coefficient: 0.05,
                pin_radius: 8e-3,
                planet_washer_radius: 14e-3,
                side_washer_radius: 22e-3,
                stiffness: 1e5,
            },
            limited_slip: LimitedSlipSpec { preload: 50.0, torque_coefficient: 0.1, static_ratio: 1.0, stiffness: 1e5 },
            lock: LockSpec { torque: 5e3, stiffness: 1e6 },
            half_shaft: HalfShaftSpec { stiffness: [1e4; 2], damping: [5.0; 2] },
            pin_compliance: PinComplianceSpec { pin_stiffness: 5e8, case_stiffness: 1e9, damping_time: 1e-6 },
            bearing_drag: BearingDragSpec {
                carrier_torque: 0.5,
                carrier_viscous: 5e-3,
                carrier_churning: 1e-4,
                side_torque: 0.2,
                side_viscous: 1e-3,
                breakaway_speed: 0.1,
            },
            final_drive: FinalDriveSpec { ring_teeth: 37, amplitude: 0.02 },
            strength: StrengthSpec {
                tool_radius: 0.25,
                bending_strength: 1e9,
                bending_cycles: 3e6,
                bending_life_factor: 2.5,
                idler_factor: 0.7,
                contact_strength: 1.5e9,
                contact_cycles: 5e7,
                contact_life_factor: 1.6,
            },
        }
    }
}

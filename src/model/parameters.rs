//! Everything a user can fix before the first step, and the inputs that may change at any communication point.

use serde::{Deserialize, Serialize};

use super::effect_specs::EffectSpecs;
use crate::contact::ContactSpec;
use crate::contact::errors::{FaultyGear, ToothErrorSpec, ToothFaultSpec};
use crate::friction::ToothFrictionSpec;
use crate::geometry::GearSpec;

/// Elastic and mass data of both gears.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio ν.
    pub poisson_ratio: f64,
    /// Density ρ [kg/m³].
    pub density: f64,
}

/// Moments of inertia about the axis of rotation [kg·m²].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InertiaSpec {
    /// Gears from their solids; otherwise as given below.
    pub from_geometry: bool,
    /// Carrier with ring gear and cross-shaft, without planets.
    pub carrier: f64,
    /// One side gear, if not from geometry.
    pub side_gear: f64,
    /// One planet about its own axis, if not from geometry.
    pub planet: f64,
    /// Wheel side of the left half-shaft, rigid on the side gear unless the shaft twists; 0 = none.
    pub left_end: f64,
    /// Wheel side of the right half-shaft, rigid on the side gear unless the shaft twists; 0 = none.
    pub right_end: f64,
}

/// How the carrier is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum CarrierDrive {
    /// Its speed is imposed, the torque follows.
    Speed = 1,
    /// Its torque is imposed, the speed follows.
    Torque = 2,
}

/// How the wheel side of a half-shaft is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum SideDrive {
    /// A torque loads it.
    Torque = 1,
    /// Its speed is imposed; the half-shaft between it and the side gear twists.
    Speed = 2,
}

/// Whether the planets spin freely on their pins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum PlanetSpin {
    /// Spin follows from the tooth forces.
    Free = 1,
    /// Spin is imposed, as the study does in its turn.
    Imposed = 2,
}

/// How tooth contact is represented.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum GearContact {
    /// No teeth: Willis' equation as a constraint.
    Ideal = 1,
    /// One spring per mesh.
    Lumped = 2,
    /// Tooth pair by tooth pair along the path of contact.
    Tooth = 3,
    /// Solids with faceted flanks, found and pressed together by geometry alone.
    Solid = 4,
}

/// State at the start time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum Start {
    /// Meshes preloaded by the loads at the start time.
    Equilibrium = 1,
    /// Speeds by Willis' equation, teeth in the middle of their gaps, unloaded.
    Rolling = 2,
    /// Everything at rest that is not imposed.
    Rest = 3,
}

/// What drives, what is free, what is represented.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Carrier drive.
    pub carrier_drive: CarrierDrive,
    /// Drive of the left half-shaft.
    pub left_drive: SideDrive,
    /// Drive of the right half-shaft.
    pub right_drive: SideDrive,
    /// Planet spin.
    pub planet_spin: PlanetSpin,
    /// Representation of tooth contact.
    pub gear_contact: GearContact,
    /// State at the start time.
    pub start: Start,
}

/// Switches of the effects.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Effects {
    /// Backlash `geometry.backlash`; off = teeth without play.
    pub backlash: bool,
    /// Tip-corner contact outside the path of contact; off = pairs enter and leave abruptly.
    pub corner_contact: bool,
    /// Deviations and modifications of the teeth.
    pub tooth_errors: bool,
    /// A damaged tooth, from a time or a trigger on.
    pub tooth_fault: bool,
    /// Friction along the flanks.
    pub tooth_friction: bool,
    /// Friction of thrust washers and pins.
    pub thrust_friction: bool,
    /// Clutch packs between side gears and carrier.
    pub limited_slip: bool,
    /// Torsion of the half-shafts.
    pub half_shaft: bool,
    /// Pins and case that give way.
    pub pin_compliance: bool,
    /// Drag of bearings and oil.
    pub bearing_drag: bool,
    /// Excitation by the final drive.
    pub final_drive: bool,
    /// Stress and fatigue.
    pub strength: bool,
}

impl Effects {
    /// Nothing but the teeth: backlash and corner contact.
    pub const TEETH: Self = Self {
        backlash: true,
        corner_contact: true,
        tooth_errors: false,
        tooth_fault: false,
        tooth_friction: false,
        thrust_friction: false,
        limited_slip: false,
        half_shaft: false,
        pin_compliance: false,
        bearing_drag: false,
        final_drive: false,
        strength: false,
    };

    /// Every switch with its name.
    pub fn list(&self) -> [(&'static str, bool); 12] {
        [
            ("effects.backlash", self.backlash),
            ("effects.corner_contact", self.corner_contact),
            ("effects.tooth_errors", self.tooth_errors),
            ("effects.tooth_fault", self.tooth_fault),
            ("effects.tooth_friction", self.tooth_friction),
            ("effects.thrust_friction", self.thrust_friction),
            ("effects.limited_slip", self.limited_slip),
            ("effects.half_shaft", self.half_shaft),
            ("effects.pin_compliance", self.pin_compliance),
            ("effects.bearing_drag", self.bearing_drag),
            ("effects.final_drive", self.final_drive),
            ("effects.strength", self.strength),
        ]
    }
}

/// How solid teeth are cut into facets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolidTeeth {
    /// Facets on the involute of each flank.
    pub facets: i32,
    /// Width of the patch over which the greatest overlap is taken, as a multiple of the one that follows from the facets.
    pub smoothing: f64,
}

/// Integration method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[repr(i32)]
pub enum Method {
    /// Adaptive L-stable Rosenbrock method of order 5.
    Adaptive = 1,
    /// Implicit steps of fixed size and bounded work, for real time.
    FixedStep = 2,
    /// Radau IIA of order 5, adaptive, for comparison.
    Radau = 3,
    /// RODAS of order 4(3), adaptive, for comparison.
    Rodas4 = 4,
    /// Dormand and Prince's explicit method of order 5(4), adaptive, for comparison.
    DormandPrince = 5,
}

/// Accuracy and method of integration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolverSpec {
    /// Integration method.
    pub method: Method,
    /// Relative tolerance of the local error per step.
    pub relative_tolerance: f64,
    /// Longest step of the method with fixed steps [s].
    pub fixed_step: f64,
    /// Planets that are identical and in phase are simulated once and counted; off simulates each.
    pub merge_planets: bool,
}

/// All parameters; the default is the study's straight case.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Gear pair and number of planets.
    pub geometry: GearSpec,
    /// Material of the gears.
    pub material: Material,
    /// Moments of inertia.
    pub inertia: InertiaSpec,
    /// Contact law.
    pub contact: ContactSpec,
    /// Drives and representation.
    pub scene: Scene,
    /// Effects.
    pub effects: Effects,
    /// Facets of solid teeth.
    pub solid: SolidTeeth,
    /// Errors of the teeth.
    pub tooth_errors: ToothErrorSpec,
    /// The broken tooth.
    pub tooth_fault: ToothFaultSpec,
    /// Friction along the flanks.
    pub tooth_friction: ToothFrictionSpec,
    /// What defines the other effects.
    pub specs: EffectSpecs,
    /// Integration.
    pub solver: SolverSpec,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            geometry: GearSpec::default(),
            material: Material { young_modulus: 2.07e11, poisson_ratio: 0.25, density: 7800.0 },
            inertia: InertiaSpec {
                from_geometry: true,
                carrier: 0.02,
                side_gear: 9e-5,
                planet: 2e-5,
                left_end: 0.0,
                right_end: 0.0,
            },
            contact: ContactSpec::default(),
            scene: Scene {
                carrier_drive: CarrierDrive::Speed,
                left_drive: SideDrive::Torque,
                right_drive: SideDrive::Torque,
                planet_spin: PlanetSpin::Free,
                gear_contact: GearContact::Tooth,
                start: Start::Equilibrium,
            },
            effects: Effects::TEETH,
            solid: SolidTeeth { facets: 32, smoothing: 1.0 },
            tooth_errors: ToothErrorSpec::default(),
            tooth_fault: ToothFaultSpec {
                gear: FaultyGear::Planet,
                missing_fraction: 0.6,
                ..ToothFaultSpec::default()
            },
            tooth_friction: ToothFrictionSpec::default(),
            specs: EffectSpecs::default(),
            solver: SolverSpec {
                method: Method::Adaptive,
                relative_tolerance: 1e-6,
                fixed_step: 1e-4,
                merge_planets: true,
            },
        }
    }
}

/// What the host feeds in at communication points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Inputs {
    /// Imposed carrier speed, or its initial speed when torque-driven [rad/s].
    pub carrier_speed: f64,
    /// Carrier torque when torque-driven [N·m].
    pub carrier_torque: f64,
    /// Load on left and right half-shaft, positive resists positive rotation [N·m].
    pub load_torque: [f64; 2],
    /// Imposed speeds of the wheel-side ends of the half-shafts [rad/s].
    pub side_speed: [f64; 2],
    /// Imposed planet spin relative to the carrier, positive speeds the left side up [rad/s].
    pub planet_spin: f64,
    /// Command of the lock, 0 open to 1 locked.
    pub lock: f64,
    /// Triggers the tooth fault when it rises above one half.
    pub fault: f64,
}

impl Default for Inputs {
    fn default() -> Self {
        Self {
            carrier_speed: 2861f64.to_radians(),
            carrier_torque: 1670.0,
            load_torque: [835.0, 835.0],
            side_speed: [2861f64.to_radians(); 2],
            planet_spin: 0.0,
            lock: 0.0,
            fault: 0.0,
        }
    }
}

impl Parameters {
    /// The gears as they mesh: without play where backlash is off.
    pub fn gears(&self) -> GearSpec {
        GearSpec { backlash: if self.effects.backlash { self.geometry.backlash } else { 0.0 }, ..self.geometry }
    }

    /// `self` as far as it may be tuned while a simulation runs, `fixed` for the rest.
    pub fn with_tuned(&self, fixed: &Self) -> Self {
        let mut p = *fixed;
        p.contact.damping = self.contact.damping;
        p.tooth_friction.coefficient = self.tooth_friction.coefficient;
        p.specs.thrust_friction.coefficient = self.specs.thrust_friction.coefficient;
        p.specs.thrust_friction.pin_coefficient = self.specs.thrust_friction.pin_coefficient;
        p.specs.limited_slip.preload = self.specs.limited_slip.preload;
        p.specs.limited_slip.torque_coefficient = self.specs.limited_slip.torque_coefficient;
        p
    }
}

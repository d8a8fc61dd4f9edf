//! Final drive: the gear pair between a pinion and the ring gear on the carrier, i = z₂/z₁.
//!
//! The drive then acts on the pinion, or on the propeller shaft in front of it. Motion and torques in front of the
//! carrier are referred to the carrier: speeds are divided by i, torques multiplied by i, inertias by i². A rigid mesh
//! has no degree of freedom: θ_p = i θ_c. An elastic mesh (`mesh`) has lash, stiffness and an error that excites it.
//!
//! Friction on the pinion is dry, with sticking: T_f = c₀ + c₁ |T|/i + b |ω_p|, with c₁ for drive and coast. An efficiency η
//! in drive is c₁ = 1/η − 1; the same c₁ gives 1 − c₁ in overrun. Source: Simscape Driveline, Simple Gear, for losses that
//! depend on the flank under load. Forces on the ring gear and on the bearings of the
//! carrier follow from the torque of the mesh (`bearings`).

mod bearings;
mod mesh;

use self::bearings::Reaction;
use self::mesh::Mesh;
use crate::declaration::prelude::*;
use crate::declaration::{Row, row};
use crate::model::effect_kinds::{
    Action, Attached, BUILT, BodyEffect, BodyMotion, ByLoad, Class, Declare, Effect, EffectSetting, Heat, InputField,
    Instant, Loss, Reading, Refinement, RubbingSurface, Slopes, StaticLoads, Warmed, readings,
};
use crate::model::scene::{
    AttachedBody, Base, CARRIER, CarrierDrive, InertiaSpec, MAX_SPEED, MAX_TORQUE, PINION, Plan, Requests, RubbingKind,
    Scene,
};
use crate::model::thermal::OIL;
use crate::numeric::TAU;
use crate::problem::Problem;

choices! {
    /// Side of the planets on which the ring gear is.
    pub enum RingSide: "RingSide" {
        Left = 1, "left": "ring gear on the left of the planets";
        Right = 2, "right": "ring gear on the right of the planets";
    }
}

choices! {
    /// Hand of the teeth of the ring gear.
    pub enum Hand: "Hand" {
        Right = 1, "right": "right-hand teeth";
        Left = 2, "left": "left-hand teeth";
    }
}

parameters! {
    /// Final drive between a pinion and the ring gear on the carrier.
    pub struct FinalDriveSpec in "final_drive" {
        /// Teeth of the pinion
        pinion_teeth: i32 = 10, 1..=1000;
        /// Teeth of the ring gear; the ratio is their number over that of the pinion
        ring_teeth: i32 = 41, 1..=1000;
        /// Elastic mesh with lash; false: rigid
        elastic_mesh: bool = false;
        /// Stiffness of the mesh, transverse at the mean radius
        stiffness: f64 = 3e8, N_PER_M | N_PER_UM, 1e3..=1e13, when(is!(Self.elastic_mesh, true));
        /// Damping of the mesh in contact, transverse at the mean radius
        damping: f64 = 3e3, NS_PER_M | NS_PER_MM, 0.0..=1e9, when(is!(Self.elastic_mesh, true));
        /// Lash of the mesh, transverse at the mean radius
        backlash: f64 = 1.2e-4, METRE | MM, 0.0..=1e-2, when(is!(Self.elastic_mesh, true));
        /// Mean radius of the ring gear
        mean_radius: f64 = 0.09, METRE | MM, 1e-3..=10.0;
        /// Transmission error at the mesh order, transverse at the mean radius: amplitude
        error_1: f64 = 0.0, METRE | UM, 0.0..=1e-2, when(is!(Self.elastic_mesh, true));
        /// Transmission error at twice the mesh order: amplitude
        error_2: f64 = 0.0, METRE | UM, 0.0..=1e-2, when(is!(Self.elastic_mesh, true));
        /// Transmission error at three times the mesh order: amplitude
        error_3: f64 = 0.0, METRE | UM, 0.0..=1e-2, when(is!(Self.elastic_mesh, true));
        /// Phase of the transmission error at the mesh order
        error_phase_1: f64 = 0.0, RADIAN | DEG, -10.0..=10.0, when(above!(Self.error_1, 0.0));
        /// Phase of the transmission error at twice the mesh order
        error_phase_2: f64 = 0.0, RADIAN | DEG, -10.0..=10.0, when(above!(Self.error_2, 0.0));
        /// Phase of the transmission error at three times the mesh order
        error_phase_3: f64 = 0.0, RADIAN | DEG, -10.0..=10.0, when(above!(Self.error_3, 0.0));
        /// Transmission error at the order of the pinion: amplitude
        pinion_runout: f64 = 0.0, METRE | UM, 0.0..=1e-2, when(is!(Self.elastic_mesh, true));
        /// Phase of the transmission error at the order of the pinion
        pinion_runout_phase: f64 = 0.0, RADIAN | DEG, -10.0..=10.0, when(above!(Self.pinion_runout, 0.0));
        /// Transmission error at the order of the ring gear: amplitude
        ring_runout: f64 = 0.0, METRE | UM, 0.0..=1e-2, when(is!(Self.elastic_mesh, true));
        /// Phase of the transmission error at the order of the ring gear
        ring_runout_phase: f64 = 0.0, RADIAN | DEG, -10.0..=10.0, when(above!(Self.ring_runout, 0.0));
        /// Friction torque on the pinion at no load, with the drag of its bearings
        friction_torque: f64 = 0.0, NEWTON_METRE, 0.0..=1e6;
        /// Friction torque on the pinion over its share of the mesh torque, if the mesh drives forward
        drive_loss: f64 = 0.0, ONE, 0.0..=0.9;
        /// Friction torque on the pinion over its share of the mesh torque, if the mesh drives backward
        coast_loss: f64 = 0.0, ONE, 0.0..=0.9;
        /// Stiffness with which friction holds the pinion at standstill
        holding_stiffness: f64 = 1e4, NM_PER_RAD, 1.0..=1e9,
            when(any([above!(Self.friction_torque, 0.0), above!(Self.drive_loss, 0.0), above!(Self.coast_loss, 0.0)]));
        /// Viscous friction on the pinion
        viscous: f64 = 0.0, NMS_PER_RAD, 0.0..=1e3;
        /// Normal pressure angle of the flanks that drive forward
        drive_pressure_angle: f64 = 20f64.to_radians(), RADIAN | DEG, 0.0..=1.0;
        /// Normal pressure angle of the flanks that drive backward
        coast_pressure_angle: f64 = 20f64.to_radians(), RADIAN | DEG, 0.0..=1.0;
        /// Spiral or helix angle of the ring gear at the mean radius
        spiral_angle: f64 = 0.0, RADIAN | DEG, 0.0..=1.2;
        /// Hand of the teeth of the ring gear
        hand: Hand = Hand::Right, when(above!(Self.spiral_angle, 0.0));
        /// Pitch angle of the ring gear; 0 = helical gears
        pitch_angle: f64 = 76f64.to_radians(), RADIAN | DEG, 0.0..=std::f64::consts::FRAC_PI_2;
        /// Side of the planets on which the ring gear is
        ring_side: RingSide = RingSide::Left;
        /// Distance of the mesh from the plane of the planets, positive away from it
        ring_offset: f64 = 0.025, METRE | MM, -1.0..=1.0;
        /// Angle of the mesh about the axle, from its front upward
        azimuth: f64 = 0.0, RADIAN | DEG, -3.2..=3.2;
        /// Distance of the effective centre of the left carrier bearing from the plane of the planets
        left_bearing: f64 = 0.075, METRE | MM, 1e-3..=10.0;
        /// Distance of the effective centre of the right carrier bearing from the plane of the planets
        right_bearing: f64 = 0.075, METRE | MM, 1e-3..=10.0;
    }
}

/// Limit of speeds over that of the carrier, because a pinion turns faster.
const FASTER: f64 = 10.0;

impl Declare for FinalDriveSpec {
    const DESCRIPTION: &'static str = "Final drive: a pinion drives the ring gear on the carrier";
    const CLASS: Class = Class::Machine;
    const REFINEMENTS: &'static [Refinement] = &[
        Refinement { name: "final_drive.elastic_mesh", plain: &[("final_drive.elastic_mesh", 0.0)] },
        Refinement { name: "final_drive.backlash", plain: &[("final_drive.backlash", 0.0)] },
        Refinement {
            name: "final_drive errors",
            plain: &[
                ("final_drive.error_1", 0.0),
                ("final_drive.error_2", 0.0),
                ("final_drive.error_3", 0.0),
                ("final_drive.pinion_runout", 0.0),
                ("final_drive.ring_runout", 0.0),
            ],
        },
    ];
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.final_drive",
        description: "Heat of friction and damping in the final drive since the start",
        warms: Warmed::Node(OIL),
    });
    const READINGS: &'static [Reading] = readings! {
        /// Force of the pinion on the ring gear along its circumference, positive if it drives forward; 0 without
        /// effects.final_drive
        "ring_gear.tangential_force": NEWTON, Always(|drive, at| drive.reaction(at).tangential);
        /// Force of the pinion on the ring gear along the axle, positive away from the planets; 0 without
        /// effects.final_drive
        "ring_gear.axial_force": NEWTON, Always(|drive, at| drive.reaction(at).axial);
        /// Force of the pinion on the ring gear toward the axle; 0 without effects.final_drive
        "ring_gear.radial_force": NEWTON, Always(|drive, at| drive.reaction(at).radial);
        /// Force on the left carrier bearing to the left; 0 without effects.final_drive
        "left_bearing.axial_force": NEWTON, Always(|drive, at| drive.reaction(at).bearings[0][1]);
        /// Force on the left carrier bearing upward; 0 without effects.final_drive
        "left_bearing.vertical_force": NEWTON, Always(|drive, at| drive.reaction(at).bearings[0][2]);
        /// Force on the left carrier bearing forward; 0 without effects.final_drive
        "left_bearing.longitudinal_force": NEWTON, Always(|drive, at| drive.reaction(at).bearings[0][0]);
        /// Force on the right carrier bearing to the left; 0 without effects.final_drive
        "right_bearing.axial_force": NEWTON, Always(|drive, at| drive.reaction(at).bearings[1][1]);
        /// Force on the right carrier bearing upward; 0 without effects.final_drive
        "right_bearing.vertical_force": NEWTON, Always(|drive, at| drive.reaction(at).bearings[1][2]);
        /// Force on the right carrier bearing forward; 0 without effects.final_drive
        "right_bearing.longitudinal_force": NEWTON, Always(|drive, at| drive.reaction(at).bearings[1][0]);
    };
    const BODIES: &'static [Attached] = &[Attached {
        name: "the pinion",
        of: "pinion",
        states: ["lag", "carrier_speed"],
        descriptions: [
            "Angle by which the pinion lags behind the carrier, at the carrier's speed; 0 without final_drive.elastic_mesh",
            "Speed of the pinion divided by the ratio of the final drive; 0 without final_drive.elastic_mesh, so for the \
             pinion read pinion.speed",
        ],
    }];
    const EXAMPLE: &'static [(&'static str, f64)] =
        &[("final_drive.elastic_mesh", 1.0), ("final_drive.friction_torque", 0.5), ("final_drive.error_1", 5e-6)];

    fn needs() -> Vec<(Need, Condition)> {
        vec![(Need::Pinion, on!(Self))]
    }

    fn inputs() -> Vec<Row<InputField>> {
        let [speed, torque] = if BUILT { [FASTER * MAX_SPEED, MAX_TORQUE] } else { [0.0; 2] };
        vec![
            row(
                "pinion.speed_command",
                "Imposed speed of the pinion, or of its propeller shaft; initial speed when it is torque-driven",
            )
            .when(Scene::drive_has_speed())
            .input(RAD_PER_S | DEG_PER_S, speed, |i| &mut i.pinion_speed),
            row("pinion.torque_command", "Torque on the pinion, or on its propeller shaft, when it is torque-driven")
                .when(is!(Scene.carrier_drive, CarrierDrive::Torque))
                .input(NEWTON_METRE, torque, |i| &mut i.pinion_torque),
        ]
    }
}

impl FinalDriveSpec {
    /// Ratio i of the speeds of pinion and carrier.
    pub fn ratio(&self) -> f64 {
        f64::from(self.ring_teeth) / f64::from(self.pinion_teeth)
    }

    /// Inertia of the pinion at the carrier's speed [kg·m²].
    fn reduced_inertia(&self, inertia: &InertiaSpec) -> f64 {
        self.ratio() * self.ratio() * inertia.pinion
    }

    /// Forces on the ring gear and on the carrier's bearings.
    fn reaction(&self, at: &Instant) -> Reaction {
        if at.on { self.reaction_to(at.carrier_torque) } else { Reaction::default() }
    }
}

impl Effect for FinalDriveSpec {
    fn check(&self, setting: &EffectSetting, found: &mut Vec<Problem>) {
        if self.elastic_mesh && setting.inertia.pinion <= 0.0 {
            found.push(Problem::new(
                "inertia.pinion",
                "0 kg.m2: a pinion with an elastic mesh needs an inertia above 0",
            ));
        }
        let pitch = TAU * self.mean_radius / f64::from(self.ring_teeth);
        if self.elastic_mesh && self.backlash >= pitch {
            found.push(problem!(
                "final_drive.backlash",
                "{} is not below the pitch of final_drive.ring_teeth = {} at final_drive.mean_radius, {}",
                MM.text(self.backlash),
                self.ring_teeth,
                MM.text(pitch)
            ));
        }
    }

    fn requests(&self, setting: &EffectSetting) -> Requests {
        let inertia = self.reduced_inertia(setting.inertia);
        let mut requests = Requests {
            drive_ratio: Some(self.ratio()),
            turns: self.pinion_teeth.unsigned_abs(),
            ..Requests::default()
        };
        if self.elastic_mesh {
            requests.attached[PINION] = Some(AttachedBody { to: Base::Freedom(CARRIER), inertia });
        } else {
            requests.on_carrier = inertia;
        }
        requests
    }

    fn on_bodies(&self, setting: &EffectSetting, plan: &Plan) -> Option<Box<dyn BodyEffect>> {
        let layout = plan.layout();
        let mesh = self.elastic_mesh.then(|| Mesh::new(self, &layout));
        let viscous = self.ratio() * self.ratio() * self.viscous;
        let loss = [self.drive_loss, self.coast_loss];
        let loss = loss.iter().any(|loss| *loss > 0.0).then_some(Loss(loss));
        let acts = mesh.is_some() || viscous > 0.0 || loss.is_some();
        let pinion = layout.pinion();
        acts.then(|| Box::new(FinalDrive { mesh, viscous, loss, pinion, heat_index: setting.heat_index }) as _)
    }

    fn add_surfaces(&self, setting: &EffectSetting, surfaces: &mut Vec<RubbingSurface>) {
        if self.friction_torque.max(self.drive_loss).max(self.coast_loss) > 0.0 {
            let ratio = self.ratio();
            surfaces.push(RubbingSurface {
                limit: ByLoad { constant: ratio * self.friction_torque, per_load: 1.0, ..ByLoad::NONE },
                stiffness: ratio * ratio * self.holding_stiffness,
                ..RubbingSurface::new(RubbingKind::Pinion, setting.heat_index)
            });
        }
    }
}

/// Elastic mesh and viscous friction of the pinion, at the carrier's speed.
#[derive(Clone, Copy, Debug)]
struct FinalDrive {
    mesh: Option<Mesh>,
    /// Viscous friction [N·m·s/rad].
    viscous: f64,
    /// Friction in proportion to the torque of the mesh.
    loss: Option<Loss>,
    /// Degree of freedom of the pinion.
    pinion: usize,
    heat_index: usize,
}

impl BodyEffect for FinalDrive {
    fn act(&self, at: &BodyMotion, out: &mut Action) {
        let speed = at.v[self.pinion];
        out.force[self.pinion] -= self.viscous * speed;
        out.heat[self.heat_index] += self.viscous * speed * speed;
        if let Some(mesh) = &self.mesh {
            out.heat[self.heat_index] += mesh.act(at, out.force);
        }
    }

    fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        out.velocity(self.pinion, self.pinion, -self.viscous);
        if let Some(mesh) = &self.mesh {
            mesh.slopes(at, out);
        }
    }

    fn energy(&self, at: &BodyMotion) -> f64 {
        self.mesh.map_or(0.0, |mesh| mesh.energy(at))
    }

    fn kink(&self, at: &BodyMotion, h: f64) -> Option<f64> {
        self.mesh?.kink(at, h)
    }

    fn wind_up(&self, loads: &StaticLoads, motion: [&mut [f64]; 2]) {
        if let Some(mesh) = &self.mesh {
            mesh.wind_up(loads.ring, motion);
        }
    }

    fn is_in_front(&self) -> bool {
        self.mesh.is_none()
    }

    fn loss(&self) -> Option<Loss> {
        self.loss
    }

    fn mesh_torque(&self, at: &BodyMotion) -> Option<f64> {
        self.mesh.map(|mesh| mesh.torque_at(at))
    }

    fn mesh_slopes(&self, at: &BodyMotion) -> [(usize, [f64; 2]); 2] {
        self.mesh.map_or([(0, [0.0; 2]); 2], |mesh| mesh.torque_slopes(at))
    }

    fn carrier_torque(&self, at: &BodyMotion, driven: f64) -> f64 {
        self.mesh.map_or(driven - self.viscous * at.v[self.pinion], |mesh| mesh.on_carrier(at))
    }
}

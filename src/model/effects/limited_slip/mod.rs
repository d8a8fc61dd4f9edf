//! Clutch packs between side gears and carrier. Their torques add up:
//!
//! ```text
//! dry        T_max = preload + κ L     L: mesh torque that presses the pack (`effect_kinds::ramps`)
//! thrust     T_max = a F_a             F_a: thrust of the pack's own side gear, a = n μ r_m of its n faces
//! viscous    T = T_v |s/s_v|ⁿ sgn(s)   s: slip relative to the carrier (`slip_torque`)
//! measured   T = C(|s|) sgn(s)         C: curve through points (`curve`); C(0) is held like dry friction
//! ```
//!
//! A side gear that presses the plates has no washer of its own. Its thrust is F_a = Q tan α/R under the mesh torque Q,
//! with the cone distance R of the resultant, so packs that slip under equal torques move S = κ + a tan α/R of Q.
//!
//! A factor for the slip speed multiplies T_max (`effect_kinds::slip_law`). Friction that falls with speed causes
//! judder. Static ratio, slip speed, temperature and p·v change only the dry torque, because a measured curve contains
//! these influences and sheared oil has others.
//!
//! Source: the preloaded plate clutch of H. Naunheimer et al., Automotive Transmissions, 2nd ed., Springer 2011,
//! section 10.2.

mod curve;
mod slip_torque;

use crate::contact::ContactLaw;
use crate::declaration::prelude::*;
use crate::model::assembly::face::centroid;
use crate::model::effect_kinds::torque_curve::POINTS;
use crate::model::effect_kinds::{
    BodyEffect, ByLoad, Class, Declare, Effect, EffectSetting, Element, Heat, Part, Ramps, Reading, RubbingSurface,
    Slides, SlipSpec, SurfaceTemperature, ThrustPart, TorqueCurve, Warmed, check_slip, depends_on_speed,
    depends_on_temperature, readings,
};
use crate::model::run::six_digits;
use crate::model::scene::{CARRIER, GearContact, Plan, RubbingKind};
use crate::model::thermal::CLUTCH;
use crate::numeric::{cos, sin};
use crate::problem::Problem;
use curve::CurvePoint;
use slip_torque::{SlipTorque, Viscous};

choices! {
    /// Mesh torque that presses a clutch pack.
    pub enum PressedBy: "PressedBy" {
        OwnSide = 1, "own_side": "mesh torque on its own side gear";
        BothSides = 2, "both_sides": "mean of the mesh torques on both side gears, as by the ramps of a cross-shaft";
    }
}

parameters! {
    /// Clutch packs between side gears and carrier.
    pub struct LimitedSlipSpec in "limited_slip" {
        /// Clutch torque on each side without load
        preload: f64 = 0.0, NEWTON_METRE, 0.0..=1e6, TUNABLE;
        /// Clutch torque on each side per mesh torque that presses the pack, in drive direction
        torque_coefficient: f64 = 0.0, ONE, 0.0..=10.0, TUNABLE;
        /// Mesh torque that presses each clutch pack
        pressed_by: PressedBy = PressedBy::OwnSide, when(by_torque());
        /// Torque coefficient under negative mesh torque, relative to torque_coefficient; 0 = one-way
        coast_ratio: f64 = 1.0, ONE, 0.0..=10.0, TUNABLE, when(by_torque());
        /// Clutch torque on each side per thrust of its side gear on the plates: number of faces x coefficient of
        /// friction x mean radius; 0 = the gear presses a washer instead
        thrust_arm: f64 = 0.0, METRE | MM, 0.0..=10.0;
        /// Viscous torque of each clutch at the slip viscous_speed
        viscous_torque: f64 = 0.0, NEWTON_METRE, 0.0..=1e6;
        /// Slip relative to the carrier at which viscous_torque applies
        viscous_speed: f64 = 10.0, RAD_PER_S | RPM, 1e-3..=1e4, when(above!(Self.viscous_torque, 0.0));
        /// Exponent of the slip in the viscous torque
        viscous_exponent: f64 = 1.0, ONE, 0.3..=2.0, when(above!(Self.viscous_torque, 0.0));
        /// Stiffness of a sticking clutch
        stiffness: f64 = 1e5, NM_PER_RAD, 1.0..=1e9, when(holds());
        /// Mean radius of the plates, for sliding speed
        mean_radius: f64 = 0.05, METRE | MM, 1e-3..=1.0, when(depends_on_speed::<Self>());
        /// Total friction area of a clutch pack
        friction_area: f64 = 0.05, SQUARE_METRE | CM2, 1e-8..=10.0, when(pressed());
        /// Coefficient of friction of the plates
        plate_coefficient: f64 = 0.1, ONE, 0.01..=1.0, when(pressed());
        /// Point of the measured clutch torque
        curve: [CurvePoint; POINTS] = [CurvePoint::UNSET; POINTS];
        ..sliding: SlipSpec, when(pressed());
    }
}

/// Heat of all clutches between side gears and carrier.
pub const CLUTCH_HEAT: Heat = Heat {
    output: "heat.clutch",
    description: "Heat of limited-slip clutches and lock since the start",
    warms: Warmed::Node(CLUTCH),
};

impl Declare for LimitedSlipSpec {
    const DESCRIPTION: &'static str =
        "Clutch packs on the side gears: preload, ramps, viscous torque, or a measured curve; with stiction";
    const CLASS: Class = Class::Machine;
    const BIASES_TORQUE: bool = true;
    const PV_LIMIT: Option<&'static str> = Some("limited_slip.pv_limit");
    const HEAT: Option<Heat> = Some(CLUTCH_HEAT);
    const EXAMPLE: &'static [(&'static str, f64)] = &[("limited_slip.preload", 50.0)];
    const READINGS: &'static [Reading] = readings! {
        /// Pressure times sliding speed of the clutch packs; larger of both
        "pv.clutch": W_PER_M2 | W_PER_MM2, Always;
    };

    fn needs() -> Vec<(Need, Condition)> {
        vec![(Need::Temperature, all([on!(Self), depends_on_temperature::<Self>()]))]
    }
}

/// Condition that side gears have washers, because they do not press the packs.
pub fn washers_bear() -> Condition {
    any([off!(LimitedSlipSpec), is!(LimitedSlipSpec.thrust_arm, 0.0)])
}

/// Condition that ramps press the packs.
fn by_torque() -> Condition {
    above!(LimitedSlipSpec.torque_coefficient, 0.0)
}

/// Condition that dry plates slide.
fn pressed() -> Condition {
    any([above!(LimitedSlipSpec.preload, 0.0), by_torque(), above!(LimitedSlipSpec.thrust_arm, 0.0)])
}

/// Condition that the packs hold.
fn holds() -> Condition {
    any([pressed(), curve::holds()])
}

impl Slides for LimitedSlipSpec {
    fn sliding(&mut self) -> &mut SlipSpec {
        &mut self.sliding
    }
}

impl LimitedSlipSpec {
    /// True if preload, mesh torque or thrust presses the plates.
    fn is_pressed(&self) -> bool {
        self.preload.max(self.torque_coefficient).max(self.thrust_arm) > 0.0
    }

    /// Measured curve if it has a breakaway torque, which dry friction holds.
    fn curve_that_holds(&self) -> Option<TorqueCurve> {
        curve::curve(&self.curve).filter(|curve| curve.breakaway() > 0.0)
    }

    /// Torque of a pack that only resists slip, if there is any.
    fn slip_torque(&self) -> Option<SlipTorque> {
        let Self { viscous_torque: torque, viscous_speed: speed, viscous_exponent: exponent, .. } = *self;
        let viscous = (torque > 0.0).then_some(Viscous { torque, speed, exponent });
        let curve = curve::curve(&self.curve).filter(|curve| curve.breakaway() == 0.0);
        (viscous.is_some() || curve.is_some()).then_some(SlipTorque { viscous, curve })
    }

    /// Share of the mesh torque that the thrust of the side gear moves, a tan α/R.
    fn by_thrust(&self, setting: &EffectSetting) -> f64 {
        let (pair, angle) = (setting.pair, setting.geometry.pressure_angle);
        let at_mean = setting.scene.gear_contact == GearContact::Tooth && setting.contact.law == ContactLaw::Impact;
        let cone = if at_mean { pair.mean_cone } else { centroid(pair) };
        self.thrust_arm * sin(angle) / cos(angle) / cone
    }

    /// Warning about clutches that lock themselves.
    fn self_locking(&self, setting: &EffectSetting) -> Option<Problem> {
        let (drive, thrust) = (self.torque_coefficient, self.by_thrust(setting));
        let coast = drive * self.coast_ratio;
        let value = drive.max(coast) + thrust;
        let with = [(coast > drive, "coast_ratio"), (thrust > 0.0, "thrust_arm")];
        let with: Vec<&str> = with.iter().filter_map(|&(is, name)| is.then_some(name)).collect();
        let which = if with.is_empty() { String::new() } else { format!(" with {}", with.join(" and ")) };
        let name = if drive > 0.0 { "limited_slip.torque_coefficient" } else { "limited_slip.thrust_arm" };
        (value >= 1.0).then(|| {
            problem!(
                name,
                "{}{which} is 1 or more, so the clutches lock themselves: as soon as torque flows, no difference of \
                 the wheels' torques makes them slip",
                six_digits(value)
            )
        })
    }
}

impl Effect for LimitedSlipSpec {
    fn check(&self, setting: &EffectSetting, found: &mut Vec<Problem>) {
        check_slip!("limited_slip", self.sliding, found);
        found.extend(curve::problem(&self.curve));
        let pressing = [
            (
                "limited_slip.torque_coefficient",
                self.torque_coefficient,
                "",
                "a torque-proportional clutch",
                "coefficient",
            ),
            ("limited_slip.thrust_arm", self.thrust_arm, " m", "a clutch that the side gears press", "arm"),
        ];
        let contact = setting.scene.gear_contact;
        if matches!(contact, GearContact::Lumped | GearContact::Tooth) {
            return;
        }
        for (name, value, unit, clutch, what) in pressing.into_iter().filter(|(_, value, ..)| *value > 0.0) {
            found.push(problem!(
                name,
                "{value}{unit}: {clutch} needs the forces of the meshes, which scene.gear_contact = {} does not \
                 provide to it; set the {what} to 0 (preload only), or choose lumped or tooth",
                contact.literal()
            ));
        }
    }

    fn warnings(&self, setting: &EffectSetting) -> Vec<Problem> {
        let acts = self.is_pressed() || self.slip_torque().is_some() || self.curve_that_holds().is_some();
        if !acts {
            let said = "the clutches have no torque: set limited_slip.preload, torque_coefficient, thrust_arm, \
                        viscous_torque or the points of curve, or switch the effect off";
            return vec![Problem::new("effects.limited_slip", said)];
        }
        self.self_locking(setting).into_iter().collect()
    }

    fn on_bodies(&self, setting: &EffectSetting, _: &Plan) -> Option<Box<dyn BodyEffect>> {
        let law = self.slip_torque()?;
        let part = |s: usize| Part { law, displacement: None, body: s, base: Some(CARRIER) };
        Some(Box::new(Element::new([0, 1].map(part).into(), setting.heat_index)))
    }

    fn add_surfaces(&self, setting: &EffectSetting, surfaces: &mut Vec<RubbingSurface>) {
        let curve = self.curve_that_holds();
        if !self.is_pressed() && curve.is_none() && self.slip_torque().is_some() {
            return;
        }
        let none = RubbingSurface::new(RubbingKind::Side, setting.heat_index);
        let limit = ByLoad { constant: self.preload, per_thrust: self.thrust_arm, per_load: self.torque_coefficient };
        surfaces.push(RubbingSurface {
            limit,
            thrust_part: if self.thrust_arm > 0.0 { ThrustPart::Plates } else { ThrustPart::None },
            ramps: Ramps { coast_ratio: self.coast_ratio, both_sides: self.pressed_by == PressedBy::BothSides },
            stiffness: self.stiffness,
            radius: self.mean_radius,
            pressed: limit.pressed(self.plate_coefficient, self.friction_area),
            sliding: self.sliding,
            temperature: SurfaceTemperature::Node(CLUTCH),
            ..none
        });
        surfaces.extend(curve.map(|curve| {
            let limit = ByLoad { constant: curve.breakaway(), ..ByLoad::NONE };
            RubbingSurface { limit, curve: Some(curve), ..none }
        }));
    }
}

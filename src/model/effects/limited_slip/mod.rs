//! Clutch packs between side gears and carrier. Their torques add up:
//!
//! ```text
//! dry        T_max = preload + κ L     L: mesh torque that presses the pack (`effect_kinds::ramps`)
//! viscous    T = T_v |s/s_v|ⁿ sgn(s)   s: slip relative to the carrier (`slip_torque`)
//! measured   T = C(|s|) sgn(s)         C: curve through points (`curve`); C(0) is held like dry friction
//! ```
//!
//! A factor for the slip speed multiplies T_max (`effect_kinds::slip_law`). Friction that falls with speed causes
//! judder. Static ratio, slip speed, temperature and p·v change only the dry torque, because a measured curve contains
//! these influences and sheared oil has others.
//!
//! Source: the preloaded plate clutch of H. Naunheimer et al., Automotive Transmissions, 2nd ed., Springer 2011,
//! section 10.2.

mod curve;
mod slip_torque;

use crate::declaration::units::{CM2, MM, RPM};
use crate::declaration::{Parameter, Row, row, units};
use crate::model::effect_kinds::torque_curve::POINTS;
use crate::model::effect_kinds::{
    BodyEffect, Declare, Effect, FrictionSource, Heat, Pressed, Ramps, Reading, Setting, SideFriction, SlipSpec,
    SurfaceTemperature, TorqueCurve, check_slip, pv_reading, slip_rows,
};
use crate::model::scene::{GearContact, Plan};
use crate::model::thermal::CLUTCH;
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

spec! {
    /// Clutch packs between side gears and carrier.
    pub struct LimitedSlipSpec {
        /// Torque of each clutch without load [N·m].
        pub preload: f64 = 0.0,
        /// Torque of each clutch per mesh torque that presses it, while the meshes drive the side gear forward.
        pub torque_coefficient: f64 = 0.0,
        /// Mesh torque that presses each clutch.
        pub pressed_by: PressedBy = PressedBy::OwnSide,
        /// Torque coefficient under negative mesh torque over `torque_coefficient`.
        pub coast_ratio: f64 = 1.0,
        /// Torque of sheared oil at the slip `viscous_speed` [N·m].
        pub viscous_torque: f64 = 0.0,
        /// Slip at which sheared oil has its torque [rad/s].
        pub viscous_speed: f64 = 10.0,
        /// Exponent of the slip in the torque of sheared oil.
        pub viscous_exponent: f64 = 1.0,
        /// Measured torque over slip.
        pub curve: [CurvePoint; POINTS] = [CurvePoint { slip: 0.0, torque: 0.0 }; POINTS],
        /// Breakaway torque of a stuck clutch over its sliding torque.
        pub static_ratio: f64 = 1.0,
        /// Stiffness of a stuck clutch [N·m/rad].
        pub stiffness: f64 = 1e5,
        /// Mean radius of the plates [m].
        pub mean_radius: f64 = 0.05,
        /// Area of all rubbing faces of a pack [m²].
        pub friction_area: f64 = 0.05,
        /// Coefficient of friction of the plates.
        pub plate_coefficient: f64 = 0.1,
        /// Sliding of the plates.
        pub sliding: SlipSpec = SlipSpec::default(),
    }
}

/// Heat of all clutches between side gears and carrier.
pub const CLUTCH_HEAT: Heat = Heat {
    output: "heat.clutch",
    description: "Heat of limited-slip clutches and lock since the start",
    at_wheels: false,
};

impl Declare for LimitedSlipSpec {
    const DESCRIPTION: &'static str =
        "Clutch packs on the side gears: preload, ramps, viscous torque, or a measured curve; with stiction";
    const HEAT: Option<Heat> = Some(CLUTCH_HEAT);
    const EXAMPLE: &'static [(&'static str, f64)] = &[("limited_slip.preload", 50.0)];
    const READINGS: &'static [Reading] =
        &[pv_reading("pv.clutch", "Pressure times sliding speed of the clutch packs; larger of both")];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        let mut rows: Vec<Row<Parameter<Self>>> = vec![
            row("limited_slip.preload", "Clutch torque on each side without load").tunable().real(
                units::NEWTON_METRE,
                (0.0, 1e6),
                |p| &mut p.preload,
            ),
            row(
                "limited_slip.torque_coefficient",
                "Clutch torque on each side per mesh torque that presses the pack, in drive direction",
            )
            .tunable()
            .real(units::ONE, (0.0, 10.0), |p| &mut p.torque_coefficient),
            row("limited_slip.pressed_by", "Mesh torque that presses each clutch pack")
                .when(BY_TORQUE)
                .choice(|p: &mut Self| &mut p.pressed_by),
            row(
                "limited_slip.coast_ratio",
                "Torque coefficient under negative mesh torque, relative to torque_coefficient; 0 = one-way",
            )
            .tunable()
            .when(BY_TORQUE)
            .real(units::ONE, (0.0, 10.0), |p| &mut p.coast_ratio),
            row("limited_slip.viscous_torque", "Viscous torque of each clutch at the slip viscous_speed").real(
                units::NEWTON_METRE,
                (0.0, 1e6),
                |p| &mut p.viscous_torque,
            ),
            row("limited_slip.viscous_speed", "Slip relative to the carrier at which viscous_torque applies")
                .when("limited_slip.viscous_torque > 0")
                .real((units::RAD_PER_S, RPM), (1e-3, 1e4), |p| &mut p.viscous_speed),
            row("limited_slip.viscous_exponent", "Exponent of the slip in the viscous torque")
                .when("limited_slip.viscous_torque > 0")
                .real(units::ONE, (0.3, 2.0), |p| &mut p.viscous_exponent),
            row("limited_slip.static_ratio", "Ratio of breakaway torque to sliding torque").when(PRESSED).real(
                units::ONE,
                (1.0, 10.0),
                |p| &mut p.static_ratio,
            ),
            row("limited_slip.stiffness", "Stiffness of a sticking clutch").when(HOLDS).real(
                units::NM_PER_RAD,
                (1.0, 1e9),
                |p| &mut p.stiffness,
            ),
            row("limited_slip.mean_radius", "Mean radius of the plates, for sliding speed")
                .when("limited_slip.stribeck_speed > 0 or limited_slip.slip_slope != 0")
                .real((units::METRE, MM), (1e-3, 1.0), |p| &mut p.mean_radius),
            row("limited_slip.friction_area", "Total friction area of a clutch pack").when(PRESSED).real(
                (units::SQUARE_METRE, CM2),
                (1e-8, 10.0),
                |p| &mut p.friction_area,
            ),
            row("limited_slip.plate_coefficient", "Coefficient of friction of the plates").when(PRESSED).real(
                units::ONE,
                (0.01, 1.0),
                |p| &mut p.plate_coefficient,
            ),
        ];
        rows.extend(slip_rows!("limited_slip", sliding).map(|row| Row { when: row.when.or(Some(PRESSED)), ..row }));
        rows.extend(curve::rows());
        rows
    }
}

/// Condition under which ramps have an effect.
const BY_TORQUE: &str = "limited_slip.torque_coefficient > 0";
/// Condition under which dry plates slide.
const PRESSED: &str = "limited_slip.preload > 0 or limited_slip.torque_coefficient > 0";
/// Condition under which the packs hold.
const HOLDS: &str = "limited_slip.preload > 0 or limited_slip.torque_coefficient > 0 or limited_slip.curve[1].slip = 0 \
                     and limited_slip.curve[1].torque > 0";

impl LimitedSlipSpec {
    /// True if preload or mesh torque presses the plates.
    fn is_pressed(&self) -> bool {
        self.preload > 0.0 || self.torque_coefficient > 0.0
    }

    /// Measured curve if it has a breakaway torque, which dry friction holds.
    fn curve_that_holds(&self) -> Option<TorqueCurve> {
        curve::curve(&self.curve).filter(|curve| curve.breakaway() > 0.0)
    }

    /// Torques that only resist slip, if there are any. Their heat has the index `heat_index`.
    fn slip_torque(&self, heat_index: usize) -> Option<SlipTorque> {
        let Self { viscous_torque: torque, viscous_speed: speed, viscous_exponent: exponent, .. } = *self;
        let viscous = (torque > 0.0).then_some(Viscous { torque, speed, exponent });
        let curve = curve::curve(&self.curve).filter(|curve| curve.breakaway() == 0.0);
        (viscous.is_some() || curve.is_some()).then_some(SlipTorque { viscous, curve, heat_index })
    }

    /// Warning about clutches that lock themselves.
    fn self_locking(&self) -> Option<Problem> {
        let coast = self.torque_coefficient * self.coast_ratio;
        let [largest, which] = if coast > self.torque_coefficient {
            [coast.to_string(), " with coast_ratio".into()]
        } else {
            [self.torque_coefficient.to_string(), String::new()]
        };
        (self.torque_coefficient.max(coast) >= 1.0).then(|| {
            problem!(
                "limited_slip.torque_coefficient",
                "{largest}{which} is 1 or more, so the clutches lock themselves: as soon as torque flows, no difference of \
                 the wheels' torques makes them slip"
            )
        })
    }
}

impl Effect for LimitedSlipSpec {
    fn check(&self, setting: &Setting, found: &mut Vec<Problem>) {
        check_slip!("limited_slip", self.sliding, found);
        found.extend(curve::problem(&self.curve));
        if self.torque_coefficient == 0.0 {
            return;
        }
        let contact = match setting.scene.gear_contact {
            GearContact::Ideal => "ideal",
            GearContact::Solid => "solid",
            GearContact::Lumped | GearContact::Tooth => return,
        };
        found.push(problem!(
            "limited_slip.torque_coefficient",
            "{}: a torque-proportional clutch needs the forces of the meshes, which scene.gear_contact = {contact} \
             does not provide to it; set the coefficient to 0 (preload only), or choose lumped or tooth",
            self.torque_coefficient
        ));
    }

    fn warnings(&self, _: &Setting) -> Vec<Problem> {
        let acts = self.is_pressed() || self.slip_torque(0).is_some() || self.curve_that_holds().is_some();
        if !acts {
            let said = "the clutches have no torque: set limited_slip.preload, torque_coefficient, viscous_torque or the \
                        points of curve, or switch the effect off";
            return vec![Problem::new("effects.limited_slip", said)];
        }
        self.self_locking().into_iter().collect()
    }

    fn on_bodies(&self, setting: &Setting, _: &Plan) -> Option<Box<dyn BodyEffect>> {
        let torque = self.slip_torque(setting.heat_index)?;
        Some(Box::new(torque))
    }

    fn friction(&self, setting: &Setting) -> Option<FrictionSource> {
        let curve = self.curve_that_holds();
        if !self.is_pressed() && curve.is_none() && self.slip_torque(0).is_some() {
            return None;
        }
        // a friction torque T = μ N r needs the pressure p = N/A, so that p r = T/(μ A)
        let per_torque = 1.0 / (self.plate_coefficient * self.friction_area);
        let pressed = Pressed { constant: self.preload, per_load: self.torque_coefficient, ..Pressed::NONE };
        let side = SideFriction {
            constant: self.preload,
            per_torque: self.torque_coefficient,
            ramps: Ramps { coast_ratio: self.coast_ratio, both_sides: self.pressed_by == PressedBy::BothSides },
            curve,
            stiffness: self.stiffness,
            radius: self.mean_radius,
            pressed: pressed.times(per_torque),
            ..SideFriction::default()
        };
        let Self { static_ratio, sliding, .. } = *self;
        let temperature = SurfaceTemperature::Node(CLUTCH);
        Some(FrictionSource { side, static_ratio, sliding, temperature, ..FrictionSource::new(setting.heat_index) })
    }
}

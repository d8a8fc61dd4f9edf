//! Friction of thrust washers and pins, which gives an open differential its torque bias.
//!
//! Dry friction T = μ F r acts on each surface. F is the thrust of all meshes on the side gear, the thrust of both
//! meshes on the planet, or the resultant across its pin (Coulomb; H. Naunheimer et al., Automotive Transmissions, 2nd
//! ed., Springer 2011, section 10.2 on locking values). A planet's washer also bears its centrifugal force m r ω², with
//! mass and centre of mass of its solid. Slip speed changes μ as described in `effect_kinds::slip_law`.
//!
//! The radii are given, or follow from the gears (`radii_from_geometry`). A pin fills its bore. Without a bore, its
//! radius is four fifths of the radius of the root circle at the toe, where a gear is thinnest. A washer spans the back
//! face of its gear, from pin or shaft to the root circle at the heel. It acts at the mean of both radii, as with
//! uniform wear, p r = constant (J. E. Shigley, Mechanical Engineering Design, on disc clutches). For the study's
//! gears, this rule gives 8.0, 13.5 and 22.8 mm; the start values are 8, 14 and 22 mm.

use super::limited_slip::washers_bear;
use crate::declaration::prelude::*;
use crate::geometry::{GearSpec, Pair};
use crate::model::effect_kinds::{
    ByLoad, Declare, Effect, EffectSetting, Heat, Needs, Reading, RubbingSurface, Slides, SlipSpec, SurfaceTemperature,
    ThrustPart, Warmed, check_slip, depends_on_temperature, readings,
};
use crate::model::scene::{GearContact, RubbingKind};
use crate::model::thermal::WASHERS;
use crate::numeric::sin;
use crate::problem::{Problem, distinct_texts};

/// Radius of a pin or shaft over the radius of the root circle at the toe, for gears without a bore.
const PIN_IN_ROOT: f64 = 0.8;
/// Relative difference up to which a pin may be narrower than its bore. Clearances are a tenth of this.
const CLEARANCE: f64 = 0.05;
/// Relative difference below which radii are equal.
const ROUNDING: f64 = 1e-9;
/// Millimetres per metre.
const PER_MM: f64 = 1e3;

parameters! {
    /// Friction of thrust washers and pins.
    pub struct ThrustFrictionSpec in "thrust_friction" {
        /// Coefficient of friction of the thrust washers
        coefficient: f64 = 0.05, ONE, 0.0..=1.0, TUNABLE;
        /// Coefficient of friction of the pins
        pin_coefficient: f64 = 0.05, ONE, 0.0..=1.0, TUNABLE;
        /// Radii of pins and washers from the gear geometry: pins fill the bores or 0.8 of the root circle at the toe,
        /// washers reach the root circle at the heel; false: given values
        radii_from_geometry: bool = false;
        /// Radius of the pins
        pin_radius: f64 = 8e-3, METRE | MM, 0.0..=1.0, when(is!(Self.radii_from_geometry, false));
        /// Mean radius of the planet washers
        planet_washer_radius: f64 = 14e-3, METRE | MM, 0.0..=1.0, when(is!(Self.radii_from_geometry, false));
        /// Mean radius of the side gear washers
        side_washer_radius: f64 = 22e-3, METRE | MM, 0.0..=1.0,
            when(all([is!(Self.radii_from_geometry, false), washers_bear()]));
        /// Stiffness of a sticking side gear washer; scaled by the square of the gear ratio for planets
        stiffness: f64 = 1e5, NM_PER_RAD, 1.0..=1e9;
        /// Area of a planet washer
        planet_washer_area: f64 = 1e-3, SQUARE_METRE | CM2, 1e-8..=10.0;
        /// Area of a side gear washer
        side_washer_area: f64 = 2e-3, SQUARE_METRE | CM2, 1e-8..=10.0, when(washers_bear());
        /// Projected contact area of a pin in its planet
        pin_area: f64 = 3e-4, SQUARE_METRE | CM2, 1e-8..=10.0;
        ..sliding: SlipSpec;
    }
}

impl Declare for ThrustFrictionSpec {
    const DESCRIPTION: &'static str =
        "Friction of thrust washers and pins, with stiction: the torque bias of an open differential";
    const BIASES_TORQUE: bool = true;
    const PV_LIMIT: Option<&'static str> = Some("thrust_friction.pv_limit");
    const HEAT: Option<Heat> = Some(Heat {
        output: "heat.thrust",
        description: "Heat of thrust washers and pins since the start",
        warms: Warmed::Node(WASHERS),
    });
    const READINGS: &'static [Reading] = readings! {
        /// Pressure times sliding speed of washers and pins; largest of all
        "pv.washers": W_PER_M2 | W_PER_MM2, Always;
    };
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth],
        why: "it follows from the thrusts of the meshes",
    });

    fn needs() -> Vec<(Need, Condition)> {
        vec![(Need::Temperature, all([on!(Self), depends_on_temperature::<Self>()]))]
    }
}

impl Slides for ThrustFrictionSpec {
    fn sliding(&mut self) -> &mut SlipSpec {
        &mut self.sliding
    }
}

/// Radii at which thrust friction acts [m].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Radii {
    /// Radius of the pins.
    pin: f64,
    /// Mean radii of the washers of planet and side gear.
    washer: [f64; 2],
}

impl Radii {
    /// Radii that fit the gears.
    fn of_gears(spec: &GearSpec, pair: &Pair) -> Self {
        let bore = [spec.planet_bore, spec.side_bore];
        let hub = |i: usize| if bore[i] > 0.0 { 0.5 * bore[i] } else { PIN_IN_ROOT * toe_root(pair, i) };
        Self { pin: hub(0), washer: [0, 1].map(|i| 0.5 * (hub(i) + back_face(pair, i))) }
    }
}

/// Radius of the root circle of gear `i` at the toe [m].
fn toe_root(pair: &Pair, i: usize) -> f64 {
    pair.inner_cone * sin(pair.gears[i].root)
}

/// Outer radius of the back face of gear `i` [m]: the root circle at the heel.
fn back_face(pair: &Pair, i: usize) -> f64 {
    pair.outer_cone * sin(pair.gears[i].root)
}

impl ThrustFrictionSpec {
    fn radii(&self, setting: &EffectSetting) -> Radii {
        if self.radii_from_geometry {
            return Radii::of_gears(setting.geometry, setting.pair);
        }
        Radii { pin: self.pin_radius, washer: [self.planet_washer_radius, self.side_washer_radius] }
    }

    /// Warning if the given pin radius does not fit the planet; `None` if it fits.
    fn misfit_of_pin(&self, setting: &EffectSetting) -> Option<Problem> {
        let (pin, bore) = (self.pin_radius, 0.5 * setting.geometry.planet_bore);
        // a radius of 0 switches the friction of a surface off
        if pin == 0.0 {
            return None;
        }
        let limit = toe_root(setting.pair, 0);
        let (other, misfit, what) = if bore > 0.0 {
            let fits = (1.0 - CLEARANCE) * bore..=(1.0 + ROUNDING) * bore;
            (bore, !fits.contains(&pin), "does not match the planet's bore of radius")
        } else {
            (limit, pin >= limit, "is not less than the planet's root circle at the toe,")
        };
        misfit.then(|| misfitting("thrust_friction.pin_radius", pin, what, other))
    }

    /// Warning if the given washer radius does not fit gear `i`; `None` if it fits.
    fn misfit_of_washer(&self, setting: &EffectSetting, i: usize) -> Option<Problem> {
        let names = ["thrust_friction.planet_washer_radius", "thrust_friction.side_washer_radius"];
        let gear = ["planet", "side gear"][i];
        let radius = [self.planet_washer_radius, self.side_washer_radius][i];
        let (face, bore) = (back_face(setting.pair, i), [setting.geometry.planet_bore, setting.geometry.side_bore][i]);
        if radius == 0.0 {
            None
        } else if radius >= face {
            Some(misfitting(names[i], radius, &format!("is not less than the {gear}'s back face,"), face))
        } else if radius <= 0.5 * bore {
            Some(misfitting(names[i], radius, &format!("is within the {gear}'s bore of radius"), 0.5 * bore))
        } else {
            None
        }
    }
}

/// Warning about a radius [m] that does not fit another one; `what` describes the misfit.
fn misfitting(name: &'static str, radius: f64, what: &str, other: f64) -> Problem {
    let [radius, other] = distinct_texts([radius * PER_MM, other * PER_MM], 3);
    problem!(name, "{radius} mm {what} {other} mm; {HINT}")
}

/// Advice for radii that do not fit.
const HINT: &str = "fit it to the gears, or set thrust_friction.radii_from_geometry = true";

impl Effect for ThrustFrictionSpec {
    fn check(&self, _: &EffectSetting, found: &mut Vec<Problem>) {
        check_slip!("thrust_friction", self.sliding, found);
    }

    fn warnings(&self, setting: &EffectSetting) -> Vec<Problem> {
        if self.radii_from_geometry {
            return Vec::new();
        }
        let washers = [0, 1].map(|i| self.misfit_of_washer(setting, i));
        self.misfit_of_pin(setting).into_iter().chain(washers.into_iter().flatten()).collect()
    }

    fn add_surfaces(&self, setting: &EffectSetting, surfaces: &mut Vec<RubbingSurface>) {
        let [planet, side] = setting.pair.gears.map(|gear| f64::from(gear.teeth));
        let ratio = planet / side;
        let Radii { pin, washer: washer_radius } = self.radii(setting);
        let by_thrust = |per_thrust: f64| ByLoad { per_thrust, ..ByLoad::NONE };
        let by_load = |per_load: f64| ByLoad { per_load, ..ByLoad::NONE };
        let surface = |kind: RubbingKind, radius: f64, [limit, pressed]: [ByLoad; 2]| RubbingSurface {
            limit,
            radius,
            pressed,
            sliding: self.sliding,
            temperature: SurfaceTemperature::Node(WASHERS),
            ..RubbingSurface::new(kind, setting.heat_index)
        };
        let washer = |kind: RubbingKind, radius: f64, area: f64| {
            surface(kind, radius, [by_thrust(self.coefficient * radius), by_thrust(radius / area)])
        };
        let on_side = washer(RubbingKind::Side, washer_radius[1], self.side_washer_area);
        let on_planet = washer(RubbingKind::Planet, washer_radius[0], self.planet_washer_area);
        let pin =
            surface(RubbingKind::Planet, pin, [by_load(self.pin_coefficient * pin), by_load(pin / self.pin_area)]);
        surfaces.extend([
            RubbingSurface { stiffness: self.stiffness, thrust_part: ThrustPart::Washer, ..on_side },
            RubbingSurface { place: " on its pin", stiffness: self.stiffness * ratio * ratio, ..pin },
            RubbingSurface { place: " on its washer", ..on_planet },
        ]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declaration::Rows;
    use crate::model::setup::Parameters;

    /// The study's gears, scaled.
    fn scaled(by: f64) -> Parameters {
        let mut p = Parameters::default();
        p.effects.thrust_friction = true;
        let g = &mut p.geometry;
        (g.module, g.face_width, g.backlash) = (by * g.module, by * g.face_width, by * g.backlash);
        p
    }

    fn radii(p: &Parameters) -> Radii {
        let pair = Pair::new(&p.gears());
        p.specs.thrust_friction.radii(&p.scene_effects(&pair).setting)
    }

    fn warned(p: &Parameters) -> Vec<&'static str> {
        let pair = Pair::new(&p.gears());
        p.scene_effects(&pair).warnings().iter().map(|problem| problem.variable).collect()
    }

    #[test]
    fn radii_grow_with_the_gears_from_the_start_values_of_the_study() {
        let start = radii(&scaled(1.0));
        let mut p = scaled(1.0);
        p.specs.thrust_friction.radii_from_geometry = true;
        let study = radii(&p);
        let all = |radii: Radii| [radii.pin, radii.washer[0], radii.washer[1]];
        for (given, found) in all(start).into_iter().zip(all(study)) {
            assert!((found / given - 1.0).abs() < 0.05, "{found} for {given}");
        }
        let mut p = scaled(2.0);
        p.specs.thrust_friction.radii_from_geometry = true;
        // Gleason's clearance of 0.05 mm does not grow
        assert!((radii(&p).pin / (2.0 * study.pin) - 1.0).abs() < 2e-3);
        assert!((radii(&p).washer[1] / (2.0 * study.washer[1]) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn a_pin_fills_its_bore_and_washers_surround_the_bores() {
        let mut p = scaled(1.0);
        p.specs.thrust_friction.radii_from_geometry = true;
        (p.geometry.planet_bore, p.geometry.side_bore) = (14e-3, 30e-3);
        let pair = Pair::new(&p.gears());
        let found = radii(&p);
        assert_eq!(found.pin, 7e-3);
        assert_eq!(found.washer, [0.5 * (7e-3 + back_face(&pair, 0)), 0.5 * (15e-3 + back_face(&pair, 1))]);
        assert!(warned(&p).is_empty());
    }

    #[test]
    fn radii_that_do_not_fit_are_named() {
        assert!(warned(&scaled(1.0)).is_empty());
        let [pin, planet, side] = ["pin", "planet_washer", "side_washer"].map(|part| {
            let rows = ThrustFrictionSpec::rows();
            rows.iter().map(|row| row.name).find(|name| name.contains(&format!("{part}_radius"))).unwrap()
        });
        // the same pins and washers on gears of half the size
        assert_eq!(warned(&scaled(0.5)), [pin, planet, side]);
        let mut p = scaled(0.5);
        p.specs.thrust_friction.radii_from_geometry = true;
        assert!(warned(&p).is_empty());
        // bores wider and narrower than the pins of 8 mm
        for (bore, named) in [(16e-3, vec![]), (16.3e-3, vec![]), (17e-3, vec![pin]), (15.9e-3, vec![pin])] {
            let mut p = scaled(1.0);
            p.geometry.planet_bore = bore;
            assert_eq!(warned(&p), named, "bore {bore}");
        }
        let mut p = scaled(1.0);
        p.geometry.side_bore = 45e-3;
        assert_eq!(warned(&p), [side]);
    }
}

//! Advice on settings that are allowed and likely not meant.

use super::Parameters;
use crate::contact::ContactLaw;
use crate::model::scene::{GearContact, PlanetSpin, SideDrive};
use crate::problem::Problem;

/// What is likely not meant in `p`.
pub fn warnings(p: &Parameters) -> Vec<Problem> {
    stiffness_of_the_study(p).into_iter().chain(imposed_bias(p)).collect()
}

/// Friction whose bias nothing can show: the loads are given, and friction moves torque to what imposes the spin.
fn imposed_bias(p: &Parameters) -> Option<Problem> {
    let (scene, effects) = (&p.scene, &p.effects);
    let rubs = effects.tooth_friction || effects.thrust_friction || effects.limited_slip;
    let imposed =
        scene.planet_spin == PlanetSpin::Imposed && [scene.left_drive, scene.right_drive] == [SideDrive::Torque; 2];
    (rubs && imposed).then(|| {
        Problem::new(
            "torque_bias_ratio",
            "it is the ratio of left.load_torque and right.load_torque, whatever rubs: with scene.planet_spin = imposed friction \
             acts on planet.spin_torque; for the bias impose the speeds of the wheels by scene.left_drive and scene.right_drive",
        )
    })
}

/// Own gears with the stiffness of the study's.
fn stiffness_of_the_study(p: &Parameters) -> Option<Problem> {
    let start = Parameters::default();
    let (gears, usual) = (&p.geometry, &start.geometry);
    let own_gears = [
        (gears.module, usual.module),
        (gears.face_width, usual.face_width),
        (gears.pressure_angle, usual.pressure_angle),
        (f64::from(gears.planet_teeth), f64::from(usual.planet_teeth)),
        (f64::from(gears.side_teeth), f64::from(usual.side_teeth)),
    ]
    .iter()
    .any(|(own, usual)| own != usual);
    let (contact, as_built) = (&p.contact, &start.contact);
    let of_the_study = contact.law == ContactLaw::Impact
        && !contact.stiffness_from_hertz
        && (contact.stiffness, contact.exponent) == (as_built.stiffness, as_built.exponent);
    if p.scene.gear_contact != GearContact::Tooth || !own_gears || !of_the_study {
        return None;
    }
    Some(Problem::new(
        "contact.law",
        "impact has the stiffness of the study's gears, and these are others: mean speeds and forces hold all the same; for \
         deflection, transmission error, ripple and peak forces choose line_weber with effects.body_compliance, or line, whose \
         stiffness follows from the gears; or give contact.stiffness a value of your own",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bias_that_is_imposed_is_noticed_where_something_rubs() {
        let warned = |change: fn(&mut Parameters)| {
            let mut p = Parameters::default();
            (p.scene.planet_spin, p.effects.thrust_friction) = (PlanetSpin::Imposed, true);
            change(&mut p);
            warnings(&p).iter().any(|problem| problem.to_string().contains("torque_bias_ratio"))
        };
        assert!(warned(|_| ()));
        assert!(warned(|p| (p.effects.thrust_friction, p.effects.limited_slip) = (false, true)));
        assert!(!warned(|p| p.effects.thrust_friction = false));
        assert!(!warned(|p| p.scene.planet_spin = PlanetSpin::Free));
        assert!(!warned(|p| p.scene.right_drive = SideDrive::Speed));
    }

    #[test]
    fn own_gears_with_the_stiffness_of_the_study_are_noticed_and_the_study_is_not() {
        let warned = |change: fn(&mut Parameters)| {
            let mut p = Parameters::default();
            change(&mut p);
            !warnings(&p).is_empty()
        };
        assert!(!warned(|_| ()));
        assert!(!warned(|p| p.geometry.backlash *= 2.0));
        assert!(warned(|p| p.geometry.module = 3e-3));
        assert!(warned(|p| p.geometry.side_teeth = 18));
        for quiet in [
            (|p| p.contact.law = ContactLaw::Line) as fn(&mut Parameters),
            |p| p.contact.stiffness_from_hertz = true,
            |p| p.contact.stiffness *= 2.0,
            |p| p.scene.gear_contact = GearContact::Lumped,
        ] {
            let mut p = Parameters::default();
            p.geometry.module = 3e-3;
            quiet(&mut p);
            assert!(warnings(&p).is_empty());
        }
    }
}

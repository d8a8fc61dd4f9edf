//! Advice on settings that are allowed but probably not intended.

use super::Parameters;
use crate::contact::ContactLaw;
use crate::model::scene::{CarrierDrive, GearContact, Inputs, PlanetSpin, SideDrive};
use crate::problem::Problem;

/// Warnings about settings in `p` that are probably not intended.
pub fn warnings(p: &Parameters) -> Vec<Problem> {
    stiffness_of_the_study(p).into_iter().chain(imposed_bias(p)).collect()
}

/// Warning if friction has no visible torque bias because both loads and the spin are given. Friction then changes only
/// the torque that imposes the spin.
fn imposed_bias(p: &Parameters) -> Option<Problem> {
    let scene = &p.scene;
    let imposed =
        scene.planet_spin == PlanetSpin::Imposed && [scene.left_drive, scene.right_drive] == [SideDrive::Torque; 2];
    (p.effects.bias_torque() && imposed).then(|| {
        Problem::new(
            "torque_bias_ratio",
            "it is the ratio of left.load_torque and right.load_torque, regardless of friction: with \
             scene.planet_spin = imposed, friction acts on spin.torque; to see the bias, impose the speeds of the \
             wheels by scene.left_drive and scene.right_drive",
        )
    })
}

/// Warning if load torques that nobody set turn the wheels backward from rest. `is_set` is true for the loads that were
/// set, left and right.
///
/// From rest, the carrier's torque T and the loads L accelerate the mean speed in proportion to T − L_left − L_right.
/// If the other wheel has an imposed speed, a wheel that is driven by torque accelerates in proportion to T/2 − L.
/// Brakes resist up to their torques.
pub fn turned_backward(p: &Parameters, inputs: &Inputs, is_set: [bool; 2]) -> Option<Problem> {
    let scene = &p.scene;
    let by_torque = [scene.left_drive, scene.right_drive].map(|drive| drive == SideDrive::Torque);
    let share = match (by_torque, scene.planet_spin) {
        ([true, true], _) => 1.0,
        ([false, false], _) | (_, PlanetSpin::Imposed) => return None,
        _ => 0.5,
    };
    if scene.carrier_drive != CarrierDrive::Torque {
        return None;
    }
    let torque = share * inputs.carrier_torque;
    let load = |s: usize| if by_torque[s] { inputs.load_torque[s] } else { 0.0 };
    let is_unset = |s: &usize| !is_set[*s] && load(*s) != 0.0;
    let given: f64 = (0..2).filter(|&s| is_set[s]).map(load).sum();
    let unset: f64 = (0..2).filter(is_unset).map(load).sum();
    let brakes: f64 = if p.effects.wheel_brake { inputs.brake_torque.iter().sum() } else { 0.0 };
    // components along the direction in which the unset loads turn the wheels
    let [net, drive, only_unset, only_given] =
        [unset + given - torque, -torque, unset - torque, given - torque].map(|of| of * unset.signum());
    // no warning if the wheels do not turn backward, or if the loads that were set turn them and the others do not
    if unset == 0.0 || net <= brakes || only_given > 0.0 && only_unset <= 0.0 {
        return None;
    }
    let names: Vec<String> =
        (0..2).filter(is_unset).map(|s| format!("{} = {} N.m", LOADS[s], inputs.load_torque[s])).collect();
    let turned = if drive > 0.0 {
        "has the direction in which the loads turn the wheels, so that they drive instead of resisting"
    } else {
        "is less than the loads, which turn the wheels backward from rest"
    };
    let side = (0..2).find(is_unset)?;
    Some(problem!(
        LOADS[side],
        "nobody set {}; {} {} N.m {turned}: set the loads, or resist with left.brake_torque and right.brake_torque \
         and loads of 0",
        names.join(" and "),
        if share < 1.0 { "the share of this wheel in carrier.torque_command," } else { "carrier.torque_command =" },
        torque
    ))
}

/// Inputs that load the wheels.
const LOADS: [&str; 2] = ["left.load_torque", "right.load_torque"];

/// Warning if gears differ from the study's gears but have their contact stiffness.
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
    let (contact, usual_contact) = (&p.contact, &start.contact);
    let of_the_study = contact.law == ContactLaw::Impact
        && !contact.stiffness_from_hertz
        && (contact.stiffness, contact.exponent) == (usual_contact.stiffness, usual_contact.exponent);
    if p.scene.gear_contact != GearContact::Tooth || !own_gears || !of_the_study {
        return None;
    }
    Some(Problem::new(
        "contact.law",
        "impact has the stiffness of the study's gears, but these gears differ from them: mean speeds and forces are \
         valid anyway; for deflection, transmission error, ripple and peak forces, choose line_weber with \
         effects.body_compliance, or line, whose stiffness follows from the gears; or give contact.stiffness a value \
         of your own",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_imposed_bias_is_reported_if_there_is_friction() {
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
    fn other_gears_with_the_stiffness_of_the_study_are_reported_and_the_study_is_not() {
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

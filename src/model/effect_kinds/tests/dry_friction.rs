//! Tests of dry friction with sticking.

use super::body_friction::{BodyFriction, MOST_SURFACES};
use super::dry_friction::*;
use super::friction::Friction;
use super::friction_state::{FrictionState, Mode};
use super::rubbing_surface::{ByLoad, RubbingSurface, Slip, SurfaceLoad};
use crate::model::assembly::{Given, Model};
use crate::model::scene::RubbingKind;
use crate::model::setup::Parameters;

const STIFFNESS: f64 = 1e3;

/// A slip under a load.
fn under<'a>(slip: &'a Slip, load: &'a SurfaceLoad) -> LoadedSlip<'a> {
    LoadedSlip { slip, load }
}

/// A surface whose limit torque is its load, with a spring.
fn surface(stiffness: f64) -> RubbingSurface {
    let limit = ByLoad { per_load: 1.0, ..ByLoad::NONE };
    RubbingSurface { limit, stiffness, ..RubbingSurface::new(RubbingKind::Side, 0) }
}

/// A body whose limit torque is its load.
fn by_load(mut body: BodyFriction) -> BodyFriction {
    body.push((0, &surface(STIFFNESS)), [1.0, 1.0, DAMPING_TIME]);
    body
}

fn clutch() -> BodyFriction {
    by_load(BodyFriction::new(DAMPING_TIME, 0))
}

fn pressed(load: f64) -> SurfaceLoad {
    SurfaceLoad { thrust: 0.0, load }
}

#[test]
fn a_body_stops_with_the_torque_its_spring_was_wound_to() {
    let (clutch, sources) = (clutch(), [surface(STIFFNESS)]);
    let clutch = DryFriction::new(&clutch, &sources);
    // sliding at a limit of 10 N·m winds the spring to 10 N·m
    let anchor = clutch.drag(0.0, 0.5, 10.0);
    assert!((STIFFNESS * (0.5 - anchor) - 10.0).abs() < 1e-9);
    // the load rises a hundredfold while the body slides by 1 mrad, which winds the spring by 1 N·m
    let anchor = clutch.drag(anchor, 0.501, 1000.0);
    assert!((STIFFNESS * (0.501 - anchor) - 11.0).abs() < 1e-9);
    let mut hold = FrictionState { mode: Mode::Forward, anchor, stiffness: STIFFNESS };
    let mut heat = [0.0];
    let stopped = Slip { position: 0.501, speed: -1e-7 };
    clutch.settle(&mut hold, under(&stopped, &pressed(1000.0)), true, 1.0, &mut heat);
    assert_eq!(hold.mode, Mode::Stuck);
    assert!((clutch.torque(&hold, &Slip { speed: 0.0, ..stopped }, &pressed(1000.0)) - 11.0).abs() < 1e-9);
}

#[test]
fn a_crossing_from_one_limit_to_the_other_is_found_in_one_call() {
    let (clutch, sources, by) = (clutch(), [surface(STIFFNESS)], pressed(10.0));
    let clutch = DryFriction::new(&clutch, &sources);
    // the spring is wound to +10 N·m at 0 and turned back: −10 N·m is reached at −20 mrad, a fifth of the way to −100
    // mrad; damping reaches the limit earlier, by the rotation within the damping time
    let hold = FrictionState { mode: Mode::Stuck, anchor: -0.01, stiffness: STIFFNESS };
    let turn = |position| Slip { position, speed: -1.0 };
    let part = clutch.crossing(&hold, under(&turn(0.0), &by), under(&turn(-0.1), &by)).unwrap();
    let shift = DAMPING_TIME * 1.0;
    assert!((part * 0.1 - (0.02 - shift)).abs() < 1e-6, "{part}");
}

#[test]
fn a_held_body_slides_when_its_command_falls_below_its_torque() {
    let (brake, sources) = (by_load(BodyFriction::commanded(DAMPING_TIME, 0)), [surface(STIFFNESS)]);
    let brake = DryFriction::new(&brake, &sources);
    // the brake holds 4 N·m while its command falls from 10 N·m to 0: the limit is reached after six tenths of the step
    let hold = FrictionState { mode: Mode::Stuck, anchor: 0.0, stiffness: STIFFNESS };
    for speed in [0.0, 1e-12, -1e-12] {
        let turn = Slip { position: 4.0 / STIFFNESS, speed };
        let part = brake.crossing(&hold, under(&turn, &pressed(10.0)), under(&turn, &pressed(0.0))).unwrap();
        assert!((part - 0.6).abs() < 1e-4, "{part}");
        assert!(brake.is_due(&hold, &turn, &pressed(3.9), false) && !brake.is_due(&hold, &turn, &pressed(4.1), false));
    }
    // a command of 0 N·m holds nothing: a body that reverses continues to slide
    let mut slides = FrictionState { mode: Mode::Forward, ..hold };
    brake.settle(&mut slides, under(&Slip { position: 0.0, speed: -0.1 }, &pressed(0.0)), false, 1.0, &mut [0.0]);
    assert_eq!(slides.mode, Mode::Backward);
}

#[test]
fn no_change_of_stiffness_gives_a_spring_energy() {
    let turn = Slip { position: 0.01, speed: 0.0 };
    for stiffness in [10.0, 1e3, 1e5] {
        let mut hold = FrictionState { mode: Mode::Stuck, anchor: 0.0, stiffness };
        let before = 0.5 * stiffness * 1e-4;
        let mut heat = [0.0];
        let (clutch, sources) = (clutch(), [surface(STIFFNESS)]);
        let clutch = DryFriction::new(&clutch, &sources);
        clutch.adapt(&mut hold, &turn, &mut heat, 1.0);
        let after = clutch.energy(&hold, turn.position);
        assert!(after <= before * (1.0 + 1e-12), "{stiffness}: {before} J became {after} J");
        assert!((heat.iter().sum::<f64>() - (before - after)).abs() < 1e-12);
    }
}

#[test]
fn a_body_at_exactly_zero_speed_sticks_unless_it_accelerates_further() {
    let (sources, by) = ([surface(STIFFNESS)], pressed(10.0));
    let (clutch, brake) = (clutch(), by_load(BodyFriction::commanded(DAMPING_TIME, 0)));
    // a jump of an imposed speed may leave a braked wheel at a speed of some ulps
    for (body, speeds) in [(&clutch, &[0.0, -0.0][..]), (&brake, &[0.0, -0.0, 1e-15])] {
        let friction = DryFriction::new(body, &sources);
        for mode in [Mode::Forward, Mode::Backward] {
            let wound = mode.direction() * 10.0 / STIFFNESS;
            let slides = FrictionState { mode, anchor: -wound, stiffness: STIFFNESS };
            for speed in speeds {
                let slip = Slip { position: 0.0, speed: speed * mode.direction() };
                assert!(friction.is_due(&slides, &slip, &by, true), "{mode:?} at {speed:e} rad/s stops");
                assert!(!friction.is_due(&slides, &slip, &by, false), "{mode:?} at {speed:e} rad/s was just released");
                let mut state = slides;
                friction.settle(&mut state, under(&slip, &by), true, 1.0, &mut [0.0]);
                assert_eq!(state.mode, Mode::Stuck);
                // the spring has exactly the limit torque, which does not release the body again
                assert!(!friction.is_due(&state, &Slip { position: 0.0, speed: 0.0 }, &by, false));
            }
            // beyond the speed tolerance, the sign of the speed decides
            let fast = Slip { position: 0.0, speed: 1e-3 * mode.direction() };
            assert!(!friction.is_due(&slides, &fast, &by, true));
        }
    }
}

#[test]
fn a_body_that_nearly_stands_still_does_not_stick_if_damping_releases_it_at_once() {
    // the speed is resolved to 5e-7 rad/s, where the damping torque of 0.1 N·m·s/rad is half of the limit; the torque
    // of the other 3e-7 rad/s counts, and the spring has up to the limit torque
    let (brake, sources, by) = (by_load(BodyFriction::commanded(DAMPING_TIME, 0)), [surface(STIFFNESS)], pressed(1e-7));
    let brake = DryFriction::new(&brake, &sources);
    for mode in [Mode::Forward, Mode::Backward] {
        for wound in [1.0, 0.8, 0.5, 0.0] {
            let anchor = -mode.direction() * wound * 1e-7 / STIFFNESS;
            let mut state = FrictionState { mode, anchor, stiffness: STIFFNESS };
            let slip = Slip { position: 0.0, speed: 8e-7 * mode.direction() };
            brake.settle(&mut state, under(&slip, &by), true, 1.0, &mut [0.0]);
            assert_eq!(state.mode, if wound > 0.6 { mode } else { Mode::Stuck }, "{mode:?} wound to {wound}");
            assert!(!brake.is_due(&state, &slip, &by, true), "{mode:?} wound to {wound} switches back");
        }
    }
}

#[test]
fn the_sign_of_an_unresolved_speed_neither_holds_nor_releases_a_body() {
    let (clutch, sources, by) = (clutch(), [surface(STIFFNESS)], pressed(10.0));
    let clutch = DryFriction::new(&clutch, &sources);
    for sign in [1.0, -1.0] {
        let hold = FrictionState { mode: Mode::Stuck, anchor: 0.0, stiffness: STIFFNESS };
        let at = |torque: f64, speed: f64| Slip { position: sign * torque / STIFFNESS, speed: sign * speed };
        for speed in [2e-7, 0.0, -2e-7] {
            // the load winds the spring beyond its limit, and the body slides as long as nothing stops it
            assert!(clutch.crossing(&hold, under(&at(10.0, 0.0), &by), under(&at(10.001, speed), &by)).is_some());
            let mut state = hold;
            clutch.settle(&mut state, under(&at(10.001, speed), &by), false, 1.0, &mut [0.0]);
            assert_eq!(state.mode, if sign > 0.0 { Mode::Forward } else { Mode::Backward }, "{speed}");
            assert!(!clutch.is_due(&state, &at(10.001, speed), &by, false), "{speed}: sticks immediately");
            // a spring at its limit is held, also if damping adds a torque
            assert_eq!(clutch.crossing(&hold, under(&at(10.0, 0.0), &by), under(&at(10.0, speed), &by)), None);
            assert!(!clutch.is_due(&hold, &at(10.0, speed), &by, false), "{speed}: slides at its limit");
        }
    }
}

#[test]
fn a_spring_that_rounding_winds_beyond_the_limit_does_not_slide() {
    // the rounding of an angle of one turn, 2.8e-15 rad, is 2.8e-6 N·m in this spring: far more than the tolerance of
    // 1e-5 of 1 mN·m
    let stiff = 1e9;
    let mut body = BodyFriction::commanded(DAMPING_TIME, 0);
    body.push((0, &surface(stiff)), [1.0, 1.0, DAMPING_TIME]);
    let (sources, by) = ([surface(STIFFNESS)], pressed(1e-3));
    let brake = DryFriction::new(&body, &sources);
    for sign in [1.0, -1.0] {
        let hold = FrictionState { mode: Mode::Stuck, anchor: 0.0, stiffness: stiff };
        let at = |torque: f64| Slip { position: sign * torque / stiff, speed: 0.0 };
        assert!(!brake.is_due(&hold, &at(1e-3 + 5e-7), &by, false));
        assert_eq!(brake.crossing(&hold, under(&at(0.9e-3), &by), under(&at(1e-3 + 2e-6), &by)), None);
        assert!(brake.is_due(&hold, &at(1e-3 + 1e-5), &by, false));
        assert!(brake.crossing(&hold, under(&at(0.9e-3), &by), under(&at(1e-3 + 1e-4), &by)).is_some());
        // the step ends at a speed whose damping torque is below the limit: 1e5 N·m·s/rad at 1e-6 rad/s would be 100
        // times the limit
        let slides = FrictionState { mode: Mode::Forward, anchor: 0.0, stiffness: stiff };
        let moving = |speed: f64| Slip { position: 0.0, speed };
        assert!(brake.crossing(&slides, under(&moving(1e-3), &by), under(&moving(-4e-9), &by)).is_none());
        assert!(brake.crossing(&slides, under(&moving(1e-3), &by), under(&moving(-1e-7), &by)).is_some());
    }
}

#[test]
fn all_frictions_of_a_side_gear_fit_on_it_and_more_are_refused() {
    let mut p = Parameters::default();
    (p.effects.thrust_friction, p.effects.limited_slip) = (true, true);
    p.specs.limited_slip.curve[0].torque = 1.0;
    let model = Model::new(&p, &Given::default()).unwrap();
    // washer, clutch pack with its measured curve, and lock
    let mut surfaces = model.body_effects().surfaces.clone();
    surfaces.retain(|surface| surface.kind == RubbingKind::Side);
    assert_eq!(surfaces.len(), MOST_SURFACES);
    let mut surfaces = vec![surface(STIFFNESS); MOST_SURFACES];
    assert!(Friction::check(&surfaces).is_ok());
    surfaces.push(surface(STIFFNESS));
    let refused = Friction::check(&surfaces).unwrap_err();
    assert!(refused.to_string().contains("5 dry frictions on one body, but it takes at most 4"), "{refused}");
}

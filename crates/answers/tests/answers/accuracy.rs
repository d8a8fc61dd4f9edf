//! Questions of accuracy about scenes with answers in closed form.

use std::hint::spin_loop;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use answers::accuracy::answer::{Answer, Role};
use answers::accuracy::gears::Gears;
use answers::accuracy::{Question, answer, chosen, report};
use answers::progress::Progress;
use answers::scene::run::{SceneRun, run};
use answers::scene::{Scene, load};
use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Method};
use bevel_differential::variables::effective::{self, Situation};
use bevel_differential::variables::{index_of, named};

/// No teeth, 50 rad/s, 99 N.m on each side.
const IDEAL: &str = r#"
description = "closed form"
stop_time = 0.02
step = 1e-3
outputs = ["carrier.torque", "carrier.speed"]

[set]
scene.gear_contact = "ideal"
carrier.speed_command = 50.0
left.load_torque = 99.0
right.load_torque = 99.0
"#;

/// Carrier drag of 2 N.m at all but the lowest speeds: 1 % of the drive's torque of 200 N.m.
const DRAG: &str = "bearing_drag.carrier_torque = 2.0
bearing_drag.carrier_viscous = 0.0
bearing_drag.carrier_churning = 0.0
bearing_drag.side_torque = 0.0
bearing_drag.side_viscous = 0.0
";

/// Teeth under load, for two tooth cycles.
const TEETH: &str = r#"
description = "teeth"
stop_time = 0.04
step = 2e-4
outputs = ["left.speed"]

[set]
carrier.speed_command = "954 deg/s"
scene.planet_spin = "imposed"
spin.command = "200 deg/s"
left.load_torque = "400 N.m"
right.load_torque = "400 N.m"
"#;

fn parsed(text: &str) -> Scene {
    load::parse("test", Path::new("test.toml"), text).expect("a scene")
}

fn asked(text: &str, wants: &[&str], within: f64) -> Answer {
    let wants = wants.iter().map(|want| (*want).to_owned()).collect();
    let question = Question { wants, within, from: 0.0 };
    answer(&parsed(text), &question, &mut Progress::silent()).expect("an answer")
}

fn role<'a>(found: &'a Answer, name: &str) -> &'a Role {
    found.effects.iter().find(|(switch, _)| switch.name() == name).map(|(_, role)| role).expect(name)
}

#[test]
fn a_drag_of_one_percent_is_needed_for_less_and_not_for_more() {
    for (on, within, wanted) in [("", 0.009, true), ("", 0.011, false), ("effects.bearing_drag = true\n", 0.009, true)]
    {
        let found = asked(&format!("{IDEAL}{DRAG}{on}"), &["carrier.torque:mean"], within);
        let Role::Acts { by, chosen } = role(&found, "bearing_drag") else { panic!("no role") };
        // closed form, except for rounding
        assert!((by / 0.01 - 1.0).abs() < 1e-9, "{by}");
        assert_eq!(*chosen, wanted);
        let p = found.choice().expect("a setting").scene.parameters;
        assert_eq!((p.effects.bearing_drag, p.scene.gear_contact), (wanted, GearContact::Ideal));
    }
}

#[test]
fn small_effects_are_kept_if_they_are_too_large_together() {
    // 50 rad/s and 100 N.m on each side: 10 kW. The drag of 1.3 N.m takes 65 W of it, and two clutches of 7 N.m that
    // slip at 10/16 of the spin of 8 rad/s take 70 W.
    let text = format!(
        "{}{}scene.planet_spin = \"imposed\"\nspin.command = 8.0\n\
         effects.limited_slip = true\nlimited_slip.torque_coefficient = 0.0\nlimited_slip.preload = 7.0\n",
        IDEAL.replace("99.0", "100.0"),
        DRAG.replace("= 2.0", "= 1.3")
    );
    let on = |within| {
        let found = asked(&text, &["power.in:mean"], within);
        assert!(found.choice().expect("a setting").error() <= within);
        let p = found.choice().expect("a setting").scene.parameters.effects;
        usize::from(p.bearing_drag) + usize::from(p.limited_slip)
    };
    assert_eq!([on(0.005), on(0.01), on(0.014)], [2, 1, 0]);
}

#[test]
fn transmission_errors_call_for_a_law_from_geometry_and_name_the_grade_that_is_zero() {
    let want = "planet[1].left_transmission_error:mean";
    let found = asked(TEETH, &[want], 0.05);
    let gears = Gears::of(&found.choice().expect("a setting").scene.parameters);
    assert!(gears.level == GearContact::Tooth && gears.law != ContactLaw::Impact, "{}", gears.text());
    assert_eq!(Gears::of(&found.reference.scene.parameters).text(), "tooth line_weber + gear bodies");
    let Role::Neutral { typical, by: Some(by), now: _ } = role(&found, "tooth_errors") else { panic!("not neutral") };
    assert!(typical.iter().any(|(row, value)| row.name == "tooth_errors.accuracy_grade" && *value == 7.0));
    assert!(*by > 0.0);
    let text = report::text(&found);
    for part in [want, "accuracy_grade = 7", "tooth impact is off by", "corner_contact"] {
        assert!(text.split_whitespace().collect::<Vec<_>>().join(" ").contains(part), "{part}\n{text}");
    }
}

#[test]
fn the_lines_of_an_answer_are_the_same_on_slow_and_on_fast_machines() {
    let mut found = asked(TEETH, &["left.speed:mean"], 0.01);
    let chosen = found.chosen.expect("a setting");
    let mut timed = |start: f64, seconds: f64| {
        let effort = &mut found.trials[chosen].effort;
        (effort.start, effort.seconds) = (start, seconds);
        let said = report::text(&found);
        let is_number = |word: &&str| word.contains(|c: char| c.is_ascii_digit());
        said.split_whitespace()
            .map(|word| if is_number(&word) { "(number)" } else { word })
            .collect::<Vec<_>>()
            .join(" ")
    };
    let fast = timed(2e-3, 5e-3);
    assert!(fast.contains("The start takes"), "{fast}");
    assert_eq!(fast, timed(2e-3, 50.0));
    assert_eq!(fast, timed(2.0, 5e-3));
}

#[test]
fn a_mean_speed_calls_for_no_teeth() {
    let found = asked(TEETH, &["left.speed:mean"], 0.01);
    let p = found.choice().expect("a setting").scene.parameters;
    assert_eq!(p.scene.gear_contact, GearContact::Ideal);
    // Willis: 954 + 200 · 10/16 deg/s
    assert!((found.reference.values[0] / 1079f64.to_radians() - 1.0).abs() < 0.01, "{}", found.reference.values[0]);
    assert!(found.choice().expect("a setting").cost < 0.2 * found.reference.cost);
}

#[test]
fn a_scene_that_sets_the_stiffness_of_its_law_keeps_this_law() {
    let found = asked(&format!("{TEETH}contact.stiffness = 1e10\n"), &["left.speed:peak_to_peak"], 0.05);
    let gears = Gears::of(&found.reference.scene.parameters);
    assert_eq!((gears.law, gears.has_bodies), (ContactLaw::Impact, false));
    assert!(found.gears.iter().all(|(gears, _)| gears.law == ContactLaw::Impact));
}

#[test]
fn outputs_of_strength_are_included_only_if_wanted() {
    let found = asked(TEETH, &["stress.contact_max:max"], 0.05);
    assert!(found.choice().expect("a setting").scene.parameters.effects.strength);
    // a safety factor is 1000 at the start, where nothing is loaded yet
    let found = asked(TEETH, &["safety.root_min:final"], 0.005);
    let (trial, reference) = (found.choice().expect("a setting"), &found.reference);
    assert!(trial.scene.parameters.effects.strength);
    assert!((trial.values[0] / reference.values[0] - 1.0).abs() < 0.005, "{:?} {:?}", trial.values, reference.values);
    let found = asked(TEETH, &["left.speed:max"], 0.05);
    assert!(matches!(role(&found, "strength"), Role::NotAsked));
}

#[test]
fn the_written_scene_reproduces_the_values_of_the_search() {
    let found = asked(TEETH, &["left.speed:max", "planet[1].left_transmission_error:mean"], 0.02);
    let text = chosen::text(&found, TEETH).expect("a file");
    let scene = parsed(&text);
    assert_eq!(scene.parameters, found.choice().expect("a setting").scene.parameters);
    let result = run(&scene, None, &mut Progress::silent()).expect("a run");
    let trial = found.choice().expect("a setting");
    // this summary includes the start
    assert!(result.outputs[0].max >= trial.values[0] && result.outputs.len() == 2);
}

#[test]
fn a_scene_is_written_without_values_that_change_nothing() {
    let idle = "oil.temperature = \"80 degC\"
effects.thrust_friction = true
thrust_friction = { coefficient = 0.04, cold_factor = 1.5 }
contact.damping = 60e3

[[at]]
time = \"10 ms\"
thrust_friction.coefficient = 0.06

[[at]]
time = \"20 ms\"
left.load_torque = \"410 N.m\"
thrust_friction.coefficient = 0.05
";
    // the carrier's torque in a turn with little friction needs no teeth
    let found = asked(&format!("{TEETH}{idle}"), &["carrier.torque:mean"], 0.2);
    let text = chosen::text(&found, &format!("{TEETH}{idle}")).expect("a file");
    assert!(!text.contains("thrust_friction.") && !text.contains("oil."), "{text}");
    let scene = parsed(&text);
    for setting in &scene.settings {
        let index = index_of(setting.row.name).expect("a variable");
        assert!(effective::acts(index, &scene.parameters, Situation::START), "{}", setting.row.name);
    }
    assert_eq!(scene.events.iter().map(|event| event.settings.len()).collect::<Vec<_>>(), [1], "{text}");
    let started = SceneRun::start(&scene, scene.step).expect("a start");
    assert!(!started.warnings().iter().any(|warning| warning.contains("changes nothing")), "{text}");
}

#[test]
fn a_scene_that_cannot_run_states_the_reason() {
    let text = format!("{TEETH}scene.left_drive = \"speed\"\nscene.right_drive = \"speed\"\n");
    let question = Question { wants: vec!["left.speed:mean".into()], within: 0.01, from: 0.0 };
    let failed = answer(&parsed(&text), &question, &mut Progress::silent()).err().expect("three imposed speeds");
    assert!(format!("{failed:#}").contains("two independent speeds"), "{failed:#}");
}

/// Returns the scene `text` with fixed steps.
fn in_fixed_steps(text: &str) -> String {
    format!("{text}solver.method = \"fixed_step\"\n")
}

#[test]
fn an_answer_does_not_depend_on_the_load_of_the_machine() {
    let short = TEETH.replace("0.04", "0.01");
    for text in [short.clone(), in_fixed_steps(&short)] {
        let ask = || asked(&text, &["planet[1].left_transmission_error:mean"], 0.05);
        let quiet = ask();
        let is_over = AtomicBool::new(false);
        let busy = thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    while !is_over.load(Ordering::Relaxed) {
                        spin_loop();
                    }
                });
            }
            let busy = ask();
            is_over.store(true, Ordering::Relaxed);
            busy
        });
        assert_eq!((quiet.chosen, quiet.trials.len()), (busy.chosen, busy.trials.len()));
        for (quiet, busy) in quiet.trials.iter().zip(&busy.trials) {
            assert_eq!(quiet.scene.parameters, busy.scene.parameters);
            assert_eq!((&quiet.errors, quiet.cost), (&busy.errors, busy.cost));
        }
    }
}

#[test]
fn a_mirrored_scene_gets_the_same_setting() {
    let short = TEETH.replace("0.04", "0.01");
    let mirrored = short.replace("= \"954", "= \"-954").replace("= \"200", "= \"-200").replace("= \"400", "= \"-400");
    assert_eq!(mirrored.matches('-').count(), short.matches('-').count() + 4);
    for (text, mirrored) in [(short.clone(), mirrored.clone()), (in_fixed_steps(&short), in_fixed_steps(&mirrored))] {
        let setting = |text: &str| {
            let found = asked(text, &["left.speed:peak_to_peak"], 0.1);
            let run = found.choice().expect("a setting");
            (run.scene.parameters, run.error())
        };
        let [(here, error), (there, other)] = [setting(&text), setting(&mirrored)];
        assert_eq!(here, there);
        assert!((error - other).abs() < 1e-6 * error, "{error} {other}");
    }
}

/// Difference between the largest and the smallest value of the scene's first output at the communication points.
fn swing(scene: &Scene) -> f64 {
    let mut run = SceneRun::start(scene, scene.step).expect("a start");
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    while !run.is_over() {
        run.advance().expect("a step");
        let value = run.read(scene.outputs[0]);
        (least, most) = (least.min(value), most.max(value));
    }
    most - least
}

#[test]
fn a_scene_with_fixed_steps_gets_the_longest_that_are_accurate_enough() {
    let (text, within) = (in_fixed_steps(TEETH), 0.05);
    let found = asked(&text, &["left.speed:peak_to_peak"], within);
    let richest = found.reference.scene.parameters;
    assert_eq!(richest.solver.method, Method::Adaptive);
    let mut tight = found.reference.scene.clone();
    tight.parameters.solver.relative_tolerance = 1e-10;
    let wanted = swing(&tight);
    // the setting that a user runs
    let written = parsed(&chosen::text(&found, &text).expect("a file"));
    let solver = written.parameters.solver;
    assert_eq!(solver.method, Method::FixedStep);
    let error = |scene: &Scene| (swing(scene) / wanted - 1.0).abs();
    assert!(error(&written) <= within, "{}", error(&written));
    assert!((error(&written) - found.choice().expect("a setting").error()).abs() < 1e-3);
    // the next longer step in the sequence 1, 2, 5
    let longer = |factor: f64| {
        let mut scene = written.clone();
        scene.parameters.solver.fixed_step *= factor;
        error(&scene)
    };
    assert!(longer(2.0) > within, "{}", longer(2.0));
    assert!(solver.fixed_step < 2e-4, "{}", solver.fixed_step);
    let said = report::text(&found);
    assert!(said.contains(&format!("fixed steps of {:e} s", solver.fixed_step)), "{said}");
}

#[test]
fn an_accuracy_that_no_affordable_fixed_step_reaches_is_reported() {
    let short = TEETH.replace("0.04", "0.004");
    let ask = |text: &str| asked(text, &["left.speed:peak_to_peak"], 1e-4);
    let found = ask(&in_fixed_steps(&short));
    assert!(found.chosen.is_none() && ask(&short).chosen.is_some());
    let said = report::text(&found).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("no fixed steps that were tested are accurate enough")
            && said.contains("solver.method = adaptive"),
        "{said}"
    );
}

/// Turn of 40 ms with imposed wheel speeds and friction of washers, in which friction moves torque to the slower wheel.
const BIAS: &str = r#"
description = "bias"
stop_time = 0.04
step = 1e-3
outputs = ["torque_bias_ratio"]

[set]
scene.carrier_drive = "torque"
carrier.torque_command = "900 N.m"
scene.left_drive = "speed"
scene.right_drive = "speed"
left.speed_command = 52.5
right.speed_command = 47.5
effects.thrust_friction = true
"#;

#[test]
fn an_effect_that_saves_time_stays_on_if_the_scene_has_it() {
    let found = asked(BIAS, &["torque_bias_ratio:mean"], 0.02);
    let chosen = &found.trials[found.chosen.expect("a setting")];
    let parameters = &chosen.scene.parameters;
    assert!(parameters.scene.gear_contact == GearContact::Tooth && parameters.effects.teeth.corner_contact);
    // forces jump without corner contact, so the run takes more evaluations
    let mut without = chosen.scene.clone();
    without.parameters.effects.teeth.corner_contact = false;
    let evaluations = |scene: &Scene| {
        let mut run = SceneRun::start(scene, scene.step).expect("a run");
        while !run.is_over() {
            run.advance().expect("a step");
        }
        run.read(named("solver.rhs_calls").expect("a variable"))
    };
    let [with, without] = [&chosen.scene, &without].map(evaluations);
    assert!(without > with, "{without} evaluations without corner contact, {with} with it");
}

#[test]
fn a_scene_with_radau_gets_the_same_answer_as_with_the_adaptive_method() {
    let text = format!("{TEETH}solver.method = \"radau\"\n");
    let [radau, adaptive] = [&text, TEETH].map(|text| asked(text, &["left.speed:max"], 0.05));
    let [of_radau, of_adaptive] = [&radau, &adaptive].map(|found| found.choice().expect("a setting").scene.parameters);
    assert_eq!((of_radau, of_radau.solver.method), (of_adaptive, Method::Adaptive));
    let [said, other] = [&radau, &adaptive].map(report::text);
    assert!(
        said.contains("adaptive: the scene's method radau is for comparison") && !other.contains("radau"),
        "{said}"
    );
    assert_eq!(parsed(&chosen::text(&radau, &text).expect("a file")).parameters.solver.method, Method::Adaptive);
}

/// Clutch packs with ramps, sheared oil and a measured curve, and a lock with damping.
const CLUTCH: &str = "effects.limited_slip = true\nlimited_slip.torque_coefficient = 0.2\n\
    limited_slip.pressed_by = \"both_sides\"\nlimited_slip.coast_ratio = 0.25\n\
    limited_slip.viscous_torque = 20.0\nlimited_slip.viscous_speed = 5.0\nlimited_slip.viscous_exponent = 0.6\n\
    \"limited_slip.curve[1].slip\" = 1.0\n\"limited_slip.curve[1].torque\" = 30.0\n\
    \"limited_slip.curve[2].slip\" = 8.0\n\"limited_slip.curve[2].torque\" = 40.0\n\
    lock.damping_time = 2e-3\nlock.command = 0.1\n";

#[test]
fn the_search_never_changes_what_the_clutches_are() {
    let text = format!("{TEETH}{CLUTCH}");
    let given = parsed(&text).parameters.specs;
    let found = asked(&text, &["heat.clutch:max"], 0.05);
    let choice = found.choice().expect("a setting");
    for specs in [found.reference.scene.parameters.specs, choice.scene.parameters.specs] {
        assert_eq!((specs.limited_slip, specs.lock), (given.limited_slip, given.lock));
    }
    // without clutches, there would be no heat
    assert!(choice.scene.parameters.effects.limited_slip);
    let written = chosen::text(&found, &text).expect("a file");
    assert_eq!(parsed(&written).parameters.specs.limited_slip, given.limited_slip, "{written}");
}

#[test]
fn a_clutch_without_preload_that_does_not_slip_is_not_said_to_be_zero() {
    // equal loads and no spin: nothing slips, and nothing of the clutch acts
    for set in [
        "limited_slip.viscous_torque = 20.0\n",
        "\"limited_slip.curve[1].slip\" = 3.0\n\"limited_slip.curve[1].torque\" = 30.0\n",
    ] {
        let text = format!("{IDEAL}effects.limited_slip = true\n{set}");
        let found = asked(&text, &["carrier.torque:mean"], 0.01);
        let Role::Acts { by, chosen } = role(&found, "limited_slip") else { panic!("{}", report::text(&found)) };
        assert!(*by < 1e-9 && !chosen, "{by}");
    }
    // with values that are zero, the answer proposes one
    let found = asked(&format!("{IDEAL}effects.limited_slip = true\n"), &["carrier.torque:mean"], 0.01);
    assert!(matches!(role(&found, "limited_slip"), Role::Neutral { .. }));
}

/// Ideal gears behind a final drive whose mesh has an error of 20 um at 10 teeth per turn of the pinion.
const AXLE: &str = r#"
description = "axle"
stop_time = 0.3
step = 2e-4
outputs = ["carrier.speed"]

[set]
scene.gear_contact = "ideal"
pinion.speed_command = 200.0
left.load_torque = 200.0
right.load_torque = 200.0
effects.final_drive = true
inertia.pinion = 0.003
final_drive.elastic_mesh = true
final_drive.error_1 = "20 um"
final_drive.damping = "30 N.s/mm"
"#;

#[test]
fn a_final_drive_is_kept_and_its_mesh_is_elastic_only_for_what_it_moves() {
    for (want, within, elastic) in
        [("carrier.speed:mean", 0.01, false), ("ring_gear.tangential_force:peak_to_peak", 0.05, true)]
    {
        let found = asked(AXLE, &[want], within);
        let p = found.choice().expect("a setting").scene.parameters;
        assert_eq!((p.effects.final_drive, p.specs.final_drive.elastic_mesh), (true, elastic), "{want}");
        let Role::Kept(why) = role(&found, "final_drive") else { panic!("{}", report::text(&found)) };
        assert_eq!(why, "pinion.speed_command commands the scene");
        let Role::Acts { by, chosen } = role(&found, "final_drive errors") else { panic!("{}", report::text(&found)) };
        assert_eq!((*chosen, *by > within), (elastic, elastic), "{want}: {by}");
    }
    // the error moves the force by 210 N; the loads are 4440 N, or 111 N, from which the flanks lift off
    for (load, lifts_off) in [("200.0", false), ("5.0", true)] {
        let scene = AXLE.replace("load_torque = 200.0", &format!("load_torque = {load}"));
        let found = asked(&scene, &["ring_gear.tangential_force:peak_to_peak"], 0.05);
        let Role::Acts { by, .. } = role(&found, "final_drive.backlash") else { panic!("lash") };
        assert_eq!(*by > 0.05, lifts_off, "{load}: {by}");
    }
    // a rigid mesh has nothing to leave out
    let found = asked(&AXLE.replace("elastic_mesh = true", "elastic_mesh = false"), &["carrier.speed:mean"], 0.01);
    assert!(found.effects.iter().all(|(switch, _)| !switch.name().starts_with("final_drive.")));
}

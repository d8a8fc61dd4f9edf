//! Effects are switched on scenes whose answer is known in closed form.

use std::path::Path;

use anyhow::Result;
use fmu_build::gears::effects::bench::FULL;
use fmu_build::gears::effects::switches::{self, Standing};
use fmu_build::gears::effects::verdict::Verdict;
use fmu_build::gears::effects::{Finding, Findings, Question, csv, examine, reduced, table};
use fmu_build::gears::scene::run::run;
use fmu_build::gears::scene::{Scene, load};

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

/// A drag of the carrier that is 2 N.m at all speeds but the slowest: 1 % of the 200 N.m that the drive then delivers.
const DRAG: &str = "bearing_drag.carrier_torque = 2.0
bearing_drag.carrier_viscous = 0.0
bearing_drag.carrier_churning = 0.0
bearing_drag.side_torque = 0.0
bearing_drag.side_viscous = 0.0
";

fn parsed(text: &str) -> Scene {
    load::parse("test", Path::new("test.toml"), text).expect("a scene")
}

fn examined(text: &str, accuracy: f64) -> Findings {
    let question = Question { accuracy, from: 0.0, as_written: false, timed: false };
    examine(&parsed(text), &question, &mut |_, _| {}).expect("findings")
}

fn row<'a>(found: &'a Findings, name: &str) -> &'a Finding {
    found.rows.iter().find(|row| row.switch.name() == name).expect(name)
}

fn change(found: &Findings, name: &str) -> f64 {
    row(found, name).among.change(&found.bench).expect(name).largest()
}

#[test]
fn a_drag_of_one_percent_is_needed_for_less_and_not_for_more() {
    for (on, accuracy, wanted) in [
        ("", 0.009, Verdict::Needed),
        ("", 0.011, Verdict::Within),
        ("effects.bearing_drag = true\n", 0.009, Verdict::Needed),
        ("effects.bearing_drag = true\n", 0.011, Verdict::Within),
    ] {
        let found = examined(&format!("{IDEAL}{DRAG}{on}"), accuracy);
        // closed form but for rounding
        assert!((change(&found, "bearing_drag") / 0.01 - 1.0).abs() < 1e-12, "{}", change(&found, "bearing_drag"));
        assert_eq!(row(&found, "bearing_drag").verdict, wanted);
        assert_eq!(found.reduced_scene.parameters.effects.bearing_drag, wanted == Verdict::Needed);
        let text = table::text(&found);
        let told = if wanted == Verdict::Needed { "contact ideal with: bearing_drag." } else { "ideal and no effect." };
        assert!(text.contains(told) && text.contains("carrier.torque"), "{text}");
    }
}

#[test]
fn what_is_small_alone_is_kept_where_it_is_too_much_together() {
    // 50 rad/s and 100 N.m on each side: 10 kW; the drag of 1.3 N.m takes 65 W of it, and two clutches of 7 N.m that slip
    // at 10/16 of the spin of 8 rad/s take 70 W
    let text = IDEAL.replace("99.0", "100.0").replace("\"carrier.torque\", \"carrier.speed\"", "\"power.in\"");
    let text = format!(
        "{text}{}scene.planet_spin = \"imposed\"\nplanet.spin_command = 8.0\n\
         effects.limited_slip = true\nlimited_slip.torque_coefficient = 0.0\nlimited_slip.preload = 7.0\n",
        DRAG.replace("= 2.0", "= 1.3")
    );
    let found = examined(&text, 0.01);
    let tolerance = found.scene.parameters.solver.relative_tolerance;
    for (name, wanted) in [("bearing_drag", 65.0 / 10_135.0), ("limited_slip", 70.0 / 10_135.0)] {
        assert!((change(&found, name) - wanted).abs() < tolerance, "{name}: {}", change(&found, name));
    }
    assert_eq!(row(&found, "bearing_drag").verdict, Verdict::Within);
    assert_eq!(row(&found, "limited_slip").verdict, Verdict::NeededToo);
    assert!(found.reduced.change(&found.bench).expect("a run").is_within(&found.limits));
    assert_eq!(examined(&text, 0.014).rows.iter().filter(|row| row.verdict == Verdict::Within).count(), 2);
}

/// Teeth, for a moment.
const TEETH: &str = r#"
description = "teeth"
stop_time = 0.004
step = 5e-4
outputs = ["left.speed", "left.normal_force"]

[set]
carrier.speed_command = "954 deg/s"
scene.planet_spin = "imposed"
planet.spin_command = "200 deg/s"
"#;

#[test]
fn friction_without_a_coefficient_errors_without_deviations_and_shafts_without_ends_are_not_called_for() {
    let found = examined(&format!("{TEETH}effects.tooth_friction = true\ntooth_friction.coefficient = 0.0\n"), 1e-4);
    let tolerance = found.scene.parameters.solver.relative_tolerance;
    for name in ["tooth_friction", "tooth_errors", "half_shaft", "strength"] {
        assert!(row(&found, name).verdict.is_left_out(), "{name}: {:?}", row(&found, name).verdict);
        assert!(change(&found, name) < tolerance, "{name}: {}", change(&found, name));
    }
    assert_eq!(row(&found, "strength").verdict, Verdict::Nothing);
    assert!(table::text(&found).contains("off would do: ") && !found.reduced_scene.parameters.effects.tooth_friction);
}

#[test]
fn an_effect_whose_outputs_are_asked_for_is_called_for_even_where_they_stay_zero() {
    // nothing moves and nothing is loaded
    let text = TEETH.replace("\"left.speed\"", "\"damage.planet\"").replace("954", "0").replace("200", "0");
    let found =
        examined(&format!("{text}left.load_torque = 0.0\nright.load_torque = 0.0\nscene.start = \"rest\"\n"), 0.5);
    assert_eq!(found.bench.runs[FULL].statistics[0], [0.0; 4]);
    assert_eq!(row(&found, "strength").verdict, Verdict::Asked);
    assert!(found.reduced_scene.parameters.effects.strength);
    // nothing changes on ideal gears, but they know no strength
    assert_eq!((change(&found, "ideal"), &row(&found, "ideal").verdict), (0.0, &Verdict::TooPlain));
}

#[test]
fn what_does_not_go_together_is_shown_with_its_reason() {
    let found = examined(IDEAL, 0.01);
    for name in ["tooth_friction", "thrust_friction", "limited_slip"] {
        assert!(matches!(row(&found, name).verdict, Verdict::Refused(_)), "{name}");
    }
    let text = table::text(&found);
    let reason =
        "tooth_fault, tooth_friction: does not work with scene.gear_contact = ideal: it acts on single tooth pairs";
    assert!(text.contains(reason), "{text}");
}

#[test]
fn what_is_part_of_the_question_or_set_off_is_not_put_in() {
    let found = examined(&format!("{TEETH}effects.pin_compliance = false\n"), 0.01);
    let standing = |name: &str| row(&found, name).standing;
    assert_eq!([standing("limited_slip"), standing("pin_compliance")], [Standing::NotThere, Standing::SetOff]);
    let full = &found.bench.runs[FULL].scene.parameters.effects;
    assert!(!full.limited_slip && !full.pin_compliance && full.thrust_friction && full.bearing_drag);
    assert_eq!(row(&found, "pin_compliance").verdict, Verdict::SetOff);
    assert!(change(&found, "limited_slip") > 0.0);
}

#[test]
fn straight_ahead_the_speeds_call_for_no_teeth() -> Result<()> {
    let text = "description = \"d\"\nstop_time = 0.02\nstep = 1e-3\noutputs = [\"left.speed\", \"right.speed\"]\n";
    let question = Question { accuracy: 1e-3, from: 2e-3, as_written: true, timed: false };
    let found = examine(&parsed(text), &question, &mut |_, _| {})?;
    assert_eq!([row(&found, "ideal"), row(&found, "lumped")].map(|row| &row.verdict), [&Verdict::WouldDo; 2]);
    assert_eq!(switches::level_name(&found.reduced_scene.parameters), "ideal");
    assert_eq!(row(&found, "corner_contact").verdict, Verdict::Nothing);
    let written = reduced::text(&found, text)?;
    assert!(written.contains("scene.gear_contact = \"ideal\""), "{written}");
    Ok(())
}

/// All settings of a scene, for one line.
fn braces(text: &str) -> String {
    let set = text.split_once("# mine\n").map_or("", |(_, set)| set);
    set.lines().filter(|line| !line.is_empty()).collect::<Vec<_>>().join(", ")
}

#[test]
fn the_reduced_scene_is_the_file_with_other_switches_and_runs_to_the_same_bits() -> Result<()> {
    let body = format!("{IDEAL}{DRAG}").replace("[set]\n", "[set] # mine\n");
    let head = body.replace("[set] # mine\n", "[set]\neffects.backlash = true # stays\n");
    for text in [
        body.clone(),
        head,
        format!("{body}effects = {{ backlash = true, bearing_drag = true }}\n"),
        format!("{body}\"effects.bearing_drag\" = true\n"),
        format!("{}set = {{ {} }}\n", body.split("[set]").next().unwrap_or_default(), braces(&body)),
        format!("{body}[set.effects]\nbearing_drag = true\n\n[[at]]\ntime = 0.01\nleft.load_torque = \"98 N.m\"\n"),
    ] {
        for (accuracy, on) in [(0.009, true), (0.02, false)] {
            let found = examined(&text, accuracy);
            let written = reduced::text(&found, &text)?;
            assert!(written.starts_with("# Made from scene test:"), "{written}");
            assert!(written.contains("# mine") == text.contains("# mine") && written.contains("2.0"), "{written}");
            let again = load::parse("test", Path::new("test.toml"), &written)?;
            assert_eq!(again.parameters.effects.bearing_drag, on, "{written}");
            assert_eq!(again.parameters, found.reduced_scene.parameters);
            let (mut first, mut second) = (Vec::new(), Vec::new());
            run(&again, None, Some(&mut first))?;
            run(&found.reduced_scene, None, Some(&mut second))?;
            assert_eq!(String::from_utf8(first)?, String::from_utf8(second)?);
        }
    }
    Ok(())
}

#[test]
fn a_reduced_scene_goes_to_a_file_that_is_not_there_yet() -> Result<()> {
    let folder = fmu_build::tools::paths::target().join("test-effects").join(std::process::id().to_string());
    std::fs::create_dir_all(&folder)?;
    let original = folder.join("drag.toml");
    std::fs::write(&original, format!("{IDEAL}{DRAG}"))?;
    let question = Question { accuracy: 0.02, from: 0.0, as_written: false, timed: false };
    let found = examine(&load::load(&original)?, &question, &mut |_, _| {})?;
    let file = reduced::default_file(&found.scene);
    reduced::write(&found, &file)?;
    assert_eq!(load::load(&file)?.parameters, found.reduced_scene.parameters);
    let refused = reduced::write(&found, &file).expect_err("it is there").to_string();
    assert!(refused.contains("is there already") && refused.contains("--write FILE"), "{refused}");
    Ok(std::fs::remove_dir_all(&folder)?)
}

#[test]
fn all_changes_go_to_the_csv() -> Result<()> {
    let found = examined(&format!("{IDEAL}{DRAG}"), 0.01);
    let mut text = Vec::new();
    csv::write(&found, &mut text)?;
    let text = String::from_utf8(text)?;
    let rows: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let columns = rows[0].split(',').count();
    assert!(rows.iter().all(|row| row.split(',').count() == columns), "{text}");
    let ran = found.rows.iter().flat_map(|row| [&row.alone, &row.among]).filter(|trial| trial.run.is_ok()).count();
    assert_eq!(rows.len(), 1 + ran * found.scene.outputs.len());
    Ok(())
}

#[test]
fn every_switch_of_the_table_is_considered() {
    let names: Vec<&str> = switches::effects().map(|switch| switch.name()).collect();
    let listed = bevel_differential::model::Effects::TEETH.switches();
    let listed: Vec<&str> = listed.map(|(name, _)| name.trim_start_matches("effects.")).collect();
    assert_eq!(names, listed);
}

#[test]
fn a_time_beyond_the_end_and_a_scene_without_outputs_are_refused() {
    let refused = |text: &str, from| {
        let question = Question { accuracy: 0.01, from, as_written: false, timed: false };
        examine(&parsed(text), &question, &mut |_, _| {}).err().expect("refused").to_string()
    };
    assert!(refused(IDEAL, 0.5).contains("runs for 0.02 s"));
    assert!(refused(IDEAL, f64::NAN).contains("runs for"));
    let none = IDEAL.replace("\"carrier.torque\", \"carrier.speed\"", "");
    assert!(refused(&none, 0.0).contains("name some under outputs"));
}

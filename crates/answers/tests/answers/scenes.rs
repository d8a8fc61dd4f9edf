//! The scenes of the repository run, and errors in scene files are reported.

use std::path::Path;

use answers::progress::Progress;
use answers::scene::run::{SceneResult, SceneRun, run};
use answers::scene::{InputTable, Scene, files, find, load, loads, plan};
use anyhow::Result;

use crate::folder;

/// Number of communication steps that every scene must complete here.
const STEPS: f64 = 20.0;
/// Maximum energy residual relative to the throughput, with the default tolerance of the solvers.
const BALANCE: f64 = 1e-6;
/// Energy below which a scene is at rest [J].
const LEAST: f64 = 1e-6;

fn named(outcome: &SceneResult, name: &str) -> answers::scene::run::Summary {
    *outcome.outputs.iter().find(|output| output.row.name == name).expect(name)
}

#[test]
fn every_scene_starts_runs_and_balances_its_ledger() -> Result<()> {
    let files = files(&folder())?;
    assert!(files.len() >= 10);
    for file in files {
        let mut scene = load::load(&file)?;
        scene.stop_time = scene.stop_time.min(STEPS * scene.step);
        assert!(!scene.description.is_empty() && !scene.outputs.is_empty(), "{}", scene.name);
        let text = plan::text(&scene, &SceneRun::start(&scene, scene.step)?.simulation);
        assert!(text.contains("cost class") && text.contains("states"), "{text}");
        let outcome = run(&scene, None, &mut Progress::silent())?;
        for output in &outcome.outputs {
            let finite = [output.min, output.mean, output.max, output.end].iter().all(|x| x.is_finite());
            assert!(finite, "{}: {}", scene.name, output.row.name);
        }
        let balance = outcome.residual.abs() / outcome.throughput.max(LEAST);
        println!("{:<18} {balance:.1e} of {:.3e} J  {}", scene.name, outcome.throughput, outcome.account);
        assert!(balance < BALANCE, "{}: {balance:e}", scene.name);
    }
    Ok(())
}

#[test]
fn the_studys_scene_reproduces_the_study() -> Result<()> {
    let turning = run(&find("study_turning", &folder())?, None, &mut Progress::silent())?;
    for (name, wanted) in [("left.speed", 1079f64), ("right.speed", 829.0), ("carrier.speed", 954.0)] {
        let mean = named(&turning, name).mean.to_degrees();
        assert!((mean / wanted - 1.0).abs() < 2e-3, "{name}: {mean}");
    }
    assert!((named(&turning, "left.tangential_force").end / 23194.0 - 1.0).abs() < 1e-2);
    Ok(())
}

#[test]
fn the_clunk_peak_follows_from_the_two_inertias() -> Result<()> {
    let outcome = run(&find("clunk", &folder())?, None, &mut Progress::silent())?;
    let peak = named(&outcome, "left.shaft_torque").max + named(&outcome, "right.shaft_torque").max;
    println!("clunk: {peak} N.m");
    assert!((peak / 265.58 - 1.0).abs() < 0.01, "{peak}");
    assert!(outcome.relative_residual() < 1e-4, "{}", outcome.relative_residual());
    Ok(())
}

#[test]
fn with_a_wheel_on_ice_speeds_separate_by_torque_over_inertia() -> Result<()> {
    let outcome = run(&find("one_wheel_on_ice", &folder())?, None, &mut Progress::silent())?;
    let difference = named(&outcome, "left.wheel_speed").end - named(&outcome, "right.wheel_speed").end;
    // 835 N·m for 0.2 s on a wheel of 1 kg·m²
    assert!((difference / (835.0 * 0.2 / 1.0) - 1.0).abs() < 2e-3, "{difference}");
    Ok(())
}

#[test]
fn half_shafts_start_twisted_by_the_torque_that_accelerates_their_wheels() -> Result<()> {
    let scene = find("split_friction", &folder())?;
    let mut run = SceneRun::start(&scene, scene.step)?;
    // carrier imposed: without the light gears, both wheels accelerate with a = (T_R - T_L)/(J_L + J_R)
    let ([left, right], [j_left, j_right]) = ([700.0, 835.0], [0.9, 1.1]);
    let wanted = left + j_left * (right - left) / (j_left + j_right);
    for torque in run.simulation.forces().shaft_torque {
        assert!((torque / wanted - 1.0).abs() < 1e-3, "{torque} {wanted}");
    }
    Ok(())
}

#[test]
fn loads_are_written_with_their_frames_and_forces_that_balance() -> Result<()> {
    let mut scene = find("study_turning", &folder())?;
    scene.stop_time = 0.02;
    let mut text = Vec::new();
    let (lines, explanation) = loads::write(&scene, Some(2e-3), &mut text, &mut Progress::silent())?;
    let text = String::from_utf8(text)?;
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!((rows.len() as u64, rows[0][0]), (lines + 1, "time"));
    assert!(explanation.contains("\nplanet 1 stands for planets 1, 2"), "{explanation}");
    let column = |name: &str| rows[0].iter().position(|column| *column == name).expect(name);
    let number = |row: &[&str], name: &str| row[column(name)].parse::<f64>().expect(name);
    // both planets are loaded at the last instant: moments about the left side gear's axis
    let last = rows[rows.len() - 1][0];
    let torque: f64 = rows[1..]
        .iter()
        .filter(|row| row[0] == last && row[column("side")] == "left")
        .map(|row| {
            let n = |name: &str| number(row, name);
            2.0 * (n("side_x") * n("side_Fy") - n("side_y") * n("side_Fx"))
        })
        .sum();
    assert!((torque / 835.0 - 1.0).abs() < 1e-2, "{torque}");
    Ok(())
}

#[test]
fn scenes_without_teeth_have_no_loads() -> Result<()> {
    let problem = loads::write(&find("hil", &folder())?, None, &mut Vec::new(), &mut Progress::silent())
        .expect_err("no teeth")
        .to_string();
    assert!(problem.contains("scene.gear_contact = ideal"), "{problem}");
    Ok(())
}

#[test]
fn forces_on_ring_gear_and_bearings_are_written_over_time_and_balance() -> Result<()> {
    let set = "[set]\nscene.gear_contact = \"ideal\"\neffects.final_drive = true\nscene.carrier_drive = \"torque\"\n\
               pinion.torque_command = 100.0\nfinal_drive.spiral_angle = 0.6\nfinal_drive.azimuth = 0.4\n";
    let (mut text, scene) = (Vec::new(), parsed(set)?);
    let (lines, explanation) = loads::write_bearings(&scene, Some(0.02), &mut text, &mut Progress::silent())?;
    let text = String::from_utf8(text)?;
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!((rows.len() as u64, lines, rows[0].len()), (lines + 1, 6, 10));
    assert!(explanation.contains("in N") && explanation.contains("forward"), "{explanation}");
    let column = |name: &str| rows[0].iter().position(|column| *column == name).expect(name);
    for row in &rows[1..] {
        let n = |name: &str| row[column(name)].parse::<f64>().expect(name);
        let both = |along: &str| n(&format!("left_bearing.{along}_force")) + n(&format!("right_bearing.{along}_force"));
        let across = f64::hypot(n("ring_gear.tangential_force"), n("ring_gear.radial_force"));
        assert!((f64::hypot(both("vertical"), both("longitudinal")) / across - 1.0).abs() < 1e-9);
        // the ring gear is on the left
        assert!((both("axial") / n("ring_gear.axial_force") - 1.0).abs() < 1e-9);
    }
    let off = loads::write_bearings(&find("hil", &folder())?, None, &mut Vec::new(), &mut Progress::silent());
    assert!(off.expect_err("no final drive").to_string().contains("effects.final_drive is off"));
    Ok(())
}

#[test]
fn a_plan_names_the_port_and_the_inertias_in_front_of_the_carrier() -> Result<()> {
    let set = "[set]\neffects.final_drive = true\npinion.speed_command = 82.0\ninertia.pinion = 0.003\n";
    let shaft = "effects.propeller_shaft = true\ninertia.propeller_end = 0.02\n";
    for (set, port, inertias) in [
        (set.to_owned(), "pinion by speed, pinion.speed_command = ", ", pinion 0.003 kg.m2"),
        (
            format!("{set}{shaft}"),
            "propeller shaft by speed, ",
            ", pinion 0.003, end of the propeller shaft 0.02 kg.m2",
        ),
    ] {
        let scene = parsed(&set)?;
        let text = plan::text(&scene, &SceneRun::start(&scene, scene.step)?.simulation);
        assert!(text.contains(port) && text.contains("4.1 times the speed of the carrier"), "{text}");
        assert!(text.contains(inertias), "{text}");
    }
    Ok(())
}

const FRAME: &str = "description = \"d\"\nstop_time = 0.1\nstep = 1e-3\noutputs = [\"left.speed\"]\n";

fn parsed(rest: &str) -> Result<Scene> {
    load::parse("test", Path::new("test.toml"), &format!("{FRAME}{rest}"))
}

fn wrong(rest: &str) -> String {
    parsed(rest).err().map(|error| format!("{error:#}")).expect(rest)
}

#[test]
fn wrong_files_are_reported_with_key_value_unit_range_and_the_nearest_name() {
    let cases = [
        ("[set]\ngeometry.modul = 1.0", vec!["[set]", "geometry.modul", "did you mean geometry.module?"]),
        ("[set]\ngeometry.module = \"4.5 kg\"", vec!["geometry.module", "4.5 kg", "m, mm, um"]),
        ("[set]\ngeometry.module = \"4.5\"", vec!["no unit"]),
        (
            "[set]\ngeometry.module = 4.5",
            vec!["geometry.module", "4.5 m is outside", "did you mean 4.5 mm", "0.2 mm, 100 mm"],
        ),
        ("[set]\ngeometry.planet_teeth = 3", vec!["geometry.planet_teeth", "[5, 200]"]),
        ("[set]\ngeometry.planet_teeth = 10.5", vec!["whole number"]),
        ("[set]\nscene.start = \"roling\"", vec!["equilibrium, rolling, rest", "did you mean rolling?"]),
        ("[set]\neffects.backlash = 1", vec!["true or false"]),
        (
            "[set]\n\"left.load_torque\" = 1\nleft.load_torque = 2",
            vec!["[set] left.load_torque is set twice; leave one out"],
        ),
        ("[set]\nleft.speed = 1.0", vec!["left.speed", "output"]),
        ("[set]\ncarrier.speed_command = nan", vec!["not a finite number"]),
        ("[[at]]\ntime = 0.05\ngeometry.module = \"4 mm\"", vec!["time = 0.05", "geometry.module is fixed"]),
        ("[[at]]\ntime = 7\nleft.load_torque = 0", vec!["time = 7", "[0, 0.1] s"]),
        ("[[at]]\nleft.load_torque = 0", vec!["no time"]),
        ("[[table]]\ninput = \"left.speed\"\ntime = [0]\nvalue = [0]", vec!["left.speed", "not an input"]),
        ("[[table]]\ninput = \"left.load_torque\"\ntime = [0, 1]\nvalue = [0]", vec!["2 times and 1 values"]),
        ("[[table]]\ninput = \"left.load_torque\"\ntime = [1, 0]\nvalue = [0, 0]", vec!["comes after"]),
        (
            "[set]\naccept_start_values = true",
            vec!["[set] accept_start_values: it is a key of the scene; write it above [set]"],
        ),
        (
            "[[at]]\ntime = 0.05\nleft.load_torque = 1\n[[table]]\ninput = \"left.load_torque\"\ntime = [0]\nvalue = [0]",
            vec!["time = 0.05", "left.load_torque follows a table"],
        ),
        ("stop_tim = 3", vec!["stop_tim"]),
    ];
    for (rest, wanted) in cases {
        let problem = wrong(rest);
        println!("{problem}");
        for part in wanted {
            assert!(problem.contains(part), "\"{part}\" is not in: {problem}");
        }
    }
    // all problems together
    let both = wrong("[set]\ngeometry.modul = 1.0\neffects.backlash = 1");
    assert_eq!(both.lines().count(), 2, "{both}");
    let outputs = load::parse("test", Path::new("t"), &FRAME.replace("left.speed", "left.sped")).err().expect("wrong");
    assert!(format!("{outputs:#}").contains("did you mean left.speed?"));
    let missing = find("study_strait", &folder()).err().expect("no such scene").to_string();
    assert!(missing.contains("did you mean 'study_straight'?"), "{missing}");
}

#[test]
fn contradictions_are_reported_at_the_start_by_name() -> Result<()> {
    let scene = parsed("[set]\nscene.gear_contact = \"ideal\"\neffects.tooth_friction = true")?;
    let problem = SceneRun::start(&scene, scene.step).err().map(|error| format!("{error:#}")).expect("a contradiction");
    assert!(problem.contains("effects.tooth_friction"), "{problem}");
    Ok(())
}

#[test]
fn inputs_change_at_their_times_even_between_communication_points() -> Result<()> {
    let scene = parsed("[[at]]\ntime = 0.0105\ncarrier.speed_command = 40.0\n")?;
    let mut run = SceneRun::start(&scene, scene.step)?;
    let mut times = Vec::new();
    while !run.is_over() {
        run.advance()?;
        // the second row at the time of the change contains the new values
        let is_changed = run.time() > 0.0105 + 1e-12 || times.last() == Some(&run.time());
        times.push(run.time());
        let wanted = if is_changed { 40.0 } else { 2861f64.to_radians() };
        assert_eq!(run.simulation.motion().carrier_speed, wanted, "{}", run.time());
    }
    assert!(times.iter().filter(|&&time| time == 0.0105).count() == 2 && times.len() == 102);
    Ok(())
}

#[test]
fn tables_are_linear_between_points_and_repeat() -> Result<()> {
    let table = "[[table]]\ninput = \"left.load_torque\"\ntime = [0.1, 0.3]\nvalue = [1.0, \"5 N.m\"]\n";
    let at = |input_table: &InputTable, time| (input_table.table.at(time) * 1e6).round() / 1e6;
    let scene = parsed(table)?;
    let input_table = &scene.input_tables[0];
    assert_eq!(
        [at(input_table, 0.0), at(input_table, 0.1), at(input_table, 0.2), at(input_table, 0.3), at(input_table, 9.0)],
        [1.0, 1.0, 3.0, 5.0, 5.0]
    );
    let again = parsed(&format!("{table}period = 0.4\n"))?;
    assert_eq!([at(&again.input_tables[0], 0.6), at(&again.input_tables[0], 0.85)], [3.0, 1.0]);
    assert_eq!(scene.inputs.load_torque[0], 1.0);
    Ok(())
}

//! Inputs of scenes from CSV files, times with units, and changes on the command line.

use std::fs;
use std::path::{Path, PathBuf};

use answers::progress::Progress;
use answers::scene::run::run;
use answers::scene::{Scene, assignments, find, load, loads};
use anyhow::Result;

use crate::folder;

const FRAME: &str = "description = \"d\"\nstop_time = \"100 ms\"\nstep = \"1 ms\"\noutputs = [\"left.speed\"]\n";
const INPUTS: &str = "[[inputs]]\nfile = \"cycle.csv\"\n";

/// Finds the scene `what` of `folder` and applies `changes`.
fn find_with(what: &str, folder: &Path, changes: &[impl AsRef<str>]) -> Result<Scene> {
    let mut scene = find(what, folder)?;
    assignments::apply(&mut scene, changes)?;
    Ok(scene)
}

/// Separate folder for a test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Result<Self> {
        let folder = std::env::temp_dir().join("test-scenes").join(format!("{}-{test}", std::process::id()));
        fs::create_dir_all(&folder)?;
        Ok(Self(folder))
    }

    /// Loads the scene `FRAME` with `rest`, next to a file cycle.csv with `csv`.
    fn scene(&self, rest: &str, csv: &str) -> Result<Scene> {
        fs::write(self.0.join("cycle.csv"), csv)?;
        load::parse("test", &self.0.join("test.toml"), &format!("{FRAME}{rest}"))
    }

    fn wrong(&self, rest: &str, csv: &str) -> String {
        self.scene(rest, csv).err().map(|error| format!("{error:#}")).unwrap_or_else(|| panic!("taken: {csv}"))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn parsed(text: &str) -> Result<Scene> {
    load::parse("test", Path::new("test.toml"), text)
}

#[test]
fn times_with_units_equal_times_in_seconds() -> Result<()> {
    let rest = |at: &str, times: &str, period: &str| {
        format!(
            "[[at]]\ntime = {at}\nleft.load_torque = 1.0\n[[table]]\ninput = \"right.load_torque\"\ntime = {times}\n\
             value = [1.0, 2.0]\nperiod = {period}\n"
        )
    };
    let plain = FRAME.replace("\"100 ms\"", "0.1").replace("\"1 ms\"", "0.001");
    let with_units = parsed(&format!("{FRAME}{}", rest("\"20 ms\"", "[\"0 s\", \"5 ms\"]", "\"0.05 s\"")))?;
    let seconds = parsed(&format!("{plain}{}", rest("0.02", "[0, 0.005]", "0.05")))?;
    for scene in [with_units, seconds] {
        assert_eq!((scene.stop_time, scene.step, scene.events[0].time), (0.1, 1e-3, 0.02));
        let table = &scene.input_tables[0].table;
        assert_eq!((table.times.as_slice(), table.period), (&[0.0, 5e-3][..], Some(0.05)));
    }
    Ok(())
}

#[test]
fn wrong_times_are_reported_by_key_and_value() {
    for (text, wanted) in [
        (FRAME.replace("100 ms", "100 mm"), "stop_time = \"100 mm\""),
        (FRAME.replace("100 ms", "100 mm"), "s, ms, us, min"),
        (FRAME.replace("\"1 ms\"", "true"), "step = true: it must be a number of seconds, or a text like \"20 ms\""),
        (FRAME.replace("1 ms", "-1 ms"), "step = \"-1 ms\": it must be above 0 s"),
        (FRAME.replace("100 ms", "-1 ms"), "stop_time = \"-1 ms\": it must be 0 s or more"),
        (FRAME.replace("1 ms", "1 s"), "step = 1 s is longer than stop_time = 0.1 s"),
        (format!("{FRAME}[[at]]\ntime = \"200 ms\"\n"), "time = 0.2 s is outside the scene's [0, 0.1] s"),
        (format!("{FRAME}[[at]]\ntime = [1]\n"), "[[at]] time = [...]"),
        (format!("{FRAME}[[table]]\ninput = \"left.load_torque\"\ntime = [\"0 m\"]\nvalue = [0]\n"), "time \"0 m\""),
    ] {
        let problem = parsed(&text).err().map(|error| format!("{error:#}")).unwrap_or_default();
        assert!(problem.contains(wanted), "\"{wanted}\" is not in: {problem}");
    }
}

#[test]
fn a_scene_of_zero_duration_shows_its_start() -> Result<()> {
    let start = "[set]\nscene.start = \"rolling\"\ncarrier.speed_command = 30.0\n";
    for frame in [FRAME.replace("100 ms", "0 s"), FRAME.replace("\"100 ms\"", "0")] {
        let scene = parsed(&format!("{frame}{start}"))?;
        let mut csv = Vec::new();
        let outcome = run(&scene, Some(&mut csv), &mut Progress::silent())?;
        let speed = outcome.outputs[0];
        assert_eq!([speed.min, speed.mean, speed.max, speed.end], [30.0; 4]);
        assert_eq!(String::from_utf8(csv)?.lines().last(), Some("0,30"));
        // meshes are preloaded by default
        let (lines, _) = loads::write(&parsed(&frame)?, None, &mut Vec::new(), &mut Progress::silent())?;
        assert!(lines > 0, "the loads at the start");
    }
    Ok(())
}

#[test]
fn inputs_from_a_file_equal_inputs_from_tables() -> Result<()> {
    let folder = Folder::new("tables")?;
    let csv = "\u{feff}# a cycle\ntime [ms], carrier.speed_command [rpm], left.load_torque [N·m], right.load_torque\n\
               0, 300, 400, 401\n20, 600, 800, 802\n";
    let scene = folder.scene(&format!("{INPUTS}period = \"50 ms\"\n"), csv)?;
    let column = |input: &str, values: &str| {
        format!("[[table]]\ninput = \"{input}\"\ntime = [0, 0.02]\nvalue = [{values}]\nperiod = 0.05\n")
    };
    let same = parsed(&format!(
        "{FRAME}{}{}{}",
        column("carrier.speed_command", "\"300 rpm\", \"600 rpm\""),
        column("left.load_torque", "400, 800"),
        column("right.load_torque", "401, 802")
    ))?;
    assert_eq!(scene.inputs, same.inputs);
    let (mut first, mut second) = (Vec::new(), Vec::new());
    run(&scene, Some(&mut first), &mut Progress::silent())?;
    run(&same, Some(&mut second), &mut Progress::silent())?;
    assert_eq!(String::from_utf8(first)?, String::from_utf8(second)?);
    let tables = |scene: &Scene| -> Vec<_> {
        scene
            .input_tables
            .iter()
            .map(|t| (t.row.name, t.table.times.clone(), t.table.values.clone(), t.table.period))
            .collect()
    };
    assert_eq!(tables(&scene), tables(&same));
    for other in [
        "time [ms];carrier.speed_command [rpm];left.load_torque [N·m];right.load_torque\r\n0;300;400,00;401\r\n20;6e2;800;802\r\n",
        "time [ms]\tcarrier.speed_command [rpm]\tleft.load_torque [N·m]\tright.load_torque\n0,0\t300\t400\t401\n20\t600\t800\t802\n",
        "time [ms];carrier.speed_command [rpm];left.load_torque [N·m];right.load_torque\n0;300;400.0;401\n20;600;800;802\n",
    ] {
        let scene = folder.scene(&format!("{INPUTS}period = \"50 ms\"\n"), other)?;
        assert_eq!(tables(&scene), tables(&same), "{other}");
    }
    Ok(())
}

/// A file of a test bench, with names in its own words, a column of dates and one of words.
const BENCH: &str = "Datum;t [ms];M_links (Nm);Bemerkung;v;left.speed\n\
                     01.02.2026;0;800,5;kalt, nass;36;0\n01.02.2026;10;810,25;;72;1\n";

#[test]
fn a_scene_names_the_columns_that_it_uses_and_the_others_are_ignored() -> Result<()> {
    let folder = Folder::new("columns")?;
    let same = folder.scene(INPUTS, "time,left.load_torque,carrier.speed_command\n0,800.5,30\n0.01,810.25,60\n")?;
    let columns = |left: &str, speed: &str, rest: &str| {
        format!("{INPUTS}columns = {{ time = \"t [ms]\", left.load_torque = \"{left}\", {speed} }}\n{rest}")
    };
    for rest in [
        // with its header as written, without its unit, and with a unit that the file lacks
        columns("M_links (Nm)", "carrier.speed_command = \"v [km/h]\"", "wheel_radius = \"1000 mm\"\n"),
        columns("M_links", "\"speed\" = \"v [km/h]\"", "wheel_radius = 1.0\n"),
    ] {
        let scene = folder.scene(&rest, BENCH)?;
        let tables = |scene: &Scene, factor: f64| -> Vec<(&str, Vec<f64>)> {
            let of = |name: &str| if name.starts_with("carrier") { factor } else { 1.0 };
            let values = |table: &schedule::Table, of: f64| table.values.iter().map(|value| value / of).collect();
            let mut found: Vec<_> =
                scene.input_tables.iter().map(|each| (each.row.name, values(&each.table, of(each.row.name)))).collect();
            found.sort_by_key(|(name, _)| *name);
            found
        };
        // 36 km/h are 10 m/s, and 10 rad/s on wheels of 1 m
        assert_eq!(tables(&scene, 10.0), tables(&same, 30.0), "{rest}");
        // the file is shorter than the scene
        assert!(scene.notes.len() == 1 && scene.notes[0].contains("it ends at 0.01 s"), "{:?}", scene.notes);
    }
    for (rest, wanted) in [
        (columns("M_rechts", "\"speed\" = \"v [km/h]\"", "wheel_radius = 1\n"), "no column \"M_rechts\""),
        (columns("M_links [kNm]", "\"speed\" = \"v\"", "wheel_radius = 1\n"), "no column \"M_links [kNm]\""),
        (columns("M_links", "\"speed\" = \"v [km/h]\"", ""), "wheel_radius = \"334 mm\""),
        (columns("M_links", "spin.command = \"v [rpm]\"", "wheel_radius = 1\n"), "wheel_radius has no effect"),
        (columns("M_links", "\"speed\" = \"v [Nm]\"", "wheel_radius = 1\n"), "unit Nm does not fit"),
        (columns("M_links", "\"speed\" = \"v\"", "wheel_radius = \"-1 mm\"\n"), "must be above 0 m"),
        (columns("M_links", "\"speed\" = 5", "wheel_radius = 1\n"), "must be the header of a column"),
        (INPUTS.to_owned(), "has no column time"),
    ] {
        let problem = folder.wrong(&rest, BENCH);
        assert!(problem.contains(wanted), "\"{wanted}\" is not in: {problem}");
    }
    Ok(())
}

#[test]
fn columns_of_outputs_are_left_out_with_a_message() -> Result<()> {
    let folder = Folder::new("outputs")?;
    let scene = folder.scene(INPUTS, "time,left.load_torque,left.speed\n0,800,1\n1,810,2\n")?;
    assert_eq!(scene.input_tables.len(), 1);
    assert!(scene.notes.len() == 1 && scene.notes[0].contains("left.speed: it is an output"), "{:?}", scene.notes);
    Ok(())
}

#[test]
fn wrong_input_files_are_reported_with_line_column_value_and_remedy() -> Result<()> {
    let folder = Folder::new("wrong")?;
    for (csv, wanted) in [
        ("time,left.load_torqe\n0,1\n", &["column left.load_torqe", "did you mean left.load_torque?"][..]),
        ("time,left.load_torque [kg]\n0,1\n", &["column left.load_torque [kg]", "units that do: N.m"]),
        ("time,left.speed [rpm]\n0,1\n", &["left.speed is not an input"]),
        ("time,geometry.module [mm]\n0,1\n", &["geometry.module is not an input", "[set]"]),
        ("time [m],left.load_torque\n0,1\n", &["column time [m]", "s, ms, us, min"]),
        ("t,left.load_torque\n0,1\n", &["has no column time", "time [s],left.load_torque [N.m]"]),
        ("t;left.load_torque\n0;1\n", &["has no column time", "separated by commas, semicolons or tabs"]),
        ("time;left.load_torque\n0;1,500\n", &["line 2, column left.load_torque, value \"1,500\"", "thousands"]),
        ("time;left.load_torque\n0;1\n0,5;x\n", &["line 3, column left.load_torque, value \"x\"", "decimal"]),
        ("time,left.load_torque\n0;1\n", &["line 2", "separated by semicolons, and the header by commas"]),
        ("time,left.load_torque\n0,5,1,5\n", &["line 2", "4 cells where the header has 2", "semicolons or tabs"]),
        ("time\n0\n", &["no inputs"]),
        ("time,left.load_torque\n", &["no values"]),
        ("time,left.load_torque,left.load_torque [N.m]\n0,1,2\n", &["twice"]),
        ("time,left.load_torque\n0,1\n1,x\n2,\n", &["line 3, column left.load_torque, value \"x\"", "and 1 more"]),
        ("time,left.load_torque\n0,1\n1,1e9\n", &["line 3", "value \"1e9\"", "is outside [-100000000, 100000000] N.m"]),
        ("time,carrier.speed_command [rpm]\n0,inf\n", &["line 2", "value \"inf\"", "finite"]),
        ("time,left.load_torque\n1,1\n0,2\n", &["line 3, column time, value \"0\"", "sort the lines"]),
        ("time [ms],left.load_torque\n-1,1\n", &["line 2, column time [ms], value \"-1\"", "begin at 0"]),
        ("time,left.load_torque\nnan,1\n", &["line 2", "finite"]),
        ("time,left.load_torque\n0,1\n# c\n1\n", &["line 4", "1 cells where the header has 2"]),
        ("# c\n\ntime,left.load_torque\n0,1\n\n# c\n1,x", &["line 7", "value \"x\""]),
        ("# c\r\ntime,left.load_torque\r\n0,1\r\n# c\r\n\r\n1,x\r\n", &["line 6", "value \"x\""]),
    ] {
        let problem = folder.wrong(INPUTS, csv);
        println!("{problem}");
        assert!(problem.contains("cycle.csv") && problem.lines().count() == 1, "{problem}");
        for part in wanted {
            assert!(problem.contains(part), "\"{part}\" is not in: {problem}");
        }
    }
    let good = "time,left.load_torque\n0,1\n";
    assert!(folder.wrong(&format!("{INPUTS}period = 0\n"), good).contains("period = 0: it must be above 0 s"));
    let table = "[[table]]\ninput = \"left.load_torque\"\ntime = [0]\nvalue = [0]\n";
    assert!(folder.wrong(&format!("{table}{INPUTS}"), good).contains("another table"));
    let missing = folder.wrong(&INPUTS.replace("cycle", "cycles"), good);
    assert!(
        missing.contains("cycles.csv: there is no such file") && missing.contains("relative to the scene"),
        "{missing}"
    );
    Ok(())
}

#[test]
fn changes_on_the_command_line_act_as_in_the_file() -> Result<()> {
    let changes = [
        "geometry.module=4 mm",
        "scene.start = rest",
        "effects.backlash=false",
        "geometry.planet_teeth=12",
        "left.load_torque=500 N.m",
        "stop_time=\u{20}20 ms",
        "step=0.002",
    ];
    let changed = find_with("one_wheel_on_ice", &folder(), &changes)?;
    let before = find("one_wheel_on_ice", &folder())?;
    assert_eq!((changed.stop_time, changed.step), (0.02, 2e-3));
    assert_eq!(changed.inputs.load_torque, [500.0, before.inputs.load_torque[1]]);
    let text = |name: &str| {
        let found: Vec<String> = changed.settings.iter().filter(|s| s.row.name == name).map(|s| s.text()).collect();
        assert_eq!(found.len(), 1, "{name}");
        found[0].clone()
    };
    assert_eq!(
        ["geometry.module", "scene.start", "effects.backlash", "geometry.planet_teeth", "left.load_torque"].map(text),
        ["4 mm", "rest", "false", "12", "500 N.m"]
    );
    assert_ne!(changed.parameters, before.parameters);
    let none: [&str; 0] = [];
    assert_eq!(find_with("one_wheel_on_ice", &folder(), &none)?.parameters, before.parameters);
    Ok(())
}

#[test]
fn a_shorter_run_leaves_out_changes_after_its_end() -> Result<()> {
    let times = |scene: Scene| scene.events.iter().map(|event| event.time).collect::<Vec<_>>();
    assert_eq!(times(find("limited_slip", &folder())?), [0.1, 0.25]);
    assert_eq!(times(find_with("limited_slip", &folder(), &["stop_time=0.2"])?), [0.1]);
    Ok(())
}

#[test]
fn wrong_changes_are_reported_with_a_suggestion() {
    for (change, wanted) in [
        ("geometry.modul=4 mm", &["geometry.modul", "did you mean geometry.module?"][..]),
        ("stop_tim=1", &["did you mean stop_time?"]),
        ("stop_time=1 m", &["stop_time = \"1 m\"", "s, ms, us, min"]),
        ("stop_time=-1 ms", &["must be 0 s or more"]),
        ("step=20 s", &["step = 20 s is longer than stop_time = 10 s"]),
        ("geometry.module=4 kg", &["units that do: m, mm, um"]),
        ("geometry.module=4", &["did you mean 4 mm"]),
        ("scene.start=roling", &["did you mean rolling?"]),
        ("effects.backlash=1", &["true or false"]),
        ("left.speed=1", &["is an output"]),
        ("left.load_torque=nan", &["not a finite number"]),
        ("left.load_torque", &["name=value"]),
        ("left.speed_command=1", &["left.speed_command follows a table", "change the table"]),
    ] {
        let problem =
            find_with("hil", &folder(), &[change]).err().map(|error| format!("{error:#}")).unwrap_or_default();
        println!("{problem}");
        // stop_time and step have options of their own
        let is_time = change.starts_with("stop_time") || change.starts_with("step");
        assert_eq!((problem.starts_with("--set: "), problem.lines().count()), (!is_time, 1), "{change}: {problem}");
        for part in wanted {
            assert!(problem.contains(part), "\"{part}\" is not in: {problem}");
        }
    }
    let twice =
        find_with("hil", &folder(), &["step=1e-4", "step=1e-3", "left.speed=1"]).err().map(|error| error.to_string());
    let twice = twice.unwrap_or_default();
    assert!(twice.contains("step is set twice") && twice.lines().count() == 2, "{twice}");
}

#[test]
fn an_invalid_choice_of_slopes_is_reported_by_key_and_value() {
    let problem =
        parsed(&format!("{FRAME}input_slopes = 1\n")).err().map(|error| format!("{error:#}")).unwrap_or_default();
    assert!(problem.contains("input_slopes = 1: it must be true or false"), "{problem}");
}

#[test]
fn with_input_ramps_a_change_is_spread_over_the_next_step_and_tables_stay_linear() -> Result<()> {
    // a table jumps by 2 rad/s at 20 ms, and rises by 1 rad/s from there to 30 ms
    let table = "[[table]]\ninput = \"spin.command\"\ntime = [0.0, 0.02, 0.02, 0.03]\nvalue = [0.0, 0.0, 2.0, 3.0]\n";
    for (ramps, turned) in [(true, 50.0 * 0.01 + 50.5 * 0.001 + 51.0 * 0.089), (false, 50.0 * 0.01 + 51.0 * 0.09)] {
        let scene = parsed(&format!(
            "description = \"d\"\nstop_time = 0.1\nstep = 1e-3\noutputs = [\"carrier.angle\", \"planet[1].spin_angle\"]\n\
             [set]\nscene.gear_contact = \"ideal\"\nscene.planet_spin = \"imposed\"\nsolver.input_ramp = {ramps}\n\
             carrier.speed_command = 50.0\n[[at]]\ntime = 0.01\ncarrier.speed_command = 51.0\n{table}"
        ))?;
        let found = run(&scene, None, &mut Progress::silent())?;
        assert!(
            (found.outputs[0].end - turned).abs() < 1e-9,
            "{ramps}: {} instead of {turned} rad",
            found.outputs[0].end
        );
        let spun = 2.5 * 0.01 + 3.0 * 0.07;
        assert!((found.outputs[1].end - spun).abs() < 1e-9, "{ramps}: {} instead of {spun} rad", found.outputs[1].end);
    }
    Ok(())
}

#[test]
fn values_and_files_that_are_probably_not_meant_are_named() -> Result<()> {
    let folder = Folder::new("meant")?;
    let notes = |rest: &str, csv: &str| folder.scene(rest, csv).map(|scene| scene.notes);
    let table = |start: f64| {
        format!(
            "[set]\nleft.load_torque = {start}\n[[table]]\ninput = \"left.load_torque\"\ntime = [0, 1]\nvalue = [7, 9]\n"
        )
    };
    assert!(notes(&table(8.0), "")?[0].contains("[set] left.load_torque: a table gives this input from the start"));
    assert!(notes(&table(7.0), "")?.is_empty());
    let early = notes(INPUTS, "time,left.load_torque\n0,800\n0.01,810\n")?;
    assert!(
        early.len() == 1 && early[0].contains("it ends at 0.01 s, and its last values stay until 0.1 s"),
        "{early:?}"
    );
    let late = notes(INPUTS, "time,left.load_torque\n0,800\n60,810\n")?;
    assert!(late.len() == 1 && late[0].contains("it ends at 60 s, but the scene already at 0.1 s"), "{late:?}");
    assert!(notes(INPUTS, "time,left.load_torque\n0,800\n0.06,810\n")?.is_empty());
    let falling =
        folder.wrong("[[table]]\ninput = \"left.load_torque\"\ntime = [0, 0.3, 0.2]\nvalue = [1, 2, 3]\n", "");
    assert!(falling.contains("time 0.2 s comes after 0.3 s"), "{falling}");
    Ok(())
}

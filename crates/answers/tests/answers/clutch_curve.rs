//! Measured clutch curves of scenes, as lists of points and from CSV files.

use std::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};

use answers::scene::set::SettingValue;
use answers::scene::{Scene, assignments, load, script, ssv};
use anyhow::Result;

const FRAME: &str = "description = \"d\"\nstop_time = 0.01\nstep = 1e-3\noutputs = [\"left.speed\"]\n[set]\n\
                     effects.limited_slip = true\n";
const FROM_FILE: &str = "limited_slip.curve = \"data/clutch.csv\"\n";
const POINTS: usize = 8;

/// Separate folder with a file data/clutch.csv, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Result<Self> {
        let folder = std::env::temp_dir().join("test-curves").join(format!("{}-{test}", std::process::id()));
        fs::create_dir_all(folder.join("data"))?;
        Ok(Self(folder))
    }

    fn file(&self) -> PathBuf {
        self.0.join("data").join("clutch.csv")
    }

    /// Loads the scene `FRAME` with `rest`, next to the file with `csv`.
    fn scene(&self, rest: &str, csv: &str) -> Result<Scene> {
        fs::write(self.file(), csv)?;
        load::parse("test", &self.0.join("test.toml"), &format!("{FRAME}{rest}"))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn parsed(rest: &str) -> Result<Scene> {
    load::parse("test", Path::new("test.toml"), &format!("{FRAME}{rest}"))
}

fn changed(mut scene: Scene, changes: &[&str]) -> Result<Scene> {
    assignments::apply(&mut scene, changes)?;
    Ok(scene)
}

/// Slip [rad/s] and torque [N·m] of all points that `scene` sets, each exactly once.
fn points(scene: &Scene) -> [[f64; 2]; POINTS] {
    let found = |number: usize, column: &str| {
        let name = format!("limited_slip.curve[{}].{column}", number + 1);
        let of_name: Vec<_> = scene.settings.iter().filter(|setting| setting.row.name == name).collect();
        match of_name.as_slice() {
            [setting] => match setting.value {
                SettingValue::Real(value) => value,
                other => panic!("{name} is {other:?}"),
            },
            several => panic!("{name} is set {} times", several.len()),
        }
    };
    std::array::from_fn(|number| ["slip", "torque"].map(|column| found(number, column)))
}

fn assert_points(scene: &Scene, wanted: &[[f64; 2]]) {
    let found = points(scene);
    let unset = std::iter::repeat(&[0.0; 2]);
    for (found, wanted) in found.iter().zip(wanted.iter().chain(unset)) {
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() <= 1e-12 * wanted, "{found} instead of {wanted}");
        }
    }
    let set: Vec<[f64; 2]> =
        scene.parameters.specs.limited_slip.curve.iter().map(|point| [point.slip, point.torque]).collect();
    assert_eq!(set, found, "the parameters");
}

/// Slip and torque of the curve that the tests write in several forms.
fn measured() -> [[f64; 2]; 3] {
    [[0.0, 50.0], [100.0 * TAU / 60.0, 80.0], [30.0, 90.0]]
}

fn problem(scene: Result<Scene>) -> String {
    scene.err().map(|error| format!("{error:#}")).unwrap_or_default()
}

#[test]
fn a_list_of_points_sets_all_points_in_any_unit() -> Result<()> {
    for list in [
        "[[\"0 rpm\", \"50 N.m\"], [\"100 rpm\", \"80 N·m\"], [30.0, 90.0]]",
        "[[0, 50], [\"600 deg/s\", \"0.08 kN.m\"], [\"30 rad/s\", 90]]",
    ] {
        assert_points(&parsed(&format!("limited_slip.curve = {list}\n"))?, &measured());
        assert_points(&parsed(&format!("[set.limited_slip]\ncurve = {list}\n"))?, &measured());
        assert_points(&changed(parsed("")?, &[&format!("limited_slip.curve={list}")])?, &measured());
    }
    let eight: Vec<String> = (1..=POINTS).map(|number| format!("[{number}, {}]", 10 * number)).collect();
    let wanted: Vec<[f64; 2]> = (1..=POINTS).map(|number| [number as f64, 10.0 * number as f64]).collect();
    assert_points(&parsed(&format!("limited_slip.curve = [{}]\n", eight.join(", ")))?, &wanted);
    Ok(())
}

#[test]
fn a_file_next_to_the_scene_sets_the_same_points_as_a_list() -> Result<()> {
    let folder = Folder::new("files")?;
    for csv in [
        "slip [rpm],torque [N·m]\n0,50\n100,80\n286.4788975654116,90\n",
        "# of a test bench\ntorque;slip\n50;0\n80;10,471975511965978\n90;30\n",
        "\u{feff}torque [kN.m]\tslip [deg/s]\r\n0.05\t0\r\n0.08\t600\r\n\r\n0.09\t1718.8733853924696\r\n",
    ] {
        assert_points(&folder.scene(FROM_FILE, csv)?, &measured());
    }
    // a path on the command line does not depend on the folder of the scene
    let absolute = format!("limited_slip.curve={}", folder.file().display());
    assert_points(&changed(parsed("")?, &[&absolute])?, &measured());
    Ok(())
}

#[test]
fn a_curve_on_the_command_line_replaces_all_points_of_the_scene() -> Result<()> {
    let four = "limited_slip.curve = [[1, 10], [2, 20], [3, 30], [4, 40]]\n";
    assert_points(&changed(parsed(four)?, &["limited_slip.curve=[[5, 60]]"])?, &[[5.0, 60.0]]);
    assert_points(&changed(parsed(four)?, &["limited_slip.curve=[[0, 0]]"])?, &[]);
    let single = changed(parsed(four)?, &["limited_slip.curve[2].torque=25 N.m"])?;
    assert_points(&single, &[[1.0, 10.0], [2.0, 25.0], [3.0, 30.0], [4.0, 40.0]]);
    let points_of_file = "\"limited_slip.curve[1].slip\" = 7\n\"limited_slip.curve[8].torque\" = 70\n";
    assert_points(&changed(parsed(points_of_file)?, &["limited_slip.curve=[[5, 60]]"])?, &[[5.0, 60.0]]);
    Ok(())
}

#[test]
fn exports_contain_the_points() -> Result<()> {
    let scene = parsed("limited_slip.curve = [[0, 50], [\"100 rpm\", \"80 N.m\"]]\n")?;
    let (script, ssv) = (script::text(&scene)?, ssv::text(&scene)?);
    assert!(script.contains("\"limited_slip.curve[2].torque\": 80.0,  # 80 N.m"), "{script}");
    assert!(ssv.contains("limited_slip.curve[2].torque") && !ssv.contains("limited_slip.curve\""), "{ssv}");
    Ok(())
}

#[test]
fn wrong_lists_are_reported_with_point_value_unit_and_remedy() {
    let nine: Vec<String> = (1..=9).map(|number| format!("[{number}, 10]")).collect();
    for (list, wanted) in [
        (
            format!("[{}]", nine.join(",")),
            &["limited_slip.curve, point 9", "at most 8 points", "has 9", "leave some out"][..],
        ),
        ("[]".into(), &["limited_slip.curve = []", "has no points", "give at least one"]),
        ("[[0, 50], [10]]".into(), &["limited_slip.curve, point 2", "has 1 entries", "pair [slip, torque]"]),
        ("[[0, 50, 1]]".into(), &["point 1", "has 3 entries", "pair [slip, torque]"]),
        ("[[0, 50], 10]".into(), &["point 2 = 10", "pair [slip, torque]"]),
        ("[[0, 50], [\"10 rpn\", 60]]".into(), &["point 2, slip = \"10 rpn\"", "unit rpn", "units that do: rad/s"]),
        ("[[\"5 N.m\", 50]]".into(), &["point 1, slip = \"5 N.m\"", "unit N.m", "units that do: rad/s"]),
        ("[[0, \"50 rpm\"]]".into(), &["point 1, torque = \"50 rpm\"", "unit rpm", "units that do: N.m"]),
        ("[[\"10\", 50]]".into(), &["point 1, slip = \"10\"", "has no unit", "write one of rad/s"]),
        ("[[true, 50]]".into(), &["point 1, slip = true", "must be a number"]),
        ("[[0, -50]]".into(), &["point 1, torque = -50", "outside [0, 1000000] N.m"]),
        ("[[0, nan]]".into(), &["point 1, torque = NaN", "not a finite number"]),
        ("[[2e4, 50]]".into(), &["point 1, slip = 20000", "outside [0, 10000] rad/s"]),
        (
            "[[0, 50], [10, 60], [10, 70]]".into(),
            &["point 3, slip = ", "not above the slip of the point before", "sort"],
        ),
        ("[[10, 50], [0, 0]]".into(), &["point 2, slip = 0 rpm", "not above"]),
        ("7".into(), &["limited_slip.curve = 7", "list of points [slip, torque]", "path of a CSV file"]),
        ("\"[[0, 50\"".into(), &["limited_slip.curve = [[0, 50", "is not a list such as"]),
    ] {
        let problem = problem(parsed(&format!("limited_slip.curve = {list}\n")));
        println!("{problem}");
        assert!(problem.starts_with("[set] limited_slip.curve") && problem.lines().count() == 1, "{list}: {problem}");
        for part in wanted {
            assert!(problem.contains(part), "\"{part}\" is not in: {problem}");
        }
    }
    // all problems of a list are reported together
    let several = problem(parsed("limited_slip.curve = [[\"1 kg\", -1], [\"2 kg\", 5]]\n"));
    assert_eq!(several.lines().count(), 3, "{several}");
}

#[test]
fn wrong_files_are_reported_with_line_column_value_and_remedy() -> Result<()> {
    let folder = Folder::new("wrong")?;
    let nine: String = (1..=9).map(|number| format!("{number},10\n")).collect();
    for (csv, wanted) in [
        ("slip,torqe\n0,50\n", &["column torqe", "is not a column of a curve", "slip [rpm],torque [N.m]"][..]),
        ("slip [rpm]\n0\n", &["header \"slip [rpm]\"", "has no column torque", "slip [rpm],torque [N.m]"]),
        ("slip,torque,note\n0,50,1\n", &["column note", "is not a column of a curve"]),
        ("slip,torque,slip [rpm]\n0,50,1\n", &["column slip [rpm]", "twice"]),
        ("slip [rpn],torque\n0,50\n", &["column slip [rpn]", "unit rpn", "units that do: rad/s"]),
        ("slip [N.m],torque\n0,50\n", &["column slip [N.m]", "unit N.m", "units that do: rad/s"]),
        ("slip,torque\n", &["has no points", "write a line for each"]),
        ("", &["is empty"]),
        ("slip,torque\n0,x\n", &["line 2, column torque, value \"x\"", "is not a number"]),
        ("slip,torque\n0,50 N.m\n", &["line 2, column torque, value \"50 N.m\"", "unit in the header"]),
        ("slip,torque [kN.m]\n0,50\n# c\n1,5000\n", &["line 4, torque = \"5000 kN.m\"", "outside [0, 1000000] N.m"]),
        (
            "slip [rpm],torque\n0,50\n20,60\n10,70\n",
            &["line 4, slip = 10 rpm", "point before, 20 rpm", "sort the points"],
        ),
        ("slip;torque\n0;1,500\n", &["line 2, column torque, value \"1,500\"", "thousands"]),
        (&format!("slip,torque\n{nine}"), &["line 10", "at most 8 points", "has 9"]),
    ] {
        let problem = problem(folder.scene(FROM_FILE, csv));
        println!("{problem}");
        let named = problem.starts_with("[set] limited_slip.curve: ") && problem.contains("clutch.csv");
        let is_two = csv.starts_with("slip,torqe");
        assert!(named && problem.lines().count() == if is_two { 2 } else { 1 }, "{csv}: {problem}");
        for part in wanted {
            assert!(problem.contains(part), "\"{part}\" is not in: {problem}");
        }
    }
    let missing = problem(folder.scene(&FROM_FILE.replace("clutch", "clutches"), ""));
    for part in ["limited_slip.curve: ", "clutches.csv: there is no such file", "relative to the scene's file"] {
        assert!(missing.contains(part), "\"{part}\" is not in: {missing}");
    }
    Ok(())
}

#[test]
fn a_curve_and_a_single_point_together_are_refused() {
    let list = "limited_slip.curve = [[0, 50]]\n";
    let point = "\"limited_slip.curve[2].slip\" = 5\n";
    for text in [format!("{list}{point}"), format!("{point}{list}")] {
        let problem = problem(parsed(&text));
        let wanted =
            "[set] limited_slip.curve sets all points, and limited_slip.curve[2].slip is set as well; leave one out";
        assert_eq!(problem, wanted);
    }
    let changes = ["limited_slip.curve=[[0, 50]]", "limited_slip.curve[2].slip=5"];
    for changes in [changes, [changes[1], changes[0]]] {
        let problem = problem(parsed("").and_then(|scene| changed(scene, &changes)));
        assert!(
            problem.starts_with("--set: limited_slip.curve sets all points, and limited_slip.curve[2].slip"),
            "{problem}"
        );
        assert_eq!(problem.lines().count(), 1, "{problem}");
    }
}

#[test]
fn a_curve_is_refused_during_a_run() {
    let problem = problem(parsed("[[at]]\ntime = 0.005\nlimited_slip.curve = [[0, 50]]\n"));
    assert!(problem.contains("[[at]] time = 0.005 s: limited_slip.curve is fixed"), "{problem}");
    assert_eq!(problem.lines().count(), 1, "{problem}");
}

//! Laws of a tooth pair over gears and loads: how far each is from the richest model in deflection, transmission error and
//! ripple.

use anyhow::{Result, anyhow};
use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Parameters};

use answers::accuracy::gears::Gears;
use answers::accuracy::record::{Record, in_one_line};
use answers::accuracy::want::{self, Want};
use answers::accuracy::words::percent;
use answers::scene::{self, Scene};
use answers::text::table::Table;
use answers::watch::Watch;

/// Gear pairs: teeth of planet and side gear, module [m], face width as a part of the cone distance, bores [m].
const PAIRS: [(i32, i32, f64, f64, [f64; 2]); 4] = [
    (10, 16, 4.5e-3, 0.471, [0.0, 0.0]),
    (10, 16, 4.5e-3, 0.3, [16e-3, 30e-3]),
    (12, 20, 3e-3, 0.28, [11e-3, 24e-3]),
    (14, 18, 6e-3, 0.3, [22e-3, 40e-3]),
];
/// Loads of a wheel, as parts of the study's torque for gears of its size.
const LOADS: [f64; 3] = [0.1, 0.5, 1.0];
/// The study's load [N·m] for its outer cone distance [m].
const STUDY: [f64; 2] = [835.0, 42.45e-3];
/// What is judged: columns of the table.
const WANTS: [(&str, &str); 5] = [
    ("mean force", "planet[1].left_normal_force:mean"),
    ("largest force", "planet[1].left_normal_force:max"),
    ("mean transmission error", "planet[1].left_transmission_error:mean"),
    ("its swing", "planet[1].left_transmission_error:peak_to_peak"),
    ("ripple of speed", "left.speed:peak_to_peak"),
];
/// Laws against the richest.
const LAWS: [(ContactLaw, bool); 4] =
    [(ContactLaw::Impact, false), (ContactLaw::Line, false), (ContactLaw::LineWeber, false), (ContactLaw::Line, true)];
/// The part of the turn in which the teeth meet, which does not count.
const START: f64 = 0.1;

/// Errors of each law for all pairs and loads, smallest and largest.
pub fn measure(report: &mut dyn FnMut(f64, &str)) -> Result<String> {
    let turn = scene::find("study_turning", &fmu_build::tools::paths::scenes())?;
    let texts: Vec<String> = WANTS.iter().map(|(_, text)| (*text).to_owned()).collect();
    let (turn, wants) = want::parse(&turn, &texts).map_err(|why| anyhow!("{why}"))?;
    let mut ranges = vec![vec![[f64::INFINITY, 0.0f64]; WANTS.len()]; LAWS.len()];
    let cases = PAIRS.iter().flat_map(|pair| LOADS.map(|load| (pair, load)));
    for (k, (pair, load)) in cases.enumerate() {
        report(k as f64 / (PAIRS.len() * LOADS.len()) as f64, &format!("laws, {}/{} teeth", pair.0, pair.1));
        let scene = with(&turn, pair, load);
        let record = |law: (ContactLaw, bool)| {
            let gears = Gears { level: GearContact::Tooth, law: law.0, bodies: law.1 };
            let scene = gears.of_scene(&scene).map_err(|found| anyhow!("{}", in_one_line(&found)))?.scene;
            Record::of(&scene, START * scene.stop_time, f64::INFINITY, &mut Watch::nobody())
                .map_err(|why| anyhow!("{}: {why}", gears.text()))
        };
        let reference = record((ContactLaw::LineWeber, true))?;
        for (law, ranges) in LAWS.iter().zip(&mut ranges) {
            let found = record(*law)?;
            for (want, range) in wants.iter().zip(ranges) {
                let error = error(want, &scene, &found, &reference).map_err(|why| anyhow!("{why}"))?;
                *range = [range[0].min(error), range[1].max(error)];
            }
        }
    }
    let head = ["law"].into_iter().chain(WANTS.map(|(title, _)| title));
    let mut table = Table::new(head).all_left();
    for ((law, bodies), ranges) in LAWS.iter().zip(&ranges) {
        let name = Gears { level: GearContact::Tooth, law: *law, bodies: *bodies }.text().replace("tooth ", "");
        let cells = ranges.iter().map(|[least, most]| format!("{} … {}", percent(*least), percent(*most)));
        table.push(
            [format!("`{}`", name.replace(" +", "` +").trim_end_matches('`'))
                .replace("` + gear bodies`", "` + gear bodies")]
            .into_iter()
            .chain(cells),
        );
    }
    let title = "Errors of each law against `line_weber` + gear bodies, least and largest over four gear pairs (10/16, 12/20 and 14/18 \
                 teeth, modules 3 to 6 mm, with and without bores) and loads from 10 to 100 % of the study's for the size";
    Ok(format!("{title}:\n\n{}", table.markdown()))
}

fn error(want: &Want, scene: &Scene, found: &Record, reference: &Record) -> Result<f64, String> {
    let [value, wanted] = [found, reference].map(|record| want.statistic.of(record, want.output));
    Ok(Want::error(value?, wanted?, want.scale(scene, reference)?))
}

/// The turn with another gear pair, and a load in proportion to the cube of its size.
fn with(turn: &Scene, pair: &(i32, i32, f64, f64, [f64; 2]), load: f64) -> Scene {
    let &(planet, side, module, face, [planet_bore, side_bore]) = pair;
    let mut scene = turn.clone();
    let cone = 0.5 * module * f64::from(planet).hypot(f64::from(side));
    let p: &mut Parameters = &mut scene.parameters;
    let g = &mut p.geometry;
    (g.planet_teeth, g.side_teeth, g.module, g.face_width) = (planet, side, module, face * cone);
    (g.planet_bore, g.side_bore) = (planet_bore, side_bore);
    let torque = load * STUDY[0] * (cone / STUDY[1]).powi(3);
    scene.inputs.load_torque = [torque; 2];
    scene
}

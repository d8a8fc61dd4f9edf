//! Forces over time for FEA: those of the meshes in the frames of both gears, one line per loaded tooth pair or slice, and
//! those of the final drive on the ring gear and on the bearings of the carrier.

use std::f64::consts::PI;
use std::io::Write;

use anyhow::Result;
use bevel_differential::contact::pairs::{Flank, Spot};
use bevel_differential::geometry::Pair;
use bevel_differential::geometry::action::LineOfAction;
use bevel_differential::model::{GearContact, ToothLoad};
use bevel_differential::variables::table;

use super::run::SceneRun;
use super::{Scene, off};
use crate::problem::question_error;
use crate::progress::Progress;

/// Times that differ by less than this fraction of an interval are equal.
const SAME: f64 = 1e-6;

/// Columns of the load. Columns of its position and direction on each gear follow.
const LOAD: &str = "time,planet,side,flank,spot,planet_tooth,side_tooth,share,s,cone,normal,friction";
/// Columns of a gear: point, normal, force.
const VECTORS: [&str; 9] = ["x", "y", "z", "nx", "ny", "nz", "Fx", "Fy", "Fz"];

/// Force of a tooth pair on one gear, in the gear's own frame.
#[derive(Clone, Copy, Debug)]
pub struct OnGear {
    /// Point [m].
    pub point: [f64; 3],
    /// Unit normal, into the gear's material.
    pub normal: [f64; 3],
    /// Sum of normal force and friction [N].
    pub force: [f64; 3],
}

/// Forces of `load` on the planet and on the side gear.
pub fn on_gears(action: &LineOfAction, pair: &Pair, load: &ToothLoad) -> [OnGear; 2] {
    let (contact, turn) = (load.contact(action), load.turn());
    [0, 1].map(|i| {
        let own = action.in_gear(&contact, i, load.tooth_azimuth(pair, i), turn);
        // the normal points from the planet into the side gear
        let sign = if i == 0 { -1.0 } else { 1.0 };
        let normal = own.normal * sign;
        let force = normal * load.normal - own.along * (sign * load.friction);
        OnGear { point: (own.point * load.cone).into(), normal: normal.into(), force: force.into() }
    })
}

/// Groups of outputs that are forces of the final drive.
const OF_FINAL_DRIVE: [&str; 3] = ["ring_gear.", "left_bearing.", "right_bearing."];

/// Writes the history of the meshes in `scene` to `out`, with a record every `every` seconds (by default the communication
/// step). Returns the number of lines, and an explanation of the file.
pub fn write(scene: &Scene, every: Option<f64>, out: &mut dyn Write, progress: &mut Progress) -> Result<(u64, String)> {
    if scene.parameters.scene.gear_contact == GearContact::Ideal {
        return Err(question_error(format!(
            "scene {} has no teeth (scene.gear_contact = ideal): there are no tooth pairs under load",
            scene.name
        )));
    }
    let mut rows = csv::Writer::from_writer(out);
    let columns = |gear: &'static str| VECTORS.map(|v| format!("{gear}_{v}"));
    let head = LOAD.split(',').map(str::to_owned).chain(columns("planet")).chain(columns("side"));
    rows.write_record(head)?;
    let mut lines = 0u64;
    let (run, every) = records(scene, every, progress, |run| {
        let (time, mut written) = (run.time(), Ok(()));
        let pair = *run.simulation.pair();
        let action = LineOfAction::new(&pair);
        run.simulation.tooth_loads(|load| {
            if written.is_ok() {
                written = line(&mut rows, time, load, &on_gears(&action, &pair, load));
                lines += 1;
            }
        });
        Ok(written?)
    })?;
    rows.flush()?;
    Ok((lines, explanation(scene, every, &run)))
}

/// Writes the forces of the final drive on the ring gear and on the bearings of the carrier, as [`write()`] does.
pub fn write_bearings(
    scene: &Scene,
    every: Option<f64>,
    out: &mut dyn Write,
    progress: &mut Progress,
) -> Result<(u64, String)> {
    let forces = || table().rows.iter().filter(|row| OF_FINAL_DRIVE.iter().any(|group| row.name.starts_with(group)));
    if let Some(why) = forces().find_map(|row| off::reason(row.name, scene)) {
        return Err(question_error(format!("scene {} has no forces on carrier bearings: {why}", scene.name)));
    }
    let mut rows = csv::Writer::from_writer(out);
    rows.write_record(std::iter::once("time").chain(forces().map(|row| row.name)))?;
    let mut lines = 0u64;
    records(scene, every, progress, |run| {
        let values: Vec<f64> = std::iter::once(run.time()).chain(forces().map(|row| run.read(row))).collect();
        lines += 1;
        Ok(rows.write_record(values.iter().map(|value| format!("{value:.12e}")))?)
    })?;
    rows.flush()?;
    let explanation = "forces of the final drive in N: on the ring gear along its circumference (positive if it drives forward), along the \
                       axle (positive away from the planets) and toward the axle; on the bearings of the carrier to the left (axial), upward \
                       (vertical) and forward (longitudinal)\n";
    Ok((lines, explanation.into()))
}

/// Runs `scene` and calls `record` every `every` seconds. Returns the finished run, and the time between records.
fn records<'a>(
    scene: &'a Scene,
    every: Option<f64>,
    progress: &mut Progress,
    mut record: impl FnMut(&mut SceneRun) -> Result<()>,
) -> Result<(SceneRun<'a>, f64)> {
    let every = every.unwrap_or(scene.step);
    // a scene of zero duration has one record, at its start
    if !(every > 0.0 && (every <= scene.stop_time || scene.stop_time == 0.0)) {
        return Err(question_error(format!(
            "--every {every} s: must be above 0 and at most the scene's {} s",
            scene.stop_time
        )));
    }
    let mut run = SceneRun::start(scene, scene.step.min(every))?;
    progress.begin_task(0.0, "simulating");
    let mut done = 0u64;
    loop {
        if run.time() >= (done as f64 - SAME) * every {
            record(&mut run)?;
            done += 1;
        }
        if run.is_over() {
            break;
        }
        run.advance()?;
        progress.advance(run.time() / scene.stop_time)?;
    }
    progress.warn(run.warnings());
    Ok((run, every))
}

fn line(rows: &mut csv::Writer<&mut dyn Write>, time: f64, load: &ToothLoad, gears: &[OnGear; 2]) -> csv::Result<()> {
    let side = ["left", "right"][load.side];
    let flank = if load.flank == Flank::Drive { "drive" } else { "coast" };
    let spot = match load.spot {
        Spot::Path => "path",
        Spot::PlanetTip => "planet_tip",
        Spot::SideTip => "side_tip",
    };
    let values = [load.share, load.s, load.cone, load.normal, load.friction].into_iter();
    let vectors = gears.iter().flat_map(|g| [g.point, g.normal, g.force]).flatten();
    let mut cells = vec![format!("{time:.9e}"), (load.planet + 1).to_string()];
    cells.extend([side, flank, spot].map(str::to_owned));
    cells.extend(load.teeth.map(|tooth| tooth.to_string()));
    cells.extend(values.chain(vectors).map(|value| format!("{value:.12e}")));
    rows.write_record(cells)
}

/// Scene, columns and frames of the file, for the terminal.
fn explanation(scene: &Scene, every: f64, run: &SceneRun) -> String {
    let (plan, pair) = (run.simulation.plan(), run.simulation.pair());
    let mut out = format!(
        "mesh forces of scene {}: {}\n{}\n\
         one line per loaded tooth pair (per slice of it if loads differ over the face) every {every} s, in SI\n",
        scene.name,
        scene.description,
        run.simulation.describe()
    );
    for group in plan.groups() {
        let planets: Vec<String> = (0..plan.planets)
            .filter(|&i| plan.groups()[plan.group_of[i]] == *group)
            .map(|i| (i + 1).to_string())
            .collect();
        if planets.len() > 1 {
            out += &format!(
                "planet {} stands for planets {}, whose loads are equal\n",
                group.planet + 1,
                planets.join(", ")
            );
        }
    }
    let degrees = |i: usize| pair.gears[i].tooth_pitch() * 180.0 / PI;
    out + &format!(
        "\
share: fraction of the face that the line covers; s: position on the path of contact, an arc from the pitch point toward
  the planet's tip; cone: distance of the point from the apex; spot: on the path, or a tip corner on the mate's flank
normal: normal force; friction: along the flank, positive toward the planet's root on the planet
frames: right-handed, apex at the origin, z along the gear's own axis from apex to heel, x along the middle of its tooth 0;
  they turn with the gears
planet tooth k is at azimuth -k * {} deg, tooth k of the left side gear at +k * {} deg, of the right at -k * {1} deg
  (planet teeth count with positive spin, side gear teeth with forward rotation)
x, y, z: point on the undeformed flank (or a tip corner); nx, ny, nz: unit normal into the gear's material;
  Fx, Fy, Fz: force on the gear, friction included; in space those on planet and side gear are opposite
",
        degrees(0),
        degrees(1)
    )
}

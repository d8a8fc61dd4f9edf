//! One engagement of a pair of teeth, section by section and instant by instant.
//!
//! The followed pair is the first one of planet 1's left mesh to come into contact after the start. It is followed until it
//! parts. A section lies where the solids touch, at the polar angle φ about the axis of each gear. On the unit sphere a flank
//! has the radius of curvature tan ψ(φ) there. The relative radius at the cone distance R is
//!
//!   ρ = R / (cot ψ_p + cot ψ_s)
//!
//! A tip corner is no cylinder. Its pressure is calculated with the radii of the flanks at the end of the path, and so is less
//! than the real pressure at the edge. Aligned teeth have one section for the whole face; here it is divided evenly.

use std::collections::HashMap;

use anyhow::{Result, bail, ensure};
use bevel_differential::contact::pairs::{Flank, Spot};
use bevel_differential::geometry::Pair;
use bevel_differential::model::{GearContact, Simulation, ToothLoad, Touch};
use bevel_differential::strength::LineContact;

use crate::progress::Progress;
use crate::scene::Scene;
use crate::scene::run::SceneRun;
use crate::text::csv_file::CsvFile;

/// Sections into which a section of the whole face is divided.
const SECTIONS: usize = 8;

/// A tooth pair: whether the drive flanks touch, and the numbers of the planet's and the side gear's tooth.
pub type PairName = (bool, [usize; 2]);

/// A loaded section of a tooth pair at an instant.
#[derive(Clone, Copy, Debug)]
pub struct LoadedSection {
    /// Time [s].
    pub time: f64,
    /// Tooth pair.
    pub name: PairName,
    /// Whether the section touches at a tip corner.
    pub is_corner: bool,
    /// Place on the path of contact, as it follows from the planet's rotation [rad].
    pub s: f64,
    /// Cone distance [m].
    pub cone: f64,
    /// Width of the face that the section stands for [m].
    pub width: f64,
    /// Polar angles on planet and side gear [rad].
    pub polar: [f64; 2],
    /// Normal force per width [N/m].
    pub line_load: f64,
    /// Relative radius of curvature [m].
    pub radius: f64,
    /// Hertz pressure [Pa].
    pub pressure: f64,
    /// Half-width of the strip of contact [m].
    pub half_width: f64,
}

impl LoadedSection {
    /// Normal force [N].
    pub fn force(&self) -> f64 {
        self.line_load * self.width
    }
}

/// Loaded sections of the mesh until the engagement of one pair is complete.
#[derive(Clone, Debug)]
pub struct Engagement {
    /// The gears.
    pub pair: Pair,
    /// Loaded sections of all pairs by time; those of an instant in the order of the simulation.
    pub contacts: Vec<LoadedSection>,
    /// The pair with the complete engagement.
    pub followed: PairName,
}

impl Engagement {
    /// Runs `scene` until a pair that came into contact after the start has parted.
    pub fn new(scene: &Scene, progress: &mut Progress) -> Result<Self> {
        ensure!(
            scene.parameters.scene.gear_contact == GearContact::Solid,
            "scene {}: contact patterns need solid teeth: set scene.gear_contact = \"solid\"",
            scene.name
        );
        let mut run = SceneRun::start(scene, scene.step)?;
        let pair = *run.simulation.pair();
        let m = &scene.parameters.material;
        let line = LineContact::new(&pair, m.young_modulus, m.poisson_ratio);
        let mut contacts = Vec::new();
        // pairs in contact, and whether each of them came into contact after the start
        let mut seen: HashMap<PairName, bool> = HashMap::new();
        let mut first = true;
        while !run.is_over() {
            if !first {
                run.advance()?;
                progress.check_stopped()?;
            }
            let now = instant(&run.simulation, &pair, &line);
            now.iter().for_each(|c| {
                seen.entry(c.name).or_insert(!first);
            });
            let parted = seen.iter().find(|(name, fresh)| **fresh && now.iter().all(|c| c.name != **name));
            if let Some((&followed, _)) = parted {
                return Ok(Self { pair, contacts, followed });
            }
            seen.retain(|name, _| now.iter().any(|c| c.name == *name));
            contacts.extend(now);
            first = false;
        }
        bail!("scene {}: no pair of planet 1's left mesh came into touch and parted again before its end", scene.name)
    }

    /// Sections of the followed pair.
    pub fn engagement(&self) -> impl Iterator<Item = &LoadedSection> {
        self.contacts.iter().filter(|c| c.name == self.followed)
    }

    /// Sections of the followed pair at the instant of least distance from the pitch point.
    pub fn at_pitch_point(&self) -> Vec<LoadedSection> {
        let nearest = self.engagement().min_by(|a, b| a.s.abs().total_cmp(&b.s.abs()));
        nearest.map_or(Vec::new(), |n| self.engagement().filter(|c| c.time == n.time).copied().collect())
    }

    /// A CSV file for loaded sections, without rows.
    pub fn file() -> Result<CsvFile> {
        let comments = [
            "loaded sections of planet 1's left mesh; height: along the profile from the pitch circle at that cone distance",
            "followed: the pair whose engagement is whole; corner: 1 where a tip corner carries; its pressure is calculated",
            "with the radii at the end of the path, and the real one is higher",
            "units: -,s,-,-,-,-,-,rad,mm,mm,mm,mm,N/mm,mm,MPa,mm",
        ];
        let columns = "case,time,flank,planet_tooth,side_tooth,followed,corner,s,cone,width,planet_height,side_height,\
                       line_load,radius,pressure,half_width";
        CsvFile::new(columns, &comments)
    }

    /// Adds all sections to the file `out`, with `case` in the first column.
    pub fn rows(&self, case: &str, out: &mut CsvFile) -> Result<()> {
        for c in &self.contacts {
            let [planet, side] = [0, 1].map(|i| 1e3 * c.cone * (c.polar[i] - self.pair.gears[i].pitch));
            let flank = if c.name.0 { "drive" } else { "coast" };
            let marks = [u8::from(c.name == self.followed), u8::from(c.is_corner)].map(|mark| mark.to_string());
            let lengths = [1e3 * c.cone, 1e3 * c.width, planet, side, 1e-3 * c.line_load, 1e3 * c.radius];
            let mut cells = vec![case.to_owned(), format!("{:.6}", c.time), flank.to_owned()];
            cells.extend(c.name.1.map(|tooth| tooth.to_string()));
            cells.extend(marks);
            cells.push(format!("{:.6}", c.s));
            cells.extend(lengths.map(|length| format!("{length:.4}")));
            cells.extend([format!("{:.2}", 1e-6 * c.pressure), format!("{:.4}", 1e3 * c.half_width)]);
            out.push(cells)?;
        }
        Ok(())
    }
}

/// Loaded sections of planet 1's left mesh at the present time of the simulation.
pub fn instant(simulation: &Simulation, pair: &Pair, line: &LineContact) -> Vec<LoadedSection> {
    let (mut all, time) = (Vec::new(), simulation.time());
    simulation.tooth_loads(|load| {
        if let (0, 0, Some(touch)) = (load.planet, load.side, load.touch) {
            all.extend(sections(pair, load).map(|(cone, width)| contact(pair, line, time, load, &touch, cone, width)));
        }
    });
    all
}

/// Cone distances and widths of the sections of a load: several for a load of the whole face, one otherwise.
fn sections(pair: &Pair, load: &ToothLoad) -> impl Iterator<Item = (f64, f64)> {
    let (face, alone) = (pair.outer_cone - pair.inner_cone, load.normal / load.line_load);
    let whole = alone > (1.0 - 1e-9) * face;
    let (count, cone, inner) = (if whole { SECTIONS } else { 1 }, load.cone, pair.inner_cone);
    let width = if whole { face / SECTIONS as f64 } else { alone };
    (0..count).map(move |i| (if whole { inner + width * (i as f64 + 0.5) } else { cone }, width))
}

fn contact(
    pair: &Pair,
    line: &LineContact,
    time: f64,
    load: &ToothLoad,
    t: &Touch,
    cone: f64,
    width: f64,
) -> LoadedSection {
    // a tip corner lies past the end of the path: arcs from the base circles are not taken below those at its ends
    let least = [pair.pitch_arc[0] + pair.path.low, pair.pitch_arc[1] - pair.path.high];
    let cot = |i: usize| 1.0 / pair.gears[i].action_arc(t.polar[i]).max(least[i]).tan();
    let radius = cone / (cot(0) + cot(1));
    let pressure = line.pressure_on(load.line_load, radius).unwrap_or(0.0);
    LoadedSection {
        time,
        name: (load.flank == Flank::Drive, load.teeth),
        is_corner: load.spot != Spot::Path,
        s: load.s,
        cone,
        width,
        polar: t.polar,
        line_load: load.line_load,
        radius,
        pressure,
        half_width: LineContact::half_width(load.line_load, pressure),
    }
}

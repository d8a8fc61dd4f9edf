//! One engagement of a pair of teeth, by section and instant.
//!
//! The followed pair is the first pair of planet 1's left mesh that comes into contact after the start and separates
//! again. Teeth with a contact law may lift off and touch again in between. Their pair therefore counts only if it was
//! loaded over a base pitch. Every pair is loaded over a base pitch if the mesh never separates. If no pair completes its engagement, as on a
//! straight road, the most loaded pair is followed instead and a warning is given.
//!
//! The steps are those of the scene. They are shorter if a pair would pass in fewer than `INSTANTS` of them.

use std::collections::HashMap;

use anyhow::{Result, bail};
use bevel_differential::geometry::Pair;
use bevel_differential::model::{GearContact, Parameters};
use bevel_differential::variables::{Variable, named};

use super::sections::{Flanks, LoadedSection, PairName};
use crate::problem::question_error;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::scene::run::SceneRun;
use crate::text::csv_file::CsvFile;

/// Minimum number of instants per tooth pitch for teeth with a contact law.
const INSTANTS: f64 = 200.0;
/// Tooth pitches after which the speed is known well enough to choose the steps.
const PITCHES: f64 = 3.0;
/// Fraction of a base pitch over which a pair with a contact law must be loaded for a complete engagement.
const THROUGH: f64 = 0.9;
/// Relative tolerance for equal instants of teeth with a contact law: they move by less than this fraction of a base
/// pitch, and their forces change by less than this fraction.
const SAME: f64 = 1e-3;
/// Angle of planet 1 relative to the carrier.
const ANGLE: &str = "planet[1].spin_angle";

/// Loaded sections of the mesh until the engagement of one pair is complete.
#[derive(Clone, Debug)]
pub struct Engagement {
    /// The gears.
    pub pair: Pair,
    /// Loaded sections of all pairs by time. Sections of one instant are in the order of the simulation.
    pub contacts: Vec<LoadedSection>,
    /// Pair with the complete engagement, or else the most loaded pair.
    pub followed: PairName,
    /// True if this pair came into touch and parted again.
    pub is_whole: bool,
    /// Cone distances beyond which only the outermost section of the face remains [m]; `None` for solid teeth, whose
    /// sections move.
    pub ends: Option<[f64; 2]>,
}

impl Engagement {
    /// Runs `scene` until a pair that came into contact after the start has separated.
    pub fn new(scene: &Scene, progress: &mut Progress) -> Result<Self> {
        Self::coarser(scene, 1.0, progress)
    }

    /// Runs `scene` as [`Self::new`] does, in steps that are longer by the factor `coarser`.
    pub fn coarser(scene: &Scene, coarser: f64, progress: &mut Progress) -> Result<Self> {
        let p = &scene.parameters;
        let solid = match p.scene.gear_contact {
            GearContact::Solid => true,
            GearContact::Tooth => false,
            _ => {
                return Err(question_error(format!(
                    "scene {}: a contact pattern needs single tooth pairs: set scene.gear_contact = tooth, with contact.law = line \
                     or line_weber, or scene.gear_contact = solid",
                    scene.name
                )));
            }
        };
        let law = p.contact.law;
        if !solid && !law.is_of_teeth() {
            progress.warn([format!(
                "contact.law: scene {}: {} has one resultant for the whole face, so that the pattern is even over the face \
                 whatever the errors; line and line_weber have a load at each cone distance",
                scene.name,
                law.literal()
            )]);
        }
        let step = coarser * if solid { scene.step } else { step(scene, progress)? };
        let mut run = SceneRun::start(scene, step)?;
        let m = &p.material;
        let flanks = Flanks::new(&run.simulation, m.young_modulus, m.poisson_ratio, grows(p));
        let pair = flanks.pair;
        let ends = (!solid).then(|| [pair.inner_cone + flanks.width(), pair.outer_cone - flanks.width()]);
        let mut contacts: Vec<LoadedSection> = Vec::new();
        // pairs in contact: true if the pair came into contact after the start, and its smallest and largest position
        // [rad]
        let mut seen: HashMap<PairName, (bool, [f64; 2])> = HashMap::new();
        let (mut first, mut last) = (true, Vec::new());
        while !run.is_over() {
            if !first {
                let before = run.time();
                run.advance()?;
                progress.check_stopped()?;
                // an instant has one set of sections, those before a jump
                if run.time() == before {
                    continue;
                }
            }
            let now = flanks.instant(&run.simulation);
            for c in &now {
                let (_, [low, high]) = seen.entry(c.name).or_insert((!first, [c.s; 2]));
                (*low, *high) = (low.min(c.s), high.max(c.s));
            }
            let through = |[low, high]: [f64; 2]| solid || high - low > THROUGH * pair.base_pitch;
            let is_loaded = |name: &PairName| now.iter().any(|c| c.name == *name);
            let parted = seen.iter().find(|(name, (fresh, range))| *fresh && through(*range) && !is_loaded(name));
            if let Some((&followed, _)) = parted {
                progress.warn(run.warnings());
                return Ok(Self { pair, contacts, followed, is_whole: true, ends });
            }
            seen.retain(|name, (fresh, _)| is_loaded(name) || (!solid && *fresh));
            if solid || !is_same(&last, &now, pair.base_pitch) {
                contacts.extend(&now);
                last = now;
            }
            first = false;
        }
        let largest = contacts.iter().max_by(|a, b| a.line_load.total_cmp(&b.line_load));
        let Some(followed) = largest.map(|c| c.name).filter(|_| !solid) else {
            bail!(
                "scene {}: no pair of planet 1's left mesh came into touch and parted again before its end",
                scene.name
            );
        };
        let [planet, side] = followed.1;
        progress.warn(run.warnings());
        progress.warn([format!(
            "scene {}: no pair of planet 1's left mesh came into touch and parted again before its end, so that the pattern is that \
             of the most loaded pair, planet tooth {planet} with side gear tooth {side}; for a whole engagement, let the wheels turn \
             at different speeds, or longer",
            scene.name
        )]);
        Ok(Self { pair, contacts, followed, is_whole: false, ends })
    }

    /// Sections of the followed pair.
    pub fn engagement(&self) -> impl Iterator<Item = &LoadedSection> {
        self.contacts.iter().filter(|c| c.name == self.followed)
    }

    /// Sections of the followed pair at the instant closest to the pitch point.
    pub fn at_pitch_point(&self) -> Vec<LoadedSection> {
        let nearest = self.engagement().min_by(|a, b| a.s.abs().total_cmp(&b.s.abs()));
        nearest.map_or(Vec::new(), |n| self.engagement().filter(|c| c.time == n.time).copied().collect())
    }

    /// Sections of the followed pair for which the findings are: at the pitch point, or, if its engagement is not whole, at
    /// the instant of its largest force.
    pub fn rated(&self) -> Vec<LoadedSection> {
        if self.is_whole {
            return self.at_pitch_point();
        }
        let all: Vec<LoadedSection> = self.engagement().copied().collect();
        let instants = all.chunk_by(|a, b| a.time == b.time);
        let force = |instant: &[LoadedSection]| instant.iter().map(LoadedSection::force).sum::<f64>();
        instants.max_by(|a, b| force(a).total_cmp(&force(b))).unwrap_or_default().to_vec()
    }

    /// Creates a CSV file for loaded sections of planet 1's left mesh in SI, without rows. `followed` marks the pair whose
    /// engagement is whole, `corner` a loaded tip corner; heights are along the profile from the pitch circle at the cone
    /// distance.
    pub fn file() -> Result<CsvFile> {
        let columns = "case,time,flank,planet_tooth,side_tooth,followed,corner,s,cone,width,planet_height,side_height,\
                       line_load,radius,pressure,half_width";
        CsvFile::new(columns)
    }

    /// Adds all sections to the file `out`, with `case` in the first column.
    pub fn rows(&self, case: &str, out: &mut CsvFile) -> Result<()> {
        for c in &self.contacts {
            let [planet, side] = [0, 1].map(|i| c.cone * (c.polar[i] - self.pair.gears[i].pitch));
            let flank = if c.name.0 { "drive" } else { "coast" };
            let marks = [u8::from(c.name == self.followed), u8::from(c.is_corner)].map(|mark| mark.to_string());
            let numbers = [c.s, c.cone, c.width, planet, side, c.line_load, c.radius, c.pressure, c.half_width];
            let mut cells = vec![case.to_owned(), format!("{:.9e}", c.time), flank.to_owned()];
            cells.extend(c.name.1.map(|tooth| tooth.to_string()));
            cells.extend(marks);
            cells.extend(numbers.map(|number| format!("{number:.6e}")));
            out.push(cells)?;
        }
        Ok(())
    }
}

/// True if the load of an aligned pair grows with the cone distance.
fn grows(p: &Parameters) -> bool {
    p.contact.law.is_of_teeth()
}

/// Step of `scene` [s], or a shorter one in which the teeth move by no more than a pitch over `INSTANTS`.
fn step(scene: &Scene, progress: &mut Progress) -> Result<f64> {
    let mut run = SceneRun::start(scene, scene.step)?;
    let Some(angle) = named(ANGLE) else { return Ok(scene.step) };
    let per_pitch = run.simulation.pair().gears[0].tooth_pitch().recip();
    let pitches = |run: &mut SceneRun, angle: &Variable| run.read(angle) * per_pitch;
    let (start, mut fastest) = (pitches(&mut run, angle), 0.0_f64);
    let mut last = start;
    while !run.is_over() && (last - start).abs() < PITCHES {
        run.advance()?;
        progress.check_stopped()?;
        let now = pitches(&mut run, angle);
        fastest = fastest.max((now - last).abs());
        last = now;
    }
    Ok(scene.step / (INSTANTS * fastest).max(1.0))
}

/// True if two instants have the same pairs at nearly equal positions under nearly equal forces.
fn is_same(last: &[LoadedSection], now: &[LoadedSection], base_pitch: f64) -> bool {
    let close = |a: &LoadedSection, b: &LoadedSection| {
        a.name == b.name
            && (a.s - b.s).abs() < SAME * base_pitch
            && (a.line_load - b.line_load).abs() <= SAME * a.line_load.max(b.line_load)
    };
    last.len() == now.len() && last.iter().zip(now).all(|(a, b)| close(a, b))
}

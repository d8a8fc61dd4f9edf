//! Results of a contact pattern in numbers.

use anyhow::{Context, Result};
use bevel_differential::model::GearContact;

use crate::scene::Scene;
use crate::text::csv_file::CsvFile;
use crate::text::table::Table;

use super::cases::PatternCase;
use super::sample::Engagement;
use super::sections::LoadedSection;

/// Results of one case. Unless noted otherwise, they are for the instant at which the pair is at the pitch point, or has
/// its largest force if its engagement is not whole.
#[derive(Clone, Debug)]
pub struct PatternFindings {
    /// Name and title of the case.
    pub case: [String; 2],
    /// The instant [s].
    pub time: f64,
    /// True if the pair came into touch and parted again.
    pub is_whole: bool,
    /// Distance of the load's centroid from the middle of the face, toward the heel [m].
    pub centroid: f64,
    /// Line load of the sections nearest to toe and heel [N/m].
    pub ends: [f64; 2],
    /// Fraction of the face under load.
    pub bearing: f64,
    /// Maximum pressure [Pa].
    pub pitch_pressure: f64,
    /// True if the drive flank is loaded.
    pub is_drive: bool,
    /// Force of the pair [N].
    pub force: f64,
    /// Maximum pressure at or above the pitch line over the engagement [Pa], and its cone distance [m]. Further down,
    /// the flank ends at its base circle, where its radius of curvature is zero.
    pub peak: [f64; 2],
    /// Maximum line load over the engagement, including corners [N/m].
    pub most: f64,
    /// Lowest and highest loaded height on the planet, at the middle of the face [m].
    pub heights: [f64; 2],
    /// Kind of teeth: `solid`, or the contact law.
    pub teeth: &'static str,
}

impl PatternFindings {
    /// Results of `case`, whose engagement is `record`.
    pub fn new(case: &PatternCase, record: &Engagement) -> Result<Self> {
        let pitch = record.rated();
        let (first, last) = (pitch.first(), pitch.last());
        let (first, last) = first.zip(last).context("the pair that was followed has no load")?;
        let gear = &record.pair.gears[0];
        let height = |c: &LoadedSection, cone: f64| cone * (c.polar[0] - gear.pitch);
        let greatest = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, f64::max);
        let above = record.engagement().filter(|c| !c.is_corner && c.polar[0] >= gear.pitch);
        let peak = above.max_by(|a, b| a.pressure.total_cmp(&b.pressure));
        let face = record.pair.outer_cone - record.pair.inner_cone;
        // without contact at one end of the face, the first or last section is not at that end
        let reaches = |c: &LoadedSection, end: f64| (c.cone - end).abs() <= c.width;
        let end = |c: &LoadedSection, end: f64| if reaches(c, end) { c.line_load } else { 0.0 };
        let mean = record.pair.mean_cone;
        Ok(Self {
            case: [case.name.clone(), case.title.clone()],
            time: first.time,
            is_whole: record.is_whole,
            centroid: centroid(&pitch) - mean,
            ends: [end(first, record.pair.inner_cone), end(last, record.pair.outer_cone)],
            bearing: pitch.iter().map(|c| c.width).sum::<f64>() / face,
            pitch_pressure: greatest(&mut pitch.iter().map(|c| c.pressure)),
            is_drive: record.followed.0,
            force: pitch.iter().map(LoadedSection::force).sum(),
            peak: peak.map_or([0.0; 2], |c| [c.pressure, c.cone]),
            most: greatest(&mut record.engagement().map(|c| c.line_load)),
            heights: [
                record.engagement().map(|c| height(c, mean)).fold(f64::INFINITY, f64::min),
                record.engagement().map(|c| height(c, mean)).fold(f64::NEG_INFINITY, f64::max),
            ],
            teeth: teeth(&case.scene),
        })
    }

    fn cells(&self) -> [String; CELLS] {
        [
            self.case[1].clone(),
            if self.is_drive { "drive" } else { "coast" }.into(),
            format!("{:.1}", 1e-3 * self.force),
            format!("{:+.2}", (1e5 * self.centroid).round() / 100.0 + 0.0),
            format!("{:.0}/{:.0}", 1e-3 * self.ends[0], 1e-3 * self.ends[1]),
            format!("{:.0}", 1e-6 * self.pitch_pressure),
            format!("{:.0} at {:.1}", 1e-6 * self.peak[0], 1e3 * self.peak[1]),
            format!("{:.0}", 100.0 * self.bearing),
            format!("{:+.2} to {:+.2}", 1e3 * self.heights[0], 1e3 * self.heights[1]),
        ]
    }
}

/// Kind of teeth of `scene`.
fn teeth(scene: &Scene) -> &'static str {
    match (scene.parameters.scene.gear_contact, scene.parameters.contact.law) {
        (GearContact::Solid, _) => "solid",
        (_, law) => law.literal(),
    }
}

/// Centre of the load along the face [m].
pub fn centroid(line: &[LoadedSection]) -> f64 {
    let force: f64 = line.iter().map(LoadedSection::force).sum();
    line.iter().map(|c| c.force() * c.cone).sum::<f64>() / force
}

/// Number of columns of the table.
const CELLS: usize = 9;
/// Number of columns of the table in the document.
const IN_DOCUMENT: usize = 7;
const HEAD: [&str; CELLS] = [
    "case",
    "flank",
    "force, kN",
    "centroid, mm to heel",
    "line load toe/heel, N/mm",
    "pressure, MPa",
    "peak, MPa at R, mm",
    "face in contact, %",
    "loaded heights, mm",
];

/// Table of all cases.
pub fn table(found: &[PatternFindings]) -> Table {
    columns(found, CELLS)
}

/// First `count` columns of the table.
fn columns(found: &[PatternFindings], count: usize) -> Table {
    let mut table = Table::new(HEAD.into_iter().take(count)).all_left();
    found.iter().for_each(|f| table.push(f.cells().into_iter().take(count)));
    table
}

/// Table for the document.
pub fn markdown(found: &[PatternFindings]) -> String {
    format!(
        "{}\nForce, centroid, line loads and pressure are for the instant at which the pair is nearest to its pitch \
         point{}. The contact may then be slightly below the pitch line. The centroid of the load counts from the middle \
         of the face toward the heel. Peak is the largest pressure of the whole engagement at or above the pitch line, \
         so it can be smaller than the pressure.\n",
        columns(found, IN_DOCUMENT).markdown(),
        if found.iter().all(|f| f.is_whole) {
            ""
        } else {
            "; for a pair that did not touch and part, of its largest force"
        }
    )
}

/// Columns of the file, in SI.
const COLUMNS: &str = "case,title,flank,time,whole,force,centroid,toe_load,heel_load,bearing,pitch_pressure,peak,peak_cone,most,\
                       lowest,highest,teeth";

/// CSV file of the results.
pub fn csv(found: &[PatternFindings]) -> Result<String> {
    let mut file = CsvFile::new(COLUMNS)?;
    for f in found {
        let [name, title] = &f.case;
        let flank = if f.is_drive { "drive" } else { "coast" };
        let numbers = [
            f.force,
            f.centroid,
            f.ends[0],
            f.ends[1],
            f.bearing,
            f.pitch_pressure,
            f.peak[0],
            f.peak[1],
            f.most,
            f.heights[0],
            f.heights[1],
        ];
        let whole = u8::from(f.is_whole).to_string();
        let texts = [name.clone(), title.clone(), flank.to_owned(), format!("{:.9e}", f.time), whole];
        let numbers = numbers.map(|x| format!("{x:.6e}"));
        file.push(texts.into_iter().chain(numbers).chain([f.teeth.to_owned()]))?;
    }
    file.text()
}

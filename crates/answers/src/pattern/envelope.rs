//! Largest pressure on each spot of the planet's flank during one engagement.
//!
//! Across the contact strip of a section, the pressure follows Hertz's ellipse p √(1 − (d/b)²). Load and position are
//! interpolated linearly between sections.

use anyhow::Result;
use bevel_differential::geometry::Pair;

use crate::text::csv_file::CsvFile;

use super::sample::Engagement;
use super::sections::LoadedSection;

/// Number of spots along the face and along the profile.
const SPOTS: [usize; 2] = [61, 161];

/// The pattern of a planet's flank.
#[derive(Clone, Debug)]
pub struct Envelope {
    /// Cone distances [m].
    pub cones: Vec<f64>,
    /// Polar angles, root to tip [rad].
    pub polars: Vec<f64>,
    /// Pressure by cone distance, then polar angle [Pa].
    pub pressure: Vec<Vec<f64>>,
    /// Pitch angle of the planet [rad].
    pitch: f64,
}

impl Envelope {
    /// Pattern of the engagement of `record`.
    pub fn new(record: &Engagement) -> Self {
        let (pair, gear) = (&record.pair, &record.pair.gears[0]);
        let spots = |from: f64, to: f64, n: usize| -> Vec<f64> {
            (0..n).map(|i| from + (to - from) * i as f64 / (n - 1) as f64).collect()
        };
        let cones = spots(pair.inner_cone, pair.outer_cone, SPOTS[0]);
        let polars = spots(gear.root, gear.tip, SPOTS[1]);
        let mut pressure = vec![vec![0.0; SPOTS[1]]; SPOTS[0]];
        let contacts: Vec<&LoadedSection> = record.engagement().collect();
        let outermost = |better: fn(f64, f64) -> f64, from| record.contacts.iter().map(|c| c.cone).fold(from, better);
        let face = record.ends.unwrap_or([outermost(f64::min, f64::INFINITY), outermost(f64::max, 0.0)]);
        for line in contacts.chunk_by(|a, b| a.time == b.time) {
            for (&cone, column) in cones.iter().zip(&mut pressure) {
                let Some([polar, peak, half]) = between(line, cone, face) else { continue };
                for (&at, seen) in polars.iter().zip(column) {
                    let d = (at - polar) * cone / half;
                    if d.abs() < 1.0 {
                        *seen = f64::max(*seen, peak * (1.0 - d * d).sqrt());
                    }
                }
            }
        }
        Self { cones, polars, pressure, pitch: gear.pitch }
    }

    /// Creates the file of patterns in SI, without rows. `height` is along the profile from the pitch circle at the cone
    /// distance.
    pub fn file() -> Result<CsvFile> {
        CsvFile::new("case,cone,height,pressure")
    }

    /// Adds the spots to the file.
    pub fn rows(&self, case: &str, out: &mut CsvFile) -> Result<()> {
        for (cone, column) in self.cones.iter().zip(&self.pressure) {
            for (polar, pressure) in self.polars.iter().zip(column) {
                let numbers = [*cone, cone * (polar - self.pitch), *pressure].map(|number| format!("{number:.6e}"));
                out.push([case.to_owned()].into_iter().chain(numbers))?;
            }
        }
        Ok(())
    }
}

/// Polar angle on the planet, pressure and half-width of a contact line at `cone`. Sections of the line are within
/// `face`. Returns `None` if the line does not reach `cone`.
fn between(line: &[&LoadedSection], cone: f64, face: [f64; 2]) -> Option<[f64; 3]> {
    let (first, last) = (line.first()?, line.last()?);
    // within the face, a line ends where the load of the next section would be zero
    let (end, beyond, is_edge) = if cone < first.cone {
        (first, first.cone - cone, first.cone <= face[0])
    } else {
        (last, cone - last.cone, last.cone >= face[1])
    };
    if beyond > 0.0 && !is_edge {
        let left = (1.0 - beyond / end.width).max(0.0).sqrt();
        return (left > 0.0).then_some([end.polar[0], end.pressure * left, end.half_width * left]);
    }
    let after = line.iter().position(|c| c.cone >= cone).unwrap_or(line.len()).clamp(1, line.len().max(2) - 1);
    let (a, b) = (line[after - 1], line.get(after).unwrap_or(&line[after - 1]));
    let share = if b.cone > a.cone { (cone - a.cone) / (b.cone - a.cone) } else { 0.0 };
    let along = |of: fn(&LoadedSection) -> f64| of(a) + share * (of(b) - of(a));
    let values = [along(|c| c.polar[0]), along(|c| c.pressure), along(|c| c.half_width)];
    (values[1] > 0.0 && values[2] > 0.0).then_some(values)
}

/// Creates the file of outlines in SI, without rows. The mark `start` is where contact of aligned rigid teeth begins.
pub fn outline_file() -> Result<CsvFile> {
    CsvFile::new("case,mark,toe_cone,toe_height,heel_cone,heel_height")
}

/// Adds the flank's outline to the file: heights of its marks at toe and heel.
pub fn outline(pair: &Pair, case: &str, out: &mut CsvFile) -> Result<()> {
    let gear = &pair.gears[0];
    let start = gear.polar_at(pair.pitch_arc[0] + pair.path.low);
    for (mark, polar) in
        [("root", gear.root), ("base", gear.base), ("start", start), ("pitch", gear.pitch), ("tip", gear.tip)]
    {
        let at = |cone: f64| [cone, cone * (polar - gear.pitch)].map(|length| format!("{length:.6e}"));
        let texts = [case, mark].map(str::to_owned).into_iter();
        out.push(texts.chain(at(pair.inner_cone)).chain(at(pair.outer_cone)))?;
    }
    Ok(())
}

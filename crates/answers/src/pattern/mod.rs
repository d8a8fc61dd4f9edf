//! Contact pattern: the largest pressure on each spot of a flank while a pair of teeth goes through mesh.
//!
//! An assembler blues the teeth, turns the gears under load and looks at the areas without ink. Here, the tooth pairs
//! of a scene (`scene.gear_contact = tooth` or `solid`) are divided over the face into sections ([`sections`]). Every
//! loaded section of planet 1's left mesh is followed over one whole engagement ([`sample`]), and its position on the
//! flank and Hertz pressure are computed. The largest pressure on each spot is the pattern ([`envelope`]). [`cases`]
//! contains the scenes, [`findings`] the results in numbers.

pub mod cases;
pub mod envelope;
pub mod findings;
pub mod sample;
pub mod sections;

use anyhow::Result;

use crate::progress::Progress;
use crate::text::table::Table;
use cases::PatternCase;
use envelope::Envelope;
use findings::PatternFindings;
use sample::Engagement;

/// Contact patterns of several cases.
pub struct Patterns {
    /// Names and texts of CSV files: pressures, contacts, findings, and outlines of the flanks.
    pub files: [(&'static str, String); 4],
    /// Findings of each case.
    pub findings: Vec<PatternFindings>,
}

impl Patterns {
    /// Simulates `cases`, in steps that are longer by the factor `coarser`.
    pub fn of(cases: &[PatternCase], coarser: f64, progress: &mut Progress) -> Result<Self> {
        let (mut envelopes, mut contacts, mut findings) = (Envelope::file()?, Engagement::file()?, Vec::new());
        let mut outline = envelope::outline_file()?;
        for (i, case) in cases.iter().enumerate() {
            progress.begin_task(i as f64 / cases.len() as f64, &case.title);
            let record = Engagement::coarser(&case.scene, coarser, progress)?;
            envelope::outline(&record.pair, &case.name, &mut outline)?;
            Envelope::new(&record).rows(&case.name, &mut envelopes)?;
            record.rows(&case.name, &mut contacts)?;
            findings.push(PatternFindings::new(case, &record)?);
        }
        let files = [
            ("pattern.csv", envelopes.text()?),
            ("contacts.csv", contacts.text()?),
            ("summary.csv", findings::csv(&findings)?),
            ("outline.csv", outline.text()?),
        ];
        Ok(Self { files, findings })
    }

    /// Findings as a table.
    pub fn table(&self) -> Table {
        findings::table(&self.findings)
    }
}

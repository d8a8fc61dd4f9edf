//! Wanted quantities: outputs of a scene, each with a statistic and the size of 100 %.

use bevel_differential::variables::Variable;

use super::record::Record;
use super::statistic::{Statistic, USUAL};
use crate::scene::Scene;
use crate::scene::set::output;

/// Units of quantities that balance or add up within their kind.
const SHARED: [&str; 6] = ["rad", "rad/s", "rad/s2", "N.m", "N", "m"];
/// Swings smaller than this fraction of the values are rounding errors.
const ROUNDING: f64 = 1e-10;

/// A wanted quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Want {
    /// Index of its output in the scene.
    pub output: usize,
    /// Statistic of the output.
    pub statistic: Statistic,
    /// True if errors are relative to the largest output of the same kind instead of the output itself.
    pub among_its_kind: bool,
}

/// Returns the scene with only the wanted outputs, and the wanted quantities. Each text is `OUTPUT:STATISTIC`; no texts
/// mean all outputs of the scene.
pub fn parse(scene: &Scene, texts: &[String]) -> Result<(Scene, Vec<Want>), String> {
    let mut scene = Scene { quantities: Vec::new(), ..scene.clone() };
    if texts.is_empty() {
        if scene.outputs.is_empty() {
            return Err(format!("scene {} has no outputs: name one, such as --want left.speed:mean", scene.name));
        }
        let usual = |output| USUAL.map(|statistic| Want { output, statistic, among_its_kind: true });
        let wants = (0..scene.outputs.len()).flat_map(usual).collect();
        return Ok((scene, wants));
    }
    let (mut outputs, mut wants): (Vec<&'static Variable>, Vec<Want>) = (Vec::new(), Vec::new());
    for text in texts {
        let statistic = text.split_once(':').map(|(_, word)| Statistic::parse(word)).transpose();
        let statistic = statistic.map_err(|why| format!("--want {text}: {why}"))?;
        let row = output(name(text)).map_err(|why| format!("--want {text}: {why}"))?;
        let known = outputs.iter().position(|other| other.name == row.name);
        let output = known.unwrap_or(outputs.len());
        if known.is_none() {
            outputs.push(row);
        }
        let asked = statistic.map_or(USUAL.to_vec(), |statistic| vec![statistic]);
        let among_its_kind = statistic.is_none();
        wants.extend(asked.into_iter().map(|statistic| Want { output, statistic, among_its_kind }));
    }
    wants.dedup();
    scene.outputs = outputs;
    Ok((scene, wants))
}

/// Name of the output in `OUTPUT:STATISTIC`.
fn name(text: &str) -> &str {
    text.split_once(':').map_or(text, |(name, _)| name).trim()
}

impl Want {
    /// Returns output and statistic in the notation of the command line.
    pub fn text(&self, scene: &Scene) -> String {
        format!("{}:{}", scene.outputs[self.output].name, self.statistic)
    }

    /// Size of 100 % in the reference: the rms value for means and rms values, the largest magnitude for values and
    /// extremes, and the statistic itself for swings, orders, times and ratios. A ratio such as a safety factor is very
    /// large if nothing is loaded, which says nothing about its other values. A ratio of 0 is treated like other outputs.
    pub fn scale(&self, scene: &Scene, reference: &Record) -> Result<f64, String> {
        let size = |output: usize| {
            let of = |statistic: Statistic| statistic.of(reference, output);
            let is_ratio = scene.outputs[output].unit.is_some_and(|unit| unit.name == "1");
            let itself = if is_ratio { of(self.statistic)?.abs() } else { 0.0 };
            Ok::<_, String>(match self.statistic {
                _ if itself > 0.0 => itself,
                Statistic::Mean | Statistic::Rms => of(Statistic::Rms)?,
                Statistic::Min | Statistic::Max | Statistic::Final => {
                    of(Statistic::Min)?.abs().max(of(Statistic::Max)?.abs())
                }
                own => of(own)?.abs(),
            })
        };
        let own = size(self.output)?;
        if matches!(self.statistic, Statistic::PeakToPeak | Statistic::Order { .. }) {
            let magnitude = Statistic::Rms.of(reference, self.output)?;
            if own <= ROUNDING * magnitude {
                return Err(format!("{} is 0 in this scene: there is nothing to be accurate about", self.text(scene)));
            }
        }
        if !self.among_its_kind {
            return Ok(own);
        }
        let kin = (0..scene.outputs.len()).filter_map(|j| Some((j, share(self.output, j, &scene.outputs)?)));
        kin.map(|(j, share)| Ok(share * size(j)?))
            .try_fold(own, |scale, other: Result<f64, String>| Ok(scale.max(other?)))
    }

    /// Error of `value` relative to `wanted` in the reference, as a fraction of `scale`.
    pub fn error(value: f64, wanted: f64, scale: f64) -> f64 {
        let by = (value - wanted).abs();
        match () {
            () if by == 0.0 => 0.0,
            () if !by.is_finite() => f64::INFINITY,
            // any change from zero is an error of 100 %
            () if scale == 0.0 => 1.0,
            () => by / scale,
        }
    }
}

/// Factor by which the size of output `j` counts for the scale of output `i`. Speeds, torques, forces and displacements
/// of one kind balance each other. A planet that hardly spins is therefore not wrong by 100 % if its error is 1 % of
/// the carrier's speed.
fn share(i: usize, j: usize, outputs: &[&Variable]) -> Option<f64> {
    let unit = |k: usize| outputs[k].unit.map_or("", |unit| unit.name);
    let word = |k: usize| outputs[k].name.rsplit(['.', '_']).next();
    match () {
        () if i == j || SHARED.contains(&unit(i)) && unit(i) == unit(j) && word(i) == word(j) => Some(1.0),
        // tooth frequencies are proportional to speeds: at least one tooth per turn
        () if unit(i) == "Hz" && unit(j) == "rad/s" => Some(1.0 / std::f64::consts::TAU),
        () => None,
    }
}

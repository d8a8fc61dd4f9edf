//! What is wanted: outputs of a scene, each by a statistic, and how large 100 % of it is.

use bevel_differential::variables::Variable;

use super::record::Record;
use super::statistic::{Statistic, USUAL};
use crate::scene::Scene;
use crate::scene::set::output;

/// Units of what balances or adds up within its kind.
const SHARED: [&str; 6] = ["rad", "rad/s", "rad/s2", "N.m", "N", "m"];
/// A swing below this part of the values themselves is rounding.
const ROUNDING: f64 = 1e-10;

/// A quantity that is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Want {
    /// Number of its output in the scene.
    pub output: usize,
    /// The figure.
    pub statistic: Statistic,
    /// Whether it is measured by the largest of its kind among the outputs, and not by itself.
    pub among_its_kind: bool,
}

/// The scene with the wanted outputs alone, and what is wanted of them: `OUTPUT:STATISTIC` each, or nothing for all outputs
/// of the scene.
pub fn parse(scene: &Scene, texts: &[String]) -> Result<(Scene, Vec<Want>), String> {
    let mut scene = scene.clone();
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

/// The name of the output in `OUTPUT:STATISTIC`.
pub fn name(text: &str) -> &str {
    text.split_once(':').map_or(text, |(name, _)| name).trim()
}

impl Want {
    /// Output and statistic, as the command line takes them.
    pub fn text(&self, scene: &Scene) -> String {
        format!("{}:{}", scene.outputs[self.output].name, self.statistic)
    }

    /// What 100 % of it is in the reference: for means and effective values the effective value, for values and extremes the
    /// largest magnitude, for swings, orders and times the figure itself.
    pub fn scale(&self, scene: &Scene, reference: &Record) -> Result<f64, String> {
        let size = |output: usize| {
            let of = |statistic: Statistic| statistic.of(reference, output);
            Ok::<_, String>(match self.statistic {
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

    /// Error of `value` where the reference has `wanted`, as a part of `scale`.
    pub fn error(value: f64, wanted: f64, scale: f64) -> f64 {
        let by = (value - wanted).abs();
        match () {
            () if by == 0.0 => 0.0,
            () if !by.is_finite() => f64::INFINITY,
            // what is no more than nothing differs wholly
            () if scale == 0.0 => 1.0,
            () => by / scale,
        }
    }
}

/// Part of the size of output `j` that counts for the scale of output `i`: speeds, torques, forces and ways of one kind
/// balance each other, so that a planet that hardly spins is not off by 100 % for a hundredth of the carrier's speed.
fn share(i: usize, j: usize, outputs: &[&Variable]) -> Option<f64> {
    let unit = |k: usize| outputs[k].unit.map_or("", |unit| unit.name);
    let word = |k: usize| outputs[k].name.rsplit(['.', '_']).next();
    match () {
        () if i == j || SHARED.contains(&unit(i)) && unit(i) == unit(j) && word(i) == word(j) => Some(1.0),
        // frequencies of teeth come from speeds: a tooth or more for each turn
        () if unit(i) == "Hz" && unit(j) == "rad/s" => Some(1.0 / std::f64::consts::TAU),
        () => None,
    }
}

//! How far apart two runs of a scene are, output by output.
//!
//! Engineers judge a record by its mean, its effective value and its extremes, and so does this: where teeth rattle, two
//! runs part point by point however little they differ, and their statistics do not. Means and effective values (rms)
//! are compared on the scale of effective values, extremes on the scale of magnitudes. The scale is that of the
//! reference. Speeds, torques, forces and ways of one kind balance each other, so that the largest of their kind among
//! the scene's outputs is the scale for all of them: a planet that hardly spins is not off by 100 % for a hundredth of
//! the carrier's speed. Heat, power, stress and ratios are measured by themselves.
//!
//! The instant of the start does not count: it is what `scene.start` says, and not what the scene does. Nor does what
//! comes before a time that is asked for, so that a start that settles may be left out.

use std::fmt;

use bevel_differential::variables::Variable;

use super::record::Record;

/// Units of what balances or adds up within its kind.
const SHARED: [&str; 6] = ["rad", "rad/s", "rad/s2", "N.m", "N", "m"];

/// A figure that a series is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Statistic {
    Mean,
    Rms,
    Min,
    Max,
}

impl Statistic {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Mean, Self::Rms, Self::Min, Self::Max];
}

impl fmt::Display for Statistic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mean => "mean",
            Self::Rms => "rms",
            Self::Min => "min",
            Self::Max => "max",
        })
    }
}

/// Statistics of a series over time, in the order of [`Statistic::ALL`].
pub fn statistics(times: &[f64], values: &[f64]) -> [f64; 4] {
    let span = times.last().copied().unwrap_or(0.0) - times.first().copied().unwrap_or(0.0);
    // straight from point to point
    let over_time = |of: fn(f64) -> f64| {
        if span <= 0.0 {
            return values.first().copied().map_or(0.0, of);
        }
        let pieces = times.windows(2).zip(values.windows(2));
        pieces.map(|(t, v)| 0.5 * (t[1] - t[0]) * (of(v[0]) + of(v[1]))).sum::<f64>() / span
    };
    let extreme = |pick: fn(f64, f64) -> f64| values.iter().copied().reduce(pick).unwrap_or(0.0);
    [over_time(|x| x), over_time(|x| x * x).max(0.0).sqrt(), extreme(f64::min), extreme(f64::max)]
}

/// What 100 % of an output is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// For means and effective values.
    pub rms: f64,
    /// For extremes.
    pub magnitude: f64,
}

/// Scales of `outputs`, from the reference.
pub fn scales(outputs: &[&Variable], reference: &Record) -> Vec<Scale> {
    let own: Vec<Scale> = reference
        .values
        .iter()
        .map(|values| {
            let [_, rms, min, max] = statistics(&reference.times, values);
            Scale { rms, magnitude: min.abs().max(max.abs()) }
        })
        .collect();
    let scale = |i: usize| {
        let kin = (0..own.len()).filter_map(|j| Some((own[j], share(i, j, outputs)?)));
        kin.fold(Scale { rms: 0.0, magnitude: 0.0 }, |scale, (other, share)| Scale {
            rms: scale.rms.max(share * other.rms),
            magnitude: scale.magnitude.max(share * other.magnitude),
        })
    };
    (0..own.len()).map(scale).collect()
}

/// Part of the size of output `j` that counts for the scale of output `i`.
fn share(i: usize, j: usize, outputs: &[&Variable]) -> Option<f64> {
    let unit = |k: usize| outputs[k].unit.map_or("", |unit| unit.name);
    let frequency_of_speed = unit(i) == "Hz" && unit(j) == "rad/s";
    match () {
        () if i == j || SHARED.contains(&unit(i)) && are_alike(outputs[i], outputs[j]) => Some(1.0),
        // frequencies of teeth come from speeds: a tooth or more for each turn
        () if frequency_of_speed => Some(1.0 / std::f64::consts::TAU),
        () => None,
    }
}

/// Of one kind: the same unit, and names that end with the same word, as left.speed and planet[1].spin_speed do.
fn are_alike(a: &Variable, b: &Variable) -> bool {
    let unit = |row: &Variable| row.unit.map(|unit| unit.name);
    let word = |row: &Variable| row.name.rsplit(['.', '_']).next();
    unit(a) == unit(b) && word(a) == word(b)
}

/// Change of one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputChange {
    /// Largest change of a statistic, on its scale.
    pub by: f64,
    /// Which one.
    pub of: Statistic,
    /// When it comes, for the extreme that is further out [s].
    pub at: Option<f64>,
    /// Effective value of the difference point by point, on the scale of effective values.
    pub pointwise: f64,
}

/// Changes of all outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// One for each output of the scene.
    pub outputs: Vec<OutputChange>,
}

impl Change {
    /// Change from `reference` to `other`.
    pub fn between(reference: &Record, other: &Record, scales: &[Scale]) -> Self {
        let series = reference.values.iter().zip(&other.values).zip(scales);
        Self { outputs: series.map(|((a, b), scale)| output(&reference.times, a, &other.times, b, scale)).collect() }
    }

    /// The output that changes most, by its number, with its change; none where there are no outputs.
    pub fn worst(&self) -> Option<(usize, OutputChange)> {
        self.outputs.iter().copied().enumerate().max_by(|a, b| a.1.by.total_cmp(&b.1.by))
    }

    /// The largest change.
    pub fn largest(&self) -> f64 {
        self.worst().map_or(0.0, |(_, change)| change.by)
    }

    /// The largest change point by point.
    pub fn pointwise(&self) -> f64 {
        self.outputs.iter().map(|output| output.pointwise).fold(0.0, f64::max)
    }

    /// Whether each output changes by its limit at most.
    pub fn is_within(&self, limits: &[f64]) -> bool {
        self.outputs.iter().zip(limits).all(|(output, limit)| output.by <= *limit)
    }

    /// Whether there is none at all, in any bit.
    pub fn is_none(&self) -> bool {
        self.outputs.iter().all(|output| output.by == 0.0 && output.pointwise == 0.0)
    }
}

fn output(times: &[f64], a: &[f64], other_times: &[f64], b: &[f64], scale: &Scale) -> OutputChange {
    let (was, is) = (statistics(times, a), statistics(other_times, b));
    let relative = |change: f64, scale: f64, instead: f64| {
        // what has no scale because it was zero is all new
        let scale = if scale > 0.0 { scale } else { instead };
        match change.abs() / scale {
            _ if change == 0.0 => 0.0,
            ratio if ratio.is_nan() => f64::INFINITY,
            ratio => ratio,
        }
    };
    let magnitude = is[2].abs().max(is[3].abs());
    let changes = Statistic::ALL.into_iter().enumerate().map(|(i, of)| {
        let by = match of {
            Statistic::Mean | Statistic::Rms => relative(is[i] - was[i], scale.rms, is[1]),
            Statistic::Min | Statistic::Max => relative(is[i] - was[i], scale.magnitude, magnitude),
        };
        (by, of)
    });
    let (by, of) = changes.max_by(|x, y| x.0.total_cmp(&y.0)).unwrap_or((0.0, Statistic::Mean));
    let pointwise = if a.len() == b.len() {
        let difference: Vec<f64> = a.iter().zip(b).map(|(x, y)| x - y).collect();
        relative(statistics(times, &difference)[1], scale.rms, is[1])
    } else {
        f64::INFINITY
    };
    OutputChange { by, of, at: when(of, [(times, a, &was), (other_times, b, &is)]), pointwise }
}

/// When an extreme comes in the run where it is further out.
fn when(of: Statistic, runs: [(&[f64], &[f64], &[f64; 4]); 2]) -> Option<f64> {
    let (i, outward) = match of {
        Statistic::Min => (2, -1.0),
        Statistic::Max => (3, 1.0),
        Statistic::Mean | Statistic::Rms => return None,
    };
    let (times, values, statistics) =
        runs.into_iter().max_by(|a, b| (outward * a.2[i]).total_cmp(&(outward * b.2[i])))?;
    times.iter().zip(values).find(|(_, value)| **value == statistics[i]).map(|(time, _)| *time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gears::scene::set::variable;
    use bevel_differential::model::CostClass;

    fn record(values: &[&[f64]]) -> Record {
        let times = (0..values[0].len()).map(|i| i as f64).collect();
        let values = values.iter().map(|series| series.to_vec()).collect();
        Record { times, values, evaluations: 0.0, steps: 0.0, class: CostClass::ClosedForm }
    }

    fn rows(names: &[&str]) -> Vec<&'static Variable> {
        names.iter().map(|name| variable(name).expect(name)).collect()
    }

    #[test]
    fn statistics_are_over_time() {
        let uneven = statistics(&[1.0, 2.0, 4.0], &[2.0, 4.0, -2.0]);
        assert_eq!(uneven[0], (3.0 + 2.0) / 3.0);
        assert_eq!(&uneven[2..], [-2.0, 4.0]);
        assert_eq!(statistics(&[1.0, 2.0], &[3.0, 3.0]), [3.0; 4]);
    }

    #[test]
    fn outputs_of_one_kind_share_the_scale_of_the_largest_and_ratios_have_their_own() {
        let outputs = rows(&["carrier.speed", "planet[1].spin_speed", "efficiency", "locking_value", "left.twist"]);
        let reference = record(&[&[50.0; 2], &[0.0; 2], &[1.0; 2], &[0.1; 2], &[0.0; 2]]);
        let scales = scales(&outputs, &reference);
        assert_eq!(scales.iter().map(|s| s.magnitude).collect::<Vec<_>>(), [50.0, 50.0, 1.0, 0.1, 0.0]);
        let other = record(&[&[50.0; 2], &[0.5; 2], &[1.0; 2], &[0.11; 2], &[2.0; 2]]);
        let change = Change::between(&reference, &other, &scales);
        let by: Vec<f64> = change.outputs.iter().map(|output| (output.by * 1e9).round() / 1e9).collect();
        assert_eq!(by, [0.0, 0.01, 0.0, 0.1, 1.0]);
        assert!(!change.is_none() && Change::between(&reference, &reference, &scales).is_none());
    }

    #[test]
    fn what_is_no_number_is_beyond_any_limit() {
        let outputs = rows(&["left.speed"]);
        let reference = record(&[&[1.0; 3]]);
        let change = Change::between(&reference, &record(&[&[1.0, f64::NAN, 1.0]]), &scales(&outputs, &reference));
        assert!(!change.is_within(&[0.5]));
    }

    #[test]
    fn extremes_say_when_they_come() {
        let outputs = rows(&["left.speed"]);
        let reference = record(&[&[1.0, 1.0, -1.0, 1.0]]);
        let change = |series: &[f64]| {
            let change = Change::between(&reference, &record(&[series]), &scales(&outputs, &reference)).outputs[0];
            (change.of, change.at)
        };
        assert_eq!(change(&[1.0, 1.0, -1.0, 4.0]), (Statistic::Max, Some(3.0)));
        assert_eq!(change(&[1.0, -0.9, 0.9, 1.0]).1, Some(2.0));
    }
}

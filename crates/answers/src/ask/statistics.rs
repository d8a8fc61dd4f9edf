//! Questions about statistics: their names, and their values for given series.

use anyhow::{Context, Result};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::accuracy::record::Record;
use crate::accuracy::statistic::{Rotation, Statistic};
use crate::problem::{Problem, Problems, question_error};

/// Requested statistic of a series.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FigureQuestion {
    statistic: String,
    /// Index of the series, from 0.
    series: usize,
    /// Index of the series with the angle [rad] by which an order is counted.
    phase: Option<usize>,
}

/// Returns the canonical name of a statistic, and the angle by which an order is counted.
pub fn word(statistic: &str) -> Result<Value> {
    let statistic = Statistic::parse(statistic).map_err(question_error)?;
    let angle = match statistic {
        Statistic::Order { of, .. } => Some(of.word()),
        _ => None,
    };
    Ok(json!({"word": statistic.to_string(), "angle": angle}))
}

/// Returns the requested statistics of series. `numbers` contains `points` times, then each series.
pub fn figures(points: usize, figures: &[FigureQuestion], numbers: &[f64]) -> Result<Value> {
    // only 0 is a multiple of 0, so 0 points are refused as well
    if numbers.is_empty() || !numbers.len().is_multiple_of(points) {
        let wanted = "send the times, then each series; each has `points` numbers, at least 1";
        let message = format!("points = {points}: {} numbers do not fit; {wanted}", numbers.len());
        return Err(Problems::from(Problem::of("points", points.to_string(), message)).into());
    }
    let (times, series) = numbers.split_at(points);
    let values = series.chunks(points).map(<[f64]>::to_vec).collect();
    let mut record = Record { times: times.to_vec(), values, ..Record::default() };
    let figures = figures.iter().map(|figure| {
        let statistic = Statistic::parse(&figure.statistic).map_err(question_error)?;
        let values = |i: usize| record.values.get(i).with_context(|| format!("there is no series {i}"));
        values(figure.series)?;
        if let Statistic::Order { of, .. } = statistic {
            let phase = figure.phase.with_context(|| {
                format!("{statistic}: an order needs `phase`, the index of the series with its angle")
            })?;
            let phase = values(phase)?.clone();
            record.phases[usize::from(of == Rotation::Shaft)] = phase;
        }
        statistic.of(&record, figure.series).map_err(question_error)
    });
    Ok(json!({"figures": figures.collect::<Result<Vec<_>>>()?}))
}

//! Two tables of the same scene: how far they are apart.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};

/// Outputs by communication point.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    names: Vec<String>,
    rows: BTreeMap<usize, Vec<f64>>,
}

/// The largest deviation over all outputs and communication points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Relative to the value, or to the output's natural scale where the value is smaller.
    pub largest: f64,
    /// Output and communication point where it is.
    pub place: String,
    /// How many values have other bits, and how many were compared.
    pub different: usize,
    /// See `different`.
    pub compared: usize,
}

impl Table {
    /// Reads what a host's script wrote.
    pub fn read(path: &Path) -> Result<Self> {
        let text = fs::read_to_string(path).with_context(|| format!("{} cannot be read", path.display()))?;
        let mut lines = text.lines();
        let names = lines.next().unwrap_or_default().split(',').skip(1).map(str::to_owned).collect::<Vec<_>>();
        let mut rows = BTreeMap::new();
        for line in lines {
            let (point, values) = line.split_once(',').with_context(|| format!("\"{line}\" is no row"))?;
            let values = values.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>()?;
            ensure!(values.len() == names.len(), "point {point} has {} of {} values", values.len(), names.len());
            rows.insert(point.parse()?, values);
        }
        Ok(Self { names, rows })
    }

    /// How far `other` is from this one. It must have the same outputs at the same points, but for the start if
    /// `without_start`. `scale` tells what an output's small values are measured by.
    pub fn deviation(
        &self,
        other: &Self,
        without_start: bool,
        scale: impl Fn(&str) -> Option<f64>,
    ) -> Result<Deviation> {
        ensure!(self.names == other.names, "other outputs were recorded: {}", other.names.join(", "));
        let first = usize::from(without_start);
        let expected: Vec<&usize> = self.rows.keys().filter(|&&point| point >= first).collect();
        let found: Vec<&usize> = other.rows.keys().filter(|&&point| point >= first).collect();
        ensure!(expected == found, "{} communication points were recorded in place of {}", found.len(), expected.len());
        let mut told = Deviation::default();
        for (point, values) in self.rows.range(first..) {
            for ((name, value), own) in self.names.iter().zip(&other.rows[point]).zip(values) {
                let scale = scale(name).with_context(|| format!("the scene tells no natural scale of {name}"))?;
                let deviation = (value - own).abs() / own.abs().max(scale);
                if deviation.is_nan() {
                    bail!("{name} at point {point} is {value} in place of {own}");
                }
                told.compared += 1;
                told.different += usize::from(value.to_bits() != own.to_bits());
                if deviation > told.largest {
                    told.largest = deviation;
                    told.place = format!("{name} at point {point}");
                }
            }
        }
        Ok(told)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::Table;

    fn table(rows: &[(usize, [f64; 2])]) -> Table {
        let rows: BTreeMap<_, _> = rows.iter().map(|(point, values)| (*point, values.to_vec())).collect();
        Table { names: vec!["a".into(), "b".into()], rows }
    }

    #[test]
    fn deviations_are_relative_to_the_value_or_the_natural_scale() {
        let own = table(&[(0, [1.0, 0.0]), (1, [200.0, 0.0])]);
        let told = own.deviation(&table(&[(0, [1.0, 0.0]), (1, [202.0, 0.1])]), false, |_| Some(20.0));
        let told = told.expect("tables of one shape");
        assert_eq!((told.different, told.compared), (2, 4));
        assert!((told.largest - 0.01).abs() < 1e-15 && told.place == "a at point 1");
    }

    #[test]
    fn a_missing_point_is_an_error_but_for_the_start() {
        let own = table(&[(0, [1.0, 0.0]), (1, [2.0, 0.0])]);
        let later = table(&[(1, [2.0, 0.0])]);
        assert!(own.deviation(&later, false, |_| Some(1.0)).is_err());
        assert_eq!(own.deviation(&later, true, |_| Some(1.0)).expect("the start may lack").different, 0);
        assert!(own.deviation(&table(&[(0, [1.0, 0.0])]), true, |_| Some(1.0)).is_err());
        assert!(own.deviation(&table(&[(0, [1.0, 0.0]), (1, [f64::NAN, 0.0])]), false, |_| Some(1.0)).is_err());
    }
}

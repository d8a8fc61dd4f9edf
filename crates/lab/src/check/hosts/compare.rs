//! Two records of the same scene: how far they are apart.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};

/// Outputs by communication point.
#[derive(Clone, Debug, PartialEq)]
pub struct HostRecord {
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

impl HostRecord {
    /// Reads what a host's script wrote, a row for each communication point.
    pub fn read(path: &Path) -> Result<Self> {
        let mut file = csv::Reader::from_path(path).with_context(|| format!("{} cannot be read", path.display()))?;
        let names: Vec<String> = file.headers()?.iter().skip(1).map(str::to_owned).collect();
        let mut rows = BTreeMap::new();
        for row in file.records() {
            let row = row?;
            let values = row.iter().skip(1).map(str::parse).collect::<Result<Vec<f64>, _>>()?;
            let point = row.get(0).unwrap_or_default();
            rows.insert(point.parse().with_context(|| format!("\"{point}\" is not the number of a point"))?, values);
        }
        Ok(Self { names, rows })
    }

    /// How far `other` is from this one. It must have the same outputs at the same points, but for the start if
    /// `without_start`. `scale` is what an output's small values are measured by.
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
        let mut found = Deviation::default();
        for (point, values) in self.rows.range(first..) {
            for ((name, value), own) in self.names.iter().zip(&other.rows[point]).zip(values) {
                let scale = scale(name).with_context(|| format!("the scene states no natural scale of {name}"))?;
                let deviation = (value - own).abs() / own.abs().max(scale);
                if deviation.is_nan() {
                    bail!("{name} at point {point} is {value} in place of {own}");
                }
                found.compared += 1;
                found.different += usize::from(value.to_bits() != own.to_bits());
                if deviation > found.largest {
                    found.largest = deviation;
                    found.place = format!("{name} at point {point}");
                }
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::HostRecord;

    fn table(rows: &[(usize, [f64; 2])]) -> HostRecord {
        let rows: BTreeMap<_, _> = rows.iter().map(|(point, values)| (*point, values.to_vec())).collect();
        HostRecord { names: vec!["a".into(), "b".into()], rows }
    }

    #[test]
    fn deviations_are_relative_to_the_value_or_the_natural_scale() {
        let own = table(&[(0, [1.0, 0.0]), (1, [200.0, 0.0])]);
        let found = own.deviation(&table(&[(0, [1.0, 0.0]), (1, [202.0, 0.1])]), false, |_| Some(20.0));
        let found = found.expect("tables of one shape");
        assert_eq!((found.different, found.compared), (2, 4));
        assert!((found.largest - 0.01).abs() < 1e-15 && found.place == "a at point 1");
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

//! Statistics of a series over time.

use std::f64::consts::{PI, TAU};
use std::fmt;

use super::record::Record;
use crate::scene::time_mean::TimeMean;

/// A statistic of a series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// Mean over time.
    Mean,
    /// Effective value.
    Rms,
    /// Smallest value.
    Min,
    /// Largest value.
    Max,
    /// Largest minus smallest value.
    PeakToPeak,
    /// Value at the end.
    Final,
    /// Time at which the magnitude is largest [s].
    TimeOfPeak,
    /// Amplitude of an order: `number` oscillations per period of a rotation.
    Order {
        /// Oscillations per period.
        number: u32,
        /// Rotation whose periods are counted.
        of: Rotation,
    },
}

/// Rotation by which an order is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rotation {
    /// Meshing teeth: a period is one pitch of planet 1.
    Mesh,
    /// Carrier shaft: a period is one turn.
    Shaft,
}

impl Rotation {
    /// Name in the notation of users.
    pub fn word(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::Shaft => "shaft",
        }
    }
}

/// Statistics of an output for which none is named.
pub const USUAL: [Statistic; 4] = [Statistic::Mean, Statistic::Rms, Statistic::Min, Statistic::Max];
/// Names of statistics other than orders.
const WORDS: [(&str, Statistic); 7] = [
    ("mean", Statistic::Mean),
    ("rms", Statistic::Rms),
    ("min", Statistic::Min),
    ("max", Statistic::Max),
    ("peak_to_peak", Statistic::PeakToPeak),
    ("final", Statistic::Final),
    ("time_of_peak", Statistic::TimeOfPeak),
];
/// All names, for messages.
pub const KNOWN: &str =
    "mean, rms, min, max, peak_to_peak, final, time_of_peak, mesh_order_1 (any whole number), shaft_order_1";
/// Maximum change of phase between two communication points [rad]: an amplitude needs four points per period.
const COARSEST: f64 = 0.5 * PI;

impl fmt::Display for Statistic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Order { number, of } => write!(f, "{}_order_{number}", of.word()),
            other => f.write_str(WORDS.iter().find(|(_, known)| known == other).map_or("", |(word, _)| word)),
        }
    }
}

impl Statistic {
    /// Parses a statistic: a name, or an order such as `mesh_order_1` or `order 1 of mesh`.
    pub fn parse(text: &str) -> Result<Self, String> {
        let text = text.trim().to_lowercase();
        let plain = text.replace([' ', '-'], "_");
        let plain = if plain == "p2p" || plain == "pp" { "peak_to_peak" } else { plain.as_str() };
        if let Some((_, known)) = WORDS.iter().find(|(word, _)| *word == plain) {
            return Ok(*known);
        }
        let words: Vec<&str> = plain.split('_').filter(|word| !word.is_empty()).collect();
        if words.contains(&"order") {
            let of = if words.contains(&"shaft") { Rotation::Shaft } else { Rotation::Mesh };
            let number = words.iter().find_map(|word| word.parse::<u32>().ok()).filter(|&number| number > 0);
            return match number {
                Some(number) => Ok(Self::Order { number, of }),
                None => Err(format!("order \"{text}\" needs a whole number above 0, such as mesh_order_1")),
            };
        }
        let words = WORDS.iter().map(|(word, _)| *word).chain(["mesh_order_1", "shaft_order_1"]);
        let hint = crate::text::near::hint(plain, words);
        Err(format!("there is no statistic \"{text}\"{hint} Known: {KNOWN}").replace("\" Known", "\"; known"))
    }

    /// True if the statistic is a difference between values, so that a temperature has no zero offset.
    pub fn is_difference(self) -> bool {
        matches!(self, Self::PeakToPeak | Self::Order { .. })
    }

    /// Computes the statistic of output `i` of `record`, or returns the reason why it is undefined.
    pub fn of(self, record: &Record, i: usize) -> Result<f64, String> {
        let (times, values) = (&record.times, &record.values[i]);
        let extreme = |pick: fn(f64, f64) -> f64| values.iter().copied().reduce(pick).unwrap_or(0.0);
        Ok(match self {
            Self::Mean => TimeMean::of(times, values.iter().copied()),
            Self::Rms => TimeMean::of(times, values.iter().map(|x| x * x)).max(0.0).sqrt(),
            Self::Min => extreme(f64::min),
            Self::Max => extreme(f64::max),
            Self::PeakToPeak => extreme(f64::max) - extreme(f64::min),
            Self::Final => values.last().copied().unwrap_or(0.0),
            Self::TimeOfPeak => time_of_peak(times, values),
            Self::Order { number, of } => {
                let phase = &record.phases[usize::from(of == Rotation::Shaft)];
                amplitude(phase, values, number).map_err(|why| format!("{self}: {why}"))?
            }
        })
    }
}

/// Time of the largest magnitude [s], interpolated by a parabola through it and its neighbours.
///
/// The parabola counts only within half of the shorter neighbouring interval. It is always there on even points. On
/// uneven points, a long interval would draw it away from the peak; at a jump, there is no parabola.
fn time_of_peak(times: &[f64], values: &[f64]) -> f64 {
    let Some(k) = (0..values.len()).max_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs())) else { return 0.0 };
    if k == 0 || k + 1 == values.len() {
        return times[k];
    }
    let [before, at, after] = [k - 1, k, k + 1].map(|k| values[k].abs());
    let (down, up) = (times[k] - times[k - 1], times[k + 1] - times[k]);
    let (left, right) = ((at - before) / down, (after - at) / up);
    // also refuses the infinite slope of a jump
    if !(left - right > 0.0 && left - right < f64::INFINITY) {
        return times[k];
    }
    // zero of the parabola's slope, interpolated between the midpoints of the left and the right interval
    let shift = 0.5 * (down + up) * left / (left - right) - 0.5 * down;
    if shift.abs() <= 0.5 * down.min(up) * (1.0 + 1e-9) { times[k] + shift } else { times[k] }
}

/// Amplitude of order `number` of `phase` in `values`, over the last whole turns, which keep other orders out. In less
/// than one turn, it is over the last whole periods of the order. Returns the reason if it is undefined.
fn amplitude(phase: &[f64], values: &[f64], number: u32) -> Result<f64, String> {
    let rotation = || "the rotation that it is counted by";
    let (Some(&first), Some(&last)) = (phase.first(), phase.last()) else { return Err("nothing is recorded".into()) };
    let sense = (last - first).signum();
    let k = f64::from(number);
    let turns = (last - first).abs() / TAU * (1.0 + 1e-12);
    let whole = if turns < 1.0 { (turns * k).floor() / k } else { turns.floor() };
    if whole == 0.0 {
        return Err(format!(
            "{} turns by less than one period of the order in the time that is judged; ask for another statistic, let the scene \
             run longer (--set stop_time=…), or let it turn",
            rotation()
        ));
    }
    if phase.windows(2).any(|pair| (pair[1] - pair[0]) * sense < -1e-9) {
        return Err(format!("{} turns to and fro", rotation()));
    }
    let coarsest = phase.windows(2).map(|pair| (pair[1] - pair[0]).abs() * k).fold(0.0, f64::max);
    if coarsest > COARSEST {
        return Err(format!(
            "a period of it has only {:.1} communication points: make the scene's step {:.0} times smaller",
            TAU / coarsest,
            (coarsest / COARSEST).ceil()
        ));
    }
    let begin = last - sense * TAU * whole;
    let start = phase.iter().position(|&p| (p - begin) * sense >= 0.0).unwrap_or(0);
    let mut points: Vec<[f64; 2]> = Vec::new();
    if start > 0 && phase[start] != begin {
        let share = (begin - phase[start - 1]) / (phase[start] - phase[start - 1]);
        points.push([begin, values[start - 1] + share * (values[start] - values[start - 1])]);
    }
    points.extend((start..phase.len()).map(|i| [phase[i], values[i]]));
    let over = |of: &dyn Fn([f64; 2]) -> f64| {
        points.windows(2).map(|p| 0.5 * (p[1][0] - p[0][0]) * (of(p[0]) + of(p[1]))).sum::<f64>()
    };
    let length = TAU * whole * sense;
    let mean = over(&|[_, x]| x) / length;
    let [cos, sin] =
        [f64::cos as fn(f64) -> f64, f64::sin].map(|wave| over(&|[p, x]| (x - mean) * wave(k * p)) / length);
    Ok(2.0 * cos.hypot(sin))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Series 3 + 2 cos(φ + 0.3) + 0.5 sin 3φ over φ = 40 t for one second.
    fn waves(points: usize) -> Record {
        let times: Vec<f64> = (0..=points).map(|i| i as f64 / points as f64).collect();
        let phase: Vec<f64> = times.iter().map(|t| 40.0 * t).collect();
        let values = phase.iter().map(|p| 3.0 + 2.0 * (p + 0.3).cos() + 0.5 * (3.0 * p).sin()).collect();
        Record { phases: [phase, times.clone()], times, values: vec![values], ..Record::default() }
    }

    #[test]
    fn orders_have_the_amplitudes_of_the_waves() {
        let record = waves(4000);
        let order = |number| Statistic::Order { number, of: Rotation::Mesh }.of(&record, 0).expect("an order");
        for (number, wanted) in [(1, 2.0), (2, 0.0), (3, 0.5)] {
            assert!((order(number) - wanted).abs() < 2e-4, "{number}: {}", order(number));
        }
    }

    #[test]
    fn in_less_than_a_turn_an_order_has_whole_periods_of_its_own() {
        // 0.93 turns of a shaft in either direction, a wave of order 37 with the amplitude 2
        for sense in [1.0, -1.0] {
            let times: Vec<f64> = (0..=4000).map(|i| f64::from(i) / 4000.0).collect();
            let phase: Vec<f64> = times.iter().map(|t| sense * 0.93 * TAU * t).collect();
            let values = phase.iter().map(|p| 3.0 + 2.0 * (37.0 * p + 0.3).cos()).collect();
            let record = Record { phases: [times.clone(), phase], times, values: vec![values], ..Record::default() };
            let order = |number| Statistic::Order { number, of: Rotation::Shaft }.of(&record, 0);
            let found = order(37).expect("34 whole periods");
            assert!((found - 2.0).abs() < 2e-3, "{found}");
            assert!(order(1).expect_err("less than a period").contains("one period of the order"));
        }
    }

    #[test]
    fn undefined_orders_state_the_reason() {
        let shaft = Statistic::Order { number: 1, of: Rotation::Shaft };
        assert!(shaft.of(&waves(4000), 0).expect_err("a sixth of a turn").contains("one period of the order"));
        let fine = Statistic::Order { number: 3, of: Rotation::Mesh };
        assert!(fine.of(&waves(60), 0).expect_err("too coarse").contains("communication points"));
        let mut swinging = waves(400);
        swinging.phases[0].iter_mut().for_each(|p| *p += 5.0 * (2.0 * *p).sin());
        let first = Statistic::Order { number: 1, of: Rotation::Mesh };
        assert!(first.of(&swinging, 0).expect_err("swinging").contains("to and fro"));
    }

    #[test]
    fn a_peak_between_points_is_found_by_its_parabola() {
        let times: Vec<f64> = [0.0, 0.1, 0.25, 0.3, 0.4].to_vec();
        let values = vec![times.iter().map(|t| -2.0 + (t - 0.27f64).powi(2)).collect()];
        let record = Record { times, values, ..Record::default() };
        let found = Statistic::TimeOfPeak.of(&record, 0).expect("a time");
        assert!((found - 0.27).abs() < 1e-12, "{found}");
    }

    #[test]
    fn a_peak_next_to_a_long_interval_or_a_jump_stays_at_its_point() {
        for sign in [1.0, -1.0] {
            for (times, values, wanted) in [
                ([1.4, 1.5, 1.6, 4.0], [0.0, 9.0, 10.0, 8.8], 1.6),
                ([0.0, 2.4, 2.5, 2.6], [8.8, 10.0, 9.0, 0.0], 2.4),
                ([0.0, 1.0, 1.0, 2.0], [9.0, 10.0, 0.0, 0.0], 1.0),
                ([0.0, 1.0, 1.0, 2.0], [0.0, 0.0, 10.0, 9.0], 1.0),
            ] {
                let values = vec![values.iter().map(|value| sign * value).collect()];
                let record = Record { times: times.to_vec(), values, ..Record::default() };
                assert_eq!(Statistic::TimeOfPeak.of(&record, 0), Ok(wanted), "{times:?}");
            }
        }
    }

    #[test]
    fn parsing_a_printed_statistic_returns_it() {
        let order = Statistic::Order { number: 2, of: Rotation::Shaft };
        for statistic in USUAL.into_iter().chain([Statistic::PeakToPeak, Statistic::TimeOfPeak, order]) {
            assert_eq!(Statistic::parse(&statistic.to_string()), Ok(statistic));
        }
        assert_eq!(Statistic::parse("order 2 of mesh"), Ok(Statistic::Order { number: 2, of: Rotation::Mesh }));
        assert_eq!(Statistic::parse("Peak-to-peak"), Ok(Statistic::PeakToPeak));
        assert!(Statistic::parse("meen").expect_err("a slip").contains("did you mean mean?"));
        assert!(Statistic::parse("order x").expect_err("no number").contains("mesh_order_1"));
    }
}

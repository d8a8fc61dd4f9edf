//! Names and numbers as tables and sentences show them.

use super::bench::FULL;
use super::change::Change;
use super::switches::{Standing, Switch};
use super::{Finding, Findings, Trial};
use crate::gears::scene::units;

/// Changes of this many times the scale and more are told as such.
const MANY: f64 = 10.0;

/// A fraction in percent with two significant digits.
pub fn percent(fraction: f64) -> String {
    let percent = fraction * 100.0;
    if percent == 0.0 {
        return "0 %".into();
    }
    if !percent.is_finite() {
        return "no number".into();
    }
    if fraction >= MANY {
        return format!("{fraction:.0} x");
    }
    let decimals = (1.0 - percent.abs().log10().floor()).max(0.0) as usize;
    if decimals > 5 { format!("{percent:.0e} %") } else { format!("{percent:.decimals$} %") }
}

/// The output and statistic of the largest change.
pub fn most(found: &Findings, change: &Change) -> String {
    match change.worst() {
        Some((i, worst)) if worst.by > 0.0 => {
            let at = worst.at.map_or_else(String::new, |at| format!(" at {} s", units::digits(at)));
            format!("{} {}{at}", found.scene.outputs[i].name, worst.of)
        }
        _ => String::new(),
    }
}

/// Name of a row; levels say so.
pub fn name(row: &Finding) -> String {
    match row.switch {
        Switch::Effect(_) => row.switch.name().to_owned(),
        Switch::Level(_) => format!("level {}", row.switch.name()),
    }
}

/// Where the switch stands in the scene.
pub fn scene(standing: Standing, switch: &Switch) -> &'static str {
    match (switch, standing) {
        (Switch::Level(_), _) => "",
        (_, Standing::On) => "on",
        (_, Standing::Off | Standing::NotThere) => "off",
        (_, Standing::SetOff) => "set off",
    }
}

/// Runs with and without, of the comparison in the fullest scene.
pub fn pair(row: &Finding, trial: &Trial) -> Option<[usize; 2]> {
    let run = trial.run.clone().ok()?;
    let on = match trial.reference {
        FULL => row.in_full,
        _ => row.standing == Standing::On,
    };
    // what is compared with is dearer for a level, and has the effect or lacks it
    let reference_has = on || matches!(row.switch, Switch::Level(_));
    Some(if reference_has { [trial.reference, run] } else { [run, trial.reference] })
}

/// A number with about three digits.
pub fn three(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let decimals = if value.abs() < 1.0 { 2.0 } else { (2.0 - value.abs().log10().floor()).max(0.0) };
    let text = format!("{value:.*}", decimals as usize);
    if value != 0.0 && text.parse() == Ok(0.0) { format!("{value:.1e}") } else { text }
}

//! Names and numbers for sentences.

use bevel_differential::model::{Method, Parameters};

use super::gears::Gears;
use super::switches::effects;

/// Fraction from which [`percent`] shows a multiple instead of a percentage.
const MANY: f64 = 10.0;
/// Errors above this fraction are not stated as a number: the value of the reference is nearly zero.
const ENORMOUS: f64 = 1e4;

/// Formats a fraction as a percentage with two significant digits.
pub fn percent(fraction: f64) -> String {
    let percent = fraction * 100.0;
    if percent == 0.0 {
        return "0 %".into();
    }
    if !percent.is_finite() {
        return "no number".into();
    }
    if fraction >= ENORMOUS {
        return format!("more than {ENORMOUS:.0} x");
    }
    if fraction >= MANY {
        return format!("{fraction:.0} x");
    }
    let decimals = (1.0 - percent.abs().log10().floor()).max(0.0) as usize;
    if decimals > 5 { format!("{percent:.0e} %") } else { format!("{percent:.decimals$} %") }
}

/// Formats a number with about three digits.
pub fn three_digits(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e6).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let decimals = if value.abs() < 1.0 { 2.0 } else { (2.0 - value.abs().log10().floor()).max(0.0) };
    let text = format!("{value:.*}", decimals as usize);
    if value != 0.0 && text.parse() == Ok(0.0) { format!("{value:.1e}") } else { text }
}

/// Formats a ratio with two digits.
pub fn two_digits(value: f64) -> String {
    crate::text::numbers::significant(value, 2)
}

/// Names of effects that are on, except elastic gear bodies.
pub fn effects_on(p: &Parameters) -> Vec<&'static str> {
    effects().filter(|switch| switch.is_on(p) && !switch.is_bodies()).map(|switch| switch.name()).collect()
}

/// Describes a setting: level, law, effects, tolerance or fixed steps.
pub fn setting(p: &Parameters) -> String {
    let on = effects_on(p);
    let effects = if on.is_empty() { "no effect".into() } else { on.join(", ") };
    format!("{} with {effects}; {}", Gears::of(p).text(), solver(p))
}

/// Describes the tolerance, or the size of fixed steps.
pub fn solver(p: &Parameters) -> String {
    match p.solver.method {
        Method::FixedStep => format!("fixed steps of {} s", power(p.solver.fixed_step)),
        _ => format!("tolerance {}", power(p.solver.relative_tolerance)),
    }
}

/// Describes the settings of `other` that differ from `p`.
pub fn difference(p: &Parameters, other: &Parameters) -> String {
    let mut parts = Vec::new();
    let [here, there] = [p, other].map(|p| Gears::of(p).text());
    if here != there {
        parts.push(there);
    }
    let named = |from: &Parameters, to: &Parameters| -> Vec<&'static str> {
        let had = effects_on(from);
        effects_on(to).into_iter().filter(|name| !had.contains(name)).collect()
    };
    for (word, names) in [("without", named(other, p)), ("with", named(p, other))] {
        if !names.is_empty() {
            parts.push(format!("{word} {}", names.join(", ")));
        }
    }
    if solver(p) != solver(other) {
        parts.push(solver(other));
    }
    if parts.is_empty() { "the same".into() } else { parts.join(", ") }
}

fn power(value: f64) -> String {
    let text = format!("{value:e}");
    if text.len() > 6 { format!("{value:.0e}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevel_differential::model::GearContact;

    #[test]
    fn percents_have_two_digits_and_ratios_three() {
        assert_eq!([0.0, 0.012_34, 1.5, 3e-9].map(percent), ["0 %", "1.2 %", "150 %", "3e-7 %"]);
        assert_eq!([250.0, 2e17].map(percent), ["250 x", "more than 10000 x"]);
        assert_eq!([1.2345, 12.345, 0.012, 0.0, 1e-5].map(three_digits), ["1.23", "12.3", "0.01", "0.00", "1.00e-5"]);
    }

    #[test]
    fn a_difference_names_what_differs() {
        let p = Parameters::default();
        let mut changed = p;
        changed.scene.gear_contact = GearContact::Lumped;
        changed.effects.teeth.backlash = false;
        changed.effects.half_shaft = true;
        changed.solver.relative_tolerance = 1e-3;
        assert_eq!(difference(&p, &changed), "lumped, without backlash, with half_shaft, tolerance 1e-3");
        assert_eq!(difference(&p, &p), "the same");
    }
}

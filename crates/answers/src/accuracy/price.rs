//! Cost of a run, in evaluations of plain teeth: the run's numbers of communication steps and evaluations, times the
//! prices that `prices --write` measured. The cost does not depend on the machine, so equal questions get equal
//! answers.

use std::sync::OnceLock;

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearContact, Parameters};

use super::record::Effort;
use super::switches::effects;

/// Columns: enabled effect or level; price of an evaluation of the tooth forces; price of a communication step.
const MEASURED: &str = include_str!("../../data/prices.csv");

/// Minimum price by which [`evaluations`] divides. [`cost`] uses lower prices unchanged.
const LEAST: f64 = 0.01;

/// A row of `MEASURED`.
struct Price {
    on: String,
    per_evaluation: f64,
    per_step: f64,
}

impl Price {
    /// Price of an evaluation, without the share of communication steps. The measured price spreads the whole time of a
    /// run over its evaluations. The share that communication steps take even without teeth is removed here, because
    /// [`cost`] counts it separately.
    fn net_evaluation(&self) -> f64 {
        self.per_evaluation * (1.0 - step_without_teeth() / self.per_step).max(0.0)
    }
}

/// Price of a communication step without teeth.
fn step_without_teeth() -> f64 {
    measured("ideal").map_or(0.0, |price| price.per_step)
}

fn prices() -> &'static [Price] {
    static PRICES: OnceLock<Vec<Price>> = OnceLock::new();
    PRICES.get_or_init(|| {
        let mut rows = csv::Reader::from_reader(MEASURED.as_bytes());
        let row = |row: csv::StringRecord| {
            Some(Price {
                on: row.get(0)?.to_owned(),
                per_evaluation: row.get(1)?.parse().ok()?,
                per_step: row.get(2)?.parse().ok()?,
            })
        };
        rows.records().filter_map(|found| row(found.ok()?)).collect()
    })
}

fn measured(on: &str) -> Option<&'static Price> {
    prices().iter().find(|price| price.on == on)
}

/// Price of an evaluation of `p`: prices of effects add up (docs/accuracy.md).
fn price_of_evaluation(p: &Parameters) -> f64 {
    let base = match (p.scene.gear_contact, p.contact.law) {
        (GearContact::Lumped, _) => "lumped",
        (GearContact::Solid, _) => "solid",
        (_, ContactLaw::Line) => "line",
        (_, ContactLaw::LineWeber) => "line_weber",
        _ => "nothing",
    };
    let price = |on: &str| measured(on).map_or(0.0, Price::net_evaluation);
    let effect = |name: &str| match name {
        // measured together with the law `line`
        "body_compliance" => price(name) - price("line"),
        name => price(name) - price("nothing"),
    };
    let on = effects().filter(|switch| switch.is_on(p) && measured(switch.name()).is_some());
    price(base) + on.map(|switch| effect(switch.name()).max(0.0)).sum::<f64>()
}

/// Number of evaluations of `p` that cost `cost`.
pub fn evaluations(p: &Parameters, cost: f64) -> f64 {
    cost / price_of_evaluation(p).max(LEAST)
}

/// Cost of a run of `p` with `effort`.
pub fn cost(p: &Parameters, effort: &Effort) -> f64 {
    effort.points * step_without_teeth() + effort.evaluations * price_of_evaluation(p)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevel_differential::model::EFFECTS;

    #[test]
    fn every_effect_and_level_has_a_price() {
        let levels = ["ideal", "lumped", "nothing", "line", "line_weber", "solid"];
        for name in levels.into_iter().chain(EFFECTS.iter().filter(|e| e.switch.is_some()).map(|e| e.name)) {
            assert!(measured(name).is_some_and(|price| price.per_step > 0.0), "{name}");
        }
    }

    #[test]
    fn more_physics_costs_more() {
        let effort = Effort { points: 100.0, evaluations: 1000.0, ..Effort::default() };
        let plain = Parameters::default();
        let mut rich = plain;
        rich.contact.law = ContactLaw::LineWeber;
        rich.effects.body_compliance = true;
        rich.effects.tooth_friction = true;
        assert!(cost(&rich, &effort) > 2.0 * cost(&plain, &effort));
    }
}

//! Warming up: oil, gears, clutch packs, washers and case as nodes of a thermal network (`model::thermal`), fed by the
//! heat of the ledger. Each heat declares the node that it warms. Heat of brakes and of shafts stays outside.
//!
//! Friction that depends on temperature (`effect_kinds::slip_spec`) uses the temperature of its node. Without this
//! effect, all nodes have the temperature `oil.temperature`.

use crate::declaration::prelude::*;
use crate::declaration::{Range, Row, row};
use crate::model::effect_kinds::{BUILT, Declare, Effect, EffectSetting, InputField, Reading, Warmed, readings};
use crate::model::scene::{Scene, Start};
use crate::model::thermal::network::{Around, Conductance};
use crate::model::thermal::{CLUTCH, GEARS, NODES, Network, OIL, WASHERS};
use crate::problem::Problem;

parameters! {
    /// Warming up of oil, gears, clutch packs, washers and case.
    pub struct WarmUpSpec in "warm_up" {
        /// Ambient temperature around the case
        ambient_temperature: f64 = 293.15, KELVIN | DEG_C, TEMPERATURES, TUNABLE;
        /// The oil stays at oil.temperature, as with a cooler; false: it warms up
        sump_given: bool = false;
        /// Heat capacity of the oil
        oil_capacity: f64 = 1800.0, JOULE_PER_K, CAPACITIES;
        /// Specific heat of the gears, whose masses follow from their geometry
        gear_specific_heat: f64 = 460.0, JOULE_PER_KG_K, 1.0..=1e5;
        /// Heat capacity of the clutch packs
        clutch_capacity: f64 = 300.0, JOULE_PER_K, CAPACITIES;
        /// Heat capacity of the washers and pins
        washer_capacity: f64 = 60.0, JOULE_PER_K, CAPACITIES;
        /// Heat capacity of the case and housing
        case_capacity: f64 = 6000.0, JOULE_PER_K, CAPACITIES;
        /// Conductance from the gears to the oil
        gears_to_oil: f64 = 20.0, WATT_PER_K, CONDUCTANCES, TUNABLE;
        /// Increase of warm_up.gears_to_oil per carrier speed
        gears_to_oil_per_speed: f64 = 0.2, WATT_S_PER_K_RAD, 0.0..=1e4, TUNABLE;
        /// Conductance from the clutch packs to the oil
        clutch_to_oil: f64 = 10.0, WATT_PER_K, CONDUCTANCES, TUNABLE;
        /// Conductance from the washers and pins to the oil
        washers_to_oil: f64 = 5.0, WATT_PER_K, CONDUCTANCES, TUNABLE;
        /// Conductance from the oil to the case
        oil_to_case: f64 = 30.0, WATT_PER_K, CONDUCTANCES, TUNABLE;
        /// Conductance from the case to the surroundings
        case_to_ambient: f64 = 10.0, WATT_PER_K, CONDUCTANCES, TUNABLE;
        /// Increase of warm_up.case_to_ambient per carrier speed
        case_to_ambient_per_speed: f64 = 0.1, WATT_S_PER_K_RAD, 0.0..=1e4, TUNABLE;
        /// Fraction of the friction heat of teeth, washers and clutches that heats the oil directly
        oil_share: f64 = 0.0, ONE, 0.0..=1.0;
        /// Temperature of the gears above the oil at the start
        gears_above_oil: f64 = 0.0, KELVIN_DIFFERENCE, DIFFERENCES, when(differs!(Scene.start, Start::SteadyHeat));
        /// Temperature of the clutch packs above the oil at the start
        clutch_above_oil: f64 = 0.0, KELVIN_DIFFERENCE, DIFFERENCES, when(differs!(Scene.start, Start::SteadyHeat));
        /// Temperature of the washers and pins above the oil at the start
        washers_above_oil: f64 = 0.0, KELVIN_DIFFERENCE, DIFFERENCES, when(differs!(Scene.start, Start::SteadyHeat));
        /// Temperature of the case above the oil at the start
        case_above_oil: f64 = 0.0, KELVIN_DIFFERENCE, DIFFERENCES, when(differs!(Scene.start, Start::SteadyHeat));
        /// Length of the cycle over which scene.start = steady_heat balances the mean heat flows
        cycle: f64 = 1.0, SECOND, 1e-3..=10.0, when(is!(Scene.start, Start::SteadyHeat));
    }
}

/// Heat capacities [J/K].
const CAPACITIES: Range = Range { min: 1.0, max: 1e9 };
/// Conductances [W/K].
const CONDUCTANCES: Range = Range { min: 0.0, max: 1e6 };
/// Differences of temperatures at the start [K].
const DIFFERENCES: Range = Range { min: -400.0, max: 400.0 };

impl Declare for WarmUpSpec {
    const DESCRIPTION: &'static str =
        "Temperatures of oil, gears, clutch packs, washers and case, from the friction heat";
    const RECORDS_STEPS: bool = true;
    const READINGS: &'static [Reading] = readings! {
        /// Temperature of the oil; oil.temperature without effects.warm_up
        "temperature.oil": KELVIN | DEG_C, ByStep;
        /// Temperature of the gears; oil.temperature without effects.warm_up
        "temperature.gears": KELVIN | DEG_C, ByStep;
        /// Temperature of the clutch packs; oil.temperature without effects.warm_up
        "temperature.clutch": KELVIN | DEG_C, ByStep;
        /// Temperature of the washers and pins; oil.temperature without effects.warm_up
        "temperature.washers": KELVIN | DEG_C, ByStep;
        /// Temperature of the case; oil.temperature without effects.warm_up
        "temperature.case": KELVIN | DEG_C, ByStep;
        /// Heat stored in oil, gears, clutch packs, washers and case since the start
        "warm_up.stored": JOULE, ByStep;
        /// Heat given off to the surroundings and to a given sump since the start
        "warm_up.given_off": JOULE, ByStep;
    };

    fn needs() -> Vec<(Need, Condition)> {
        vec![
            (Need::GivenTemperature, any([off!(Self), is!(Self.sump_given, true)])),
            (Need::TemperatureAtStart, on!(Self)),
        ]
    }

    fn inputs() -> Vec<Row<InputField>> {
        // a build without effects accepts no change
        let most = if BUILT { MOST_CHANGE } else { 0.0 };
        vec![
            row(AMBIENT_CHANGE, "Deviation of the ambient temperature from warm_up.ambient_temperature").input(
                KELVIN_DIFFERENCE,
                most,
                |i| &mut i.ambient_change,
            ),
            row(SUMP_CHANGE, "Deviation of a given sump temperature from oil.temperature, for example by a cooler")
                .when(is!(Self.sump_given, true))
                .input(KELVIN_DIFFERENCE, most, |i| &mut i.sump_change),
        ]
    }
}

/// Input that changes the ambient temperature.
pub const AMBIENT_CHANGE: &str = "warm_up.ambient_change";
/// Input that changes the temperature of a given sump.
pub const SUMP_CHANGE: &str = "warm_up.sump_change";
/// Largest change of both temperatures [K].
const MOST_CHANGE: f64 = 500.0;

impl Effect for WarmUpSpec {
    fn check(&self, setting: &EffectSetting, found: &mut Vec<Problem>) {
        let Range { min: coldest, max: hottest } = TEMPERATURES;
        for (name, above) in self.above_oil() {
            let temperature = setting.oil.temperature + above;
            if !(coldest..=hottest).contains(&temperature) {
                found.push(problem!(
                    name,
                    "{above} K: with oil.temperature = {} K this node would begin at {temperature} K; it must be \
                     within {coldest} to {hottest} K",
                    setting.oil.temperature
                ));
            }
        }
    }
}

impl WarmUpSpec {
    /// Names and values of the temperatures above the oil at the start [K], in the order of the nodes.
    fn above_oil(&self) -> [(&'static str, f64); NODES - 1] {
        [
            ("warm_up.gears_above_oil", self.gears_above_oil),
            ("warm_up.clutch_above_oil", self.clutch_above_oil),
            ("warm_up.washers_above_oil", self.washers_above_oil),
            ("warm_up.case_above_oil", self.case_above_oil),
        ]
    }

    /// Temperatures at the start with the oil at `oil` [K].
    pub fn temperatures_at_start(&self, oil: f64) -> [f64; NODES] {
        let mut temperatures = [oil; NODES];
        for (temperature, (_, above)) in temperatures[GEARS..].iter_mut().zip(self.above_oil()) {
            *temperature += above;
        }
        temperatures
    }

    /// Shares of the nodes in a heat of the ledger.
    fn shares(&self, of: Warmed) -> [f64; NODES] {
        let mut shares = [0.0; NODES];
        let Warmed::Node(node) = of else { return shares };
        let direct = if matches!(node, GEARS | WASHERS | CLUTCH) { self.oil_share } else { 0.0 };
        shares[OIL] += direct;
        shares[node] += 1.0 - direct;
        shares
    }

    /// Network with gears of `mass` [kg], for the `heats` of the ledger. A given sump has the temperature `oil`
    /// [K].
    pub fn network<const H: usize>(&self, mass: f64, oil: f64, heats: [Warmed; H]) -> Network<H> {
        let constant = |at_rest| Conductance { at_rest, per_speed: 0.0 };
        let gears = Conductance { at_rest: self.gears_to_oil, per_speed: self.gears_to_oil_per_speed };
        let (clutch, washers, case) = (self.clutch_to_oil, self.washers_to_oil, self.oil_to_case);
        Network {
            capacity: [
                self.oil_capacity,
                self.gear_specific_heat * mass,
                self.clutch_capacity,
                self.washer_capacity,
                self.case_capacity,
            ],
            to_oil: [Conductance::default(), gears, constant(clutch), constant(washers), constant(case)],
            to_ambient: Conductance { at_rest: self.case_to_ambient, per_speed: self.case_to_ambient_per_speed },
            around: Around { ambient: self.ambient_temperature, sump: self.sump_given.then_some(oil) },
            shares: heats.map(|heat| self.shares(heat)),
        }
    }
}

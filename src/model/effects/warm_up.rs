//! Warming up: oil, gears, clutch packs, washers and case as nodes of a thermal network (`model::thermal`), fed by the
//! heat of the ledger. Heat of brakes and half-shafts arises elsewhere and stays outside.
//!
//! Friction that depends on temperature (`effect_kinds::slip_spec`) uses the temperature of its node. Without this
//! effect, all nodes have the temperature `oil.temperature`.

use super::limited_slip::CLUTCH_HEAT;
use crate::declaration::units::{self, DEG_C};
use crate::declaration::{Parameter, Row, row};
use crate::model::effect_kinds::{BUILT, Changes, Declare, Effect, InputField, Reading, Setting};
use crate::model::thermal::network::{Around, Conductance};
use crate::model::thermal::{CASE, CLUTCH, GEARS, NODES, Network, OIL, WASHERS};
use crate::problem::Problem;

spec! {
    /// Warming up of oil, gears, clutch packs, washers and case.
    pub struct WarmUpSpec {
        /// Temperature around the case [K].
        pub ambient: f64 = 293.15,
        /// True if the oil has the given temperature `oil.temperature`, as with a cooler. The host may change it by an
        /// input.
        pub sump_given: bool = false,
        /// Heat capacity of the oil [J/K].
        pub oil_capacity: f64 = 1800.0,
        /// Specific heat of the gears [J/(kg·K)]. Their masses follow from their solids.
        pub gear_specific_heat: f64 = 460.0,
        /// Heat capacity of the clutch packs [J/K].
        pub clutch_capacity: f64 = 300.0,
        /// Heat capacity of washers and pins [J/K].
        pub washer_capacity: f64 = 60.0,
        /// Heat capacity of the case [J/K].
        pub case_capacity: f64 = 6000.0,
        /// Conductance from the gears to the oil [W/K].
        pub gears_to_oil: f64 = 20.0,
        /// Growth of `gears_to_oil` per carrier speed [W·s/(K·rad)].
        pub gears_to_oil_per_speed: f64 = 0.2,
        /// Conductance from the clutch packs to the oil [W/K].
        pub clutch_to_oil: f64 = 10.0,
        /// Conductance from washers and pins to the oil [W/K].
        pub washers_to_oil: f64 = 5.0,
        /// Conductance from the oil to the case [W/K].
        pub oil_to_case: f64 = 30.0,
        /// Conductance from the case to ambient [W/K].
        pub case_to_ambient: f64 = 10.0,
        /// Growth of `case_to_ambient` per carrier speed [W·s/(K·rad)].
        pub case_to_ambient_per_speed: f64 = 0.1,
        /// Share of the heat of teeth, washers and clutches that enters the oil directly.
        pub oil_share: f64 = 0.0,
        /// Temperature of the gears minus oil temperature, at the start [K].
        pub gears_above_oil: f64 = 0.0,
        /// Temperature of the clutch packs minus oil temperature, at the start [K].
        pub clutch_above_oil: f64 = 0.0,
        /// Temperature of washers and pins minus oil temperature, at the start [K].
        pub washers_above_oil: f64 = 0.0,
        /// Temperature of the case minus oil temperature, at the start [K].
        pub case_above_oil: f64 = 0.0,
        /// Length of the cycle whose mean heats balance at a start with steady heat [s].
        pub cycle: f64 = 1.0,
    }
}

/// Reading of a temperature.
macro_rules! temperature {
    ($name:literal, $of:literal) => {
        Reading {
            name: concat!("temperature.", $name),
            unit: units::KELVIN,
            display: Some(DEG_C),
            changes: Changes::ByStep,
            description: concat!("Temperature of ", $of, "; oil.temperature without effects.warm_up"),
        }
    };
}

/// Reading of a heat of the network.
macro_rules! heat {
    ($name:literal, $of:literal) => {
        Reading {
            name: concat!("warm_up.", $name),
            unit: units::JOULE,
            display: None,
            changes: Changes::ByStep,
            description: $of,
        }
    };
}

impl Declare for WarmUpSpec {
    const DESCRIPTION: &'static str =
        "Temperatures of oil, gears, clutch packs, washers and case, from the friction heat";
    const READINGS: &'static [Reading] = &[
        temperature!("oil", "the oil"),
        temperature!("gears", "the gears"),
        temperature!("clutch", "the clutch packs"),
        temperature!("washers", "the washers and pins"),
        temperature!("case", "the case"),
        heat!("stored", "Heat stored in oil, gears, clutch packs, washers and case since the start"),
        heat!("given_off", "Heat given off to the surroundings and to a given sump since the start"),
    ];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        let capacity = |name, of, at| row(name, of).real(units::JOULE_PER_K, (1.0, 1e9), at);
        let conductance = |name, of, at| row(name, of).tunable().real(units::WATT_PER_K, (0.0, 1e6), at);
        let above = |name, of, at| {
            row(name, of).when("scene.start != steady_heat").real(units::KELVIN_DIFFERENCE, (-400.0, 400.0), at)
        };
        let per_speed = |name, of, at| row(name, of).tunable().real(units::WATT_S_PER_K_RAD, (0.0, 1e4), at);
        vec![
            row("warm_up.ambient_temperature", "Ambient temperature around the case").tunable().real(
                (units::KELVIN, DEG_C),
                units::TEMPERATURES,
                |p| &mut p.ambient,
            ),
            row("warm_up.sump_given", "The oil stays at oil.temperature, as with a cooler; false: it warms up")
                .switch(|p| &mut p.sump_given),
            capacity("warm_up.oil_capacity", "Heat capacity of the oil", |p| &mut p.oil_capacity),
            row("warm_up.gear_specific_heat", "Specific heat of the gears, whose masses follow from their geometry")
                .real(units::JOULE_PER_KG_K, (1.0, 1e5), |p| &mut p.gear_specific_heat),
            capacity("warm_up.clutch_capacity", "Heat capacity of the clutch packs", |p| &mut p.clutch_capacity),
            capacity("warm_up.washer_capacity", "Heat capacity of the washers and pins", |p| &mut p.washer_capacity),
            capacity("warm_up.case_capacity", "Heat capacity of the case and housing", |p| &mut p.case_capacity),
            conductance("warm_up.gears_to_oil", "Conductance from the gears to the oil", |p| &mut p.gears_to_oil),
            per_speed("warm_up.gears_to_oil_per_speed", "Increase of warm_up.gears_to_oil per carrier speed", |p| {
                &mut p.gears_to_oil_per_speed
            }),
            conductance("warm_up.clutch_to_oil", "Conductance from the clutch packs to the oil", |p| {
                &mut p.clutch_to_oil
            }),
            conductance("warm_up.washers_to_oil", "Conductance from the washers and pins to the oil", |p| {
                &mut p.washers_to_oil
            }),
            conductance("warm_up.oil_to_case", "Conductance from the oil to the case", |p| &mut p.oil_to_case),
            conductance("warm_up.case_to_ambient", "Conductance from the case to the surroundings", |p| {
                &mut p.case_to_ambient
            }),
            per_speed(
                "warm_up.case_to_ambient_per_speed",
                "Increase of warm_up.case_to_ambient per carrier speed",
                |p| &mut p.case_to_ambient_per_speed,
            ),
            row(
                "warm_up.oil_share",
                "Fraction of the friction heat of teeth, washers and clutches that heats the \
                                      oil directly",
            )
            .real(units::ONE, (0.0, 1.0), |p| &mut p.oil_share),
            above("warm_up.gears_above_oil", "Temperature of the gears above the oil at the start", |p| {
                &mut p.gears_above_oil
            }),
            above("warm_up.clutch_above_oil", "Temperature of the clutch packs above the oil at the start", |p| {
                &mut p.clutch_above_oil
            }),
            above("warm_up.washers_above_oil", "Temperature of the washers and pins above the oil at the start", |p| {
                &mut p.washers_above_oil
            }),
            above("warm_up.case_above_oil", "Temperature of the case above the oil at the start", |p| {
                &mut p.case_above_oil
            }),
            row(
                "warm_up.cycle",
                "Length of the cycle over which scene.start = steady_heat balances the mean heat \
                                  flows",
            )
            .when("scene.start = steady_heat")
            .real(units::SECOND, (1e-3, 10.0), |p| &mut p.cycle),
        ]
    }

    fn inputs() -> Vec<Row<InputField>> {
        // a build without effects accepts no change
        let most = if BUILT { MOST_CHANGE } else { 0.0 };
        vec![
            row(AMBIENT_CHANGE, "Deviation of the ambient temperature from warm_up.ambient_temperature").input(
                units::KELVIN_DIFFERENCE,
                most,
                |i| &mut i.ambient_change,
            ),
            row(SUMP_CHANGE, "Deviation of a given sump temperature from oil.temperature, for example by a cooler")
                .when("warm_up.sump_given = true")
                .input(units::KELVIN_DIFFERENCE, most, |i| &mut i.sump_change),
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
    fn check(&self, setting: &Setting, found: &mut Vec<Problem>) {
        let (coldest, hottest) = units::TEMPERATURES;
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

    /// Shares of the nodes in the heat `output` of the ledger.
    fn shares(&self, output: &str) -> [f64; NODES] {
        let mut shares = [0.0; NODES];
        let node = match output {
            "heat.contact" | "heat.tooth_friction" => GEARS,
            "heat.thrust" => WASHERS,
            "heat.support" => CASE,
            "heat.drag" => OIL,
            name if name == CLUTCH_HEAT.output => CLUTCH,
            _ => return shares,
        };
        let direct = if matches!(node, GEARS | WASHERS | CLUTCH) { self.oil_share } else { 0.0 };
        shares[OIL] += direct;
        shares[node] += 1.0 - direct;
        shares
    }

    /// Network with gears of `mass` [kg], for the heats `outputs` of the ledger. A given sump has the temperature `oil`
    /// [K].
    pub fn network<const H: usize>(&self, mass: f64, oil: f64, outputs: [&str; H]) -> Network<H> {
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
            around: Around { ambient: self.ambient, sump: self.sump_given.then_some(oil) },
            shares: outputs.map(|output| self.shares(output)),
        }
    }
}

//! Thermal network of a differential: a star around the oil.
//!
//! ```text
//! C_i θ̇_i = q_i − G_i (θ_i − θ_oil)          gears, clutch packs, washers
//! C_c θ̇_c = q_c − G_c (θ_c − θ_oil) − G_a (θ_c − θ_a)      case, to ambient
//! C_o θ̇_o = q_o + Σ G_i (θ_i − θ_oil)
//! ```
//!
//! The heat rate q_i of each node comes from the ledger. Conductances may grow with a speed, as in convection. A solver
//! step is divided into substeps of the implicit midpoint rule that are short compared with the time constant of the
//! fastest node. Heat that leaves one node enters another, so no heat is lost.
//!
//! Source: the thermal balance of ISO/TR 14179-2, and thermal networks of axles and gear units (C. Changenet, X.
//! Oviedo-Marlot, P. Velex, J. Mechanical Design 128 (2006), p. 1128).

use super::{CASE, NODES, OIL, Thermal};
use crate::declaration::Range;
use crate::declaration::units::TEMPERATURES;

/// Maximum substep of the midpoint rule, as a fraction of the time constant of the fastest node.
const PART: f64 = 0.25;
/// Maximum number of substeps per solver step. A solver step lasts at most 1 s.
const MOST_PARTS: f64 = 1000.0;

/// Conductance at rest, and its growth per speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Conductance {
    /// Value at standstill [W/K].
    pub at_rest: f64,
    /// Growth per carrier speed [W·s/(K·rad)].
    pub per_speed: f64,
}

/// Outside temperatures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Around {
    /// Temperature around the case [K].
    pub ambient: f64,
    /// Temperature of the oil, if it is given [K].
    pub sump: Option<f64>,
}

/// Nodes and the conductances between them. `H` is the number of heats in the ledger.
#[derive(Clone, Debug, PartialEq)]
pub struct Network<const H: usize> {
    /// Heat capacities [J/K].
    pub capacity: [f64; NODES],
    /// Conductances to the oil; 0 for the oil itself.
    pub to_oil: [Conductance; NODES],
    /// Conductance from the case to ambient.
    pub to_ambient: Conductance,
    /// Outside temperatures, without the changes that the host commands.
    pub around: Around,
    /// Shares of each heat in the ledger that enter the nodes; the remainder stays outside.
    pub shares: [[f64; NODES]; H],
}

/// Rates of the temperatures, and of the heat given off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Rates of the temperatures of all nodes [K/s].
    pub temperatures: [f64; NODES],
    /// Heat given off to ambient and a sump of given temperature [W].
    pub given_off: f64,
}

impl Around {
    /// Returns the temperatures changed by `changes` [K], without limits.
    pub fn commanded(self, [ambient, sump]: [f64; 2]) -> Self {
        Self { ambient: self.ambient + ambient, sump: self.sump.map(|given| given + sump) }
    }

    /// Returns the temperatures changed by `changes` [K], limited to the range of the friction laws.
    pub fn changed(self, changes: [f64; 2]) -> Self {
        let Range { min: coldest, max: hottest } = TEMPERATURES;
        let within = |temperature: f64| temperature.clamp(coldest, hottest);
        let Self { ambient, sump } = self.commanded(changes);
        Self { ambient: within(ambient), sump: sump.map(within) }
    }
}

impl Conductance {
    /// Conductance [W/K] at the magnitude `speed` of the carrier speed [rad/s].
    pub fn at(self, speed: f64) -> f64 {
        self.at_rest + self.per_speed * speed
    }
}

impl<const H: usize> Network<H> {
    /// Heat that enters each node [J], from the heats of the ledger.
    pub fn entering(&self, heat: &[f64; H]) -> [f64; NODES] {
        std::array::from_fn(|i| heat.iter().zip(&self.shares).map(|(heat, share)| heat * share[i]).sum())
    }

    /// Heat stored since the start [J].
    pub fn stored(&self, thermal: &Thermal) -> f64 {
        self.absorbed(&thermal.gains())
    }

    /// Heat that temperature changes [K] absorb [J].
    pub fn absorbed(&self, changes: &[f64; NODES]) -> f64 {
        self.capacity.iter().zip(changes).map(|(capacity, change)| capacity * change).sum()
    }

    /// Rates of `thermal` with the heat rates `heat` [W] of the ledger and the magnitude `speed` of the carrier speed
    /// [rad/s]. The last argument contains the outside temperatures and the rate of a given sump [K/s].
    pub fn rates(&self, thermal: &Thermal, heat: &[f64; H], speed: f64, (around, sump): (Around, f64)) -> Rates {
        let (at, power) = (thermal.temperatures(), self.entering(heat));
        let mut given_off = self.to_ambient.at(speed) * (at[CASE] - around.ambient);
        let mut into_oil = power[OIL];
        let mut temperatures = [0.0; NODES];
        for i in GEARS_TO_CASE {
            let flow = self.to_oil[i].at(speed) * (at[i] - at[OIL]);
            into_oil += flow;
            temperatures[i] = (power[i] - flow - if i == CASE { given_off } else { 0.0 }) / self.capacity[i];
        }
        temperatures[OIL] = into_oil / self.capacity[OIL];
        if around.sump.is_some() {
            given_off += into_oil - self.capacity[OIL] * sump;
            temperatures[OIL] = sump;
        }
        Rates { temperatures, given_off }
    }

    /// Advances the temperatures by a solver step of `h` [s]. `heat` contains the heats of the ledger at its end [J],
    /// and `speed` is the magnitude of the carrier speed [rad/s]. The last argument also contains the outside
    /// temperatures halfway through the step and at its end.
    pub fn advance(&self, thermal: &mut Thermal, heat: &[f64; H], h: f64, (speed, [halfway, end]): (f64, [Around; 2])) {
        let entering = self.entering(heat);
        let power: [f64; NODES] = std::array::from_fn(|i| (entering[i] - thermal.entered[i]) / h);
        thermal.entered = entering;
        let begin = thermal.rises;
        let to_oil = self.to_oil.map(|g| g.at(speed));
        let to_ambient = self.to_ambient.at(speed);
        let leaving = |i: usize| to_oil[i] + if i == CASE { to_ambient } else { 0.0 };
        let all: f64 = to_oil.iter().sum();
        let fastest =
            (0..NODES).map(|i| if i == OIL { all } else { leaving(i) } / self.capacity[i]).fold(0.0, f64::max);
        let parts = libm::ceil(h * fastest / PART).clamp(1.0, MOST_PARTS);
        for _ in 0..parts as usize {
            self.midpoint(thermal, &power, h / parts, (&to_oil, to_ambient, halfway));
        }
        if let Some(given) = end.sump {
            self.give_sump(thermal, given - thermal.start);
        }
        thermal.note_rates(&begin, h);
    }

    /// Takes a substep by the midpoint rule. The heat balance gives the oil temperature halfway, and the other
    /// temperatures halfway follow from it. All temperatures are relative to the start, so rounding does not lose small
    /// amounts of heat.
    fn midpoint(
        &self,
        thermal: &mut Thermal,
        power: &[f64; NODES],
        h: f64,
        (to_oil, to_ambient, around): (&[f64; NODES], f64, Around),
    ) {
        let begin = thermal.rises;
        let (ambient, sump) = (around.ambient - thermal.start, around.sump.map(|sump| sump - thermal.start));
        let inertia: [f64; NODES] = std::array::from_fn(|i| 2.0 * self.capacity[i] / h);
        // temperature of a node halfway: (known + conductance θ_oil)/sum
        let known: [f64; NODES] = std::array::from_fn(|i| {
            let from_ambient = if i == CASE { to_ambient * ambient } else { 0.0 };
            inertia[i] * begin[i] + power[i] + from_ambient
        });
        let sum: [f64; NODES] =
            std::array::from_fn(|i| inertia[i] + to_oil[i] + if i == CASE { to_ambient } else { 0.0 });
        let oil = sump.unwrap_or_else(|| {
            let (mut of, mut by) = (known[OIL], inertia[OIL]);
            for i in GEARS_TO_CASE {
                of += to_oil[i] * known[i] / sum[i];
                by += to_oil[i] * (1.0 - to_oil[i] / sum[i]);
            }
            of / by
        });
        let (mut into_oil, mut halfway) = (power[OIL], [oil; NODES]);
        for i in GEARS_TO_CASE {
            halfway[i] = (known[i] + to_oil[i] * oil) / sum[i];
            into_oil += to_oil[i] * (halfway[i] - oil);
            thermal.rises[i] = 2.0 * halfway[i] - begin[i];
        }
        thermal.given_off += h * to_ambient * (halfway[CASE] - ambient);
        match sump {
            None => thermal.rises[OIL] = 2.0 * oil - begin[OIL],
            Some(given) => {
                thermal.given_off += h * into_oil;
                self.give_sump(thermal, given);
            }
        }
    }

    /// Sets the oil to a `given` rise [K] with heat from outside.
    fn give_sump(&self, thermal: &mut Thermal, given: f64) {
        thermal.given_off -= self.capacity[OIL] * (given - thermal.rises[OIL]);
        thermal.rises[OIL] = given;
    }
}

/// All nodes except the oil.
pub(super) const GEARS_TO_CASE: std::ops::RangeInclusive<usize> = super::GEARS..=CASE;

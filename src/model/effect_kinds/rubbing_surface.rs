//! Surface on which a pair of bodies rubs: the contribution of an effect to dry friction. Its limit torque depends on
//! the loads on the surface and on the slip of the pair.

use super::dry_friction::DAMPING_TIME;
use super::{PvLimit, Ramps, SlipLaw, SlipSpec, TorqueCurve};
use crate::model::scene::{Inputs, RubbingKind};
use crate::model::thermal::{NODES, OIL};

/// Loads that press the surfaces of a pair together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceLoad {
    /// Thrust on a side gear, or on a planet [N].
    pub thrust: f64,
    /// Mesh torque that presses the pack of a side gear [N·m], magnitude of the force across a planet's pin
    /// [N], or limit torque of a wheel [N·m].
    pub load: f64,
}

impl SurfaceLoad {
    /// Loads on the way to `other`, of which they contain the part `weight`.
    pub fn toward(&self, other: &Self, weight: f64) -> Self {
        let between = |from: f64, to: f64| from + weight * (to - from);
        Self { thrust: between(self.thrust, other.thrust), load: between(self.load, other.load) }
    }
}

/// Quantity of a surface that is linear in thrust and load: its limit torque [N·m], or its pressure times radius [N/m].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ByLoad {
    /// Constant value.
    pub constant: f64,
    /// Value per newton of thrust.
    pub per_thrust: f64,
    /// Value per unit of the load.
    pub per_load: f64,
}

impl ByLoad {
    /// Zero.
    pub const NONE: Self = Self { constant: 0.0, per_thrust: 0.0, per_load: 0.0 };

    /// True if it depends on the loads.
    pub fn varies(&self) -> bool {
        self.per_thrust != 0.0 || self.per_load != 0.0
    }

    /// Value under the loads `by`.
    pub fn at(&self, by: &SurfaceLoad) -> f64 {
        self.constant + self.per_thrust * by.thrust + self.per_load * by.load
    }

    /// Pressure times radius [N/m] of a surface with this limit torque, from its coefficient of friction and its area
    /// [m²].
    pub fn pressed(self, coefficient: f64, area: f64) -> Self {
        // a friction torque T = μ N r needs the pressure p = N/A, so that p r = T/(μ A)
        self.times(1.0 / (coefficient * area))
    }

    /// Returns `factor` times the quantity.
    pub fn times(self, factor: f64) -> Self {
        let Self { constant, per_thrust, per_load } = self;
        Self { constant: factor * constant, per_thrust: factor * per_thrust, per_load: factor * per_load }
    }
}

/// Motion of a body against the surface it rubs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// Position [rad].
    pub position: f64,
    /// Speed [rad/s].
    pub speed: f64,
}

/// Function of the inputs that returns the limit torques on the left and the right side [N·m].
pub type SideLimits = fn(&Inputs) -> [f64; 2];

/// Command that acts on a surface.
#[derive(Clone, Copy, Debug)]
pub enum Command {
    /// None.
    None,
    /// The command of the lock presses the surface and sets its stiffness at the start of a step.
    Lock,
    /// The inputs give the limit torques.
    Limits(SideLimits),
}

/// Origin of the temperature of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurfaceTemperature {
    /// Temperature of a node of the thermal network.
    Node(usize),
    /// Given temperature [K].
    Given(f64),
}

/// Part of a surface in carrying the thrust of its gear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ThrustPart {
    /// None.
    None,
    /// Washer behind the gear.
    Washer,
    /// Plates that the gear presses. They take the place of its washer.
    Plates,
}

/// Surface on which pairs of one kind rub.
#[derive(Clone, Copy, Debug)]
pub struct RubbingSurface {
    /// Kind of the pairs.
    pub kind: RubbingKind,
    /// Place of the surface in messages, after the name of the body.
    pub place: &'static str,
    /// Name of the effect.
    pub effect: &'static str,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
    /// Limit torque [N·m].
    pub limit: ByLoad,
    /// Limit torque over slip, instead of `limit`, whose constant is the breakaway torque.
    pub curve: Option<TorqueCurve>,
    /// Parts that convert mesh torque to pressure.
    pub ramps: Ramps,
    /// Stiffness while stuck [N·m/rad]; 0 if another surface of the effect holds the pair.
    pub stiffness: f64,
    /// Damping of the spring over its stiffness, left and right [s].
    pub damping_time: [f64; 2],
    /// Mean radius [m].
    pub radius: f64,
    /// Pressure times radius [N/m].
    pub pressed: ByLoad,
    /// Part in carrying the thrust of the gear.
    pub thrust_part: ThrustPart,
    /// Parameters of sliding.
    pub sliding: SlipSpec,
    /// Origin of its temperature.
    pub temperature: SurfaceTemperature,
    /// Command that acts on it.
    pub command: Command,
}

impl RubbingSurface {
    /// Surface without friction; its heat has the index `heat_index`.
    pub fn new(kind: RubbingKind, heat_index: usize) -> Self {
        Self {
            kind,
            place: "",
            effect: "",
            heat_index,
            limit: ByLoad::NONE,
            curve: None,
            ramps: Ramps::OWN_SIDE,
            stiffness: 0.0,
            damping_time: [DAMPING_TIME; 2],
            radius: 0.0,
            pressed: ByLoad::NONE,
            thrust_part: ThrustPart::None,
            sliding: SlipSpec::default(),
            temperature: SurfaceTemperature::Node(OIL),
            command: Command::None,
        }
    }

    /// Removes washers whose place is taken by plates that the gear presses.
    pub fn remove_replaced(surfaces: &mut Vec<Self>) {
        let has_plates = RubbingKind::ALL
            .map(|kind| surfaces.iter().any(|of| of.kind == kind && of.thrust_part == ThrustPart::Plates));
        surfaces.retain(|of| of.thrust_part != ThrustPart::Washer || !has_plates[of.kind as usize]);
    }

    /// Friction at the `temperatures` of all nodes [K], relative to the friction at the reference temperature.
    pub fn factor(&self, temperatures: &[f64; NODES]) -> f64 {
        self.sliding.factor_at(match self.temperature {
            SurfaceTemperature::Node(node) => temperatures[node],
            SurfaceTemperature::Given(temperature) => temperature,
        })
    }

    /// True if its pressure is known.
    pub fn has_pressure(&self) -> bool {
        self.pressed != ByLoad::NONE
    }

    /// True if the command of the lock presses it.
    pub fn is_lock(&self) -> bool {
        matches!(self.command, Command::Lock)
    }

    /// True if its friction depends on the loads of the meshes.
    pub fn depends_on_meshes(&self) -> bool {
        !matches!(self.command, Command::Limits(_)) && self.kind != RubbingKind::Pinion && self.limit.varies()
    }

    /// Law of friction over slip speed.
    fn law(&self) -> SlipLaw {
        let SlipSpec { stribeck_speed, slip_slope: slope, static_ratio, .. } = self.sliding;
        SlipLaw { radius: self.radius, excess: static_ratio - 1.0, stribeck_speed, slope }
    }

    /// Limit of p·v at which friction changes, if there is one.
    fn pv_limit(&self) -> Option<PvLimit> {
        let SlipSpec { pv_limit: limit, beyond_limit: beyond, .. } = self.sliding;
        Some(PvLimit { limit, beyond }).filter(PvLimit::acts)
    }

    /// True if friction changes with slip.
    pub fn varies_with_slip(&self) -> bool {
        !self.law().is_constant() || self.pv_limit().is_some() || self.curve.is_some()
    }
}

/// Surface that acts now, with its limit torque at the present temperature and command. The law of sliding belongs to
/// the [`RubbingSurface`].
#[derive(Clone, Copy, Debug)]
pub struct ActingSurface {
    /// Kinetic limit torque without its change over speed [N·m].
    pub limit: ByLoad,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
    /// Number of the surface among all surfaces.
    pub surface: u16,
}

impl ActingSurface {
    /// No friction.
    pub const NONE: Self = Self { limit: ByLoad::NONE, heat_index: 0, surface: 0 };

    /// Limit torque while stuck [N·m].
    pub(super) fn breakaway(&self, surface: &RubbingSurface, by: &SurfaceLoad) -> f64 {
        surface.sliding.static_ratio * self.limit.at(by)
    }

    /// Limit torque [N·m] while the body slides at `speed` [rad/s] in its direction, and the derivative with respect to
    /// speed. It is `inline(never)` to keep the code of friction without slip dependence small.
    #[inline(never)]
    pub(super) fn sliding(&self, surface: &RubbingSurface, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        if let Some(curve) = &surface.curve {
            return curve.at(speed);
        }
        let ([value, slope], kinetic) = (surface.law().factor(speed), self.limit.at(by));
        let [torque, by_speed] = [value * kinetic, slope * kinetic];
        let Some(limit) = surface.pv_limit() else { return [torque, by_speed] };
        let pressure = surface.pressed.at(by);
        let [factor, by_pv] = limit.factor(pressure * speed);
        [factor * torque, factor * by_speed + by_pv * pressure * torque]
    }

    /// Derivatives of the torque of [`Self::sliding`] with respect to thrust and load.
    #[inline(never)]
    pub(super) fn slopes(&self, surface: &RubbingSurface, speed: f64, by: &SurfaceLoad) -> [f64; 2] {
        let ([value, _], limit) = (surface.law().factor(speed), &self.limit);
        let [by_thrust, by_load] = [value * limit.per_thrust, value * limit.per_load];
        let Some(pv_limit) = surface.pv_limit() else { return [by_thrust, by_load] };
        let pressed = &surface.pressed;
        let [factor, by_pv] = pv_limit.factor(pressed.at(by) * speed);
        let by_pressure = by_pv * speed * value * limit.at(by);
        [factor * by_thrust + by_pressure * pressed.per_thrust, factor * by_load + by_pressure * pressed.per_load]
    }
}

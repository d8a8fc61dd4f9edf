//! SI units of the interface, and the units in which users read values.

use std::f64::consts::PI;
use std::ops::BitOr;

use super::Range;

/// Exponents of the SI base units kg, m, s and K, and of the radian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Base {
    /// Exponent of kg.
    pub kg: i32,
    /// Exponent of m.
    pub m: i32,
    /// Exponent of s.
    pub s: i32,
    /// Exponent of rad.
    pub rad: i32,
    /// Exponent of K.
    pub k: i32,
}

/// A unit other than SI in which values are shown: `shown = factor · SI value + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayUnit {
    /// Name for users.
    pub name: &'static str,
    /// Number of these units in one SI unit.
    pub factor: f64,
    /// Value shown for 0 in SI.
    pub offset: f64,
}

impl DisplayUnit {
    /// Returns the value in this unit for `value` in SI.
    pub fn show(&self, value: f64) -> f64 {
        value * self.factor + self.offset
    }

    /// Returns the SI value of `shown`, a value in this unit.
    pub fn read(&self, shown: f64) -> f64 {
        (shown - self.offset) / self.factor
    }

    /// Text of an SI `value` in this unit with at most six decimals, for messages.
    pub fn text(&self, value: f64) -> String {
        format!("{} {}", (self.show(value) * 1e6).round() / 1e6, self.name)
    }
}

/// An SI unit with its display units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Name used in the interface.
    pub name: &'static str,
    /// Exponents of base units; `None` if they are not integers, as FMI 2.0 requires.
    pub base: Option<Base>,
    /// Units in which its values may be shown.
    pub display: &'static [DisplayUnit],
    /// True if values are differences, whose display units have no offset. FMI calls them relative quantities.
    pub is_relative: bool,
}

impl Unit {
    /// Returns the unit of differences between values in this unit.
    pub fn of_differences(self) -> Self {
        if self == KELVIN { KELVIN_DIFFERENCE } else { self }
    }
}

/// An SI unit, and the display unit of its values if users expect another unit.
#[derive(Clone, Copy, Debug)]
pub struct Shown(pub Unit, pub Option<DisplayUnit>);

impl BitOr<DisplayUnit> for Unit {
    type Output = Shown;

    fn bitor(self, display: DisplayUnit) -> Shown {
        Shown(self, Some(display))
    }
}

impl From<Unit> for Shown {
    fn from(unit: Unit) -> Self {
        Self(unit, None)
    }
}

const fn base(kg: i32, m: i32, s: i32, rad: i32) -> Option<Base> {
    Some(Base { kg, m, s, rad, k: 0 })
}

const fn per_kelvin(kg: i32, m: i32, s: i32, rad: i32) -> Option<Base> {
    Some(Base { kg, m, s, rad, k: -1 })
}

const fn shown(name: &'static str, factor: f64) -> DisplayUnit {
    DisplayUnit { name, factor, offset: 0.0 }
}

/// Millimetre.
pub const MM: DisplayUnit = shown("mm", 1e3);
/// Degree.
pub const DEG: DisplayUnit = shown("deg", 180.0 / PI);
/// Degree per second.
pub const DEG_PER_S: DisplayUnit = shown("deg/s", 180.0 / PI);
/// Revolution per minute.
pub const RPM: DisplayUnit = shown("rpm", 30.0 / PI);
/// Newton per mm^1.5: 1 N/m^1.5 = 1000^-1.5 N/mm^1.5.
pub const N_PER_MM15: DisplayUnit = shown("N/mm^1.5", 3.162_277_660_168_379_5e-5);
/// Newton-second per millimetre.
pub const NS_PER_MM: DisplayUnit = shown("N.s/mm", 1e-3);
/// Megapascal.
pub const MPA: DisplayUnit = shown("MPa", 1e-6);
/// Micrometre.
pub const UM: DisplayUnit = shown("um", 1e6);
/// Newton per millimetre.
pub const N_PER_MM: DisplayUnit = shown("N/mm", 1e-3);
/// Newton per micrometre.
pub const N_PER_UM: DisplayUnit = shown("N/um", 1e-6);
/// Newton per millimetre of face width and micrometre of deflection.
pub const N_PER_MM_UM: DisplayUnit = shown("N/(mm.um)", 1e-9);
/// Millipascal-second.
pub const MILLI_PA_S: DisplayUnit = shown("mPa.s", 1e3);
/// Kilometre per hour.
pub const KM_PER_H: DisplayUnit = shown("km/h", 3.6);
/// Square millimetre per second.
pub const MM2_PER_S: DisplayUnit = shown("mm2/s", 1e6);
/// Square centimetre.
pub const CM2: DisplayUnit = shown("cm2", 1e4);
/// Watt per square millimetre: MPa·m/s.
pub const W_PER_MM2: DisplayUnit = shown("W/mm2", 1e-6);
/// Degree Celsius.
pub const DEG_C: DisplayUnit = DisplayUnit { name: "degC", factor: 1.0, offset: -273.15 };
/// Kilonewton.
pub const KN: DisplayUnit = shown("kN", 1e-3);
/// Kilonewton-metre.
pub const KNM: DisplayUnit = shown("kN.m", 1e-3);

/// Temperature difference: 5 degC are 5 K.
pub const KELVIN_DIFFERENCE: Unit =
    Unit { display: &[DisplayUnit { offset: 0.0, ..DEG_C }], is_relative: true, ..KELVIN };

macro_rules! units {
    ($($(#[$doc:meta])* $id:ident = $name:literal, $base:expr, $display:expr;)*) => {
        $($(#[$doc])* pub const $id: Unit =
            Unit { name: $name, base: $base, display: &$display, is_relative: false };)*
        /// All units of the interface, except for units of differences, which share the names of other units.
        pub const ALL: &[Unit] = &[$($id),*];
    };
}

/// Lowest and highest temperature allowed for oil, gears and clutches [K]: −60 and 400 °C.
pub const TEMPERATURES: Range = Range { min: 213.15, max: 673.15 };

units! {
    /// Dimensionless.
    ONE = "1", base(0, 0, 0, 0), [];
    /// Length.
    METRE = "m", base(0, 1, 0, 0), [MM, UM];
    /// Angle.
    RADIAN = "rad", base(0, 0, 0, 1), [DEG];
    /// Angular speed.
    RAD_PER_S = "rad/s", base(0, 0, -1, 1), [DEG_PER_S, RPM];
    /// Angular acceleration.
    RAD_PER_S2 = "rad/s2", base(0, 0, -2, 1), [];
    /// Pressure, modulus.
    PASCAL = "Pa", base(1, -1, -2, 0), [MPA];
    /// Mass.
    KILOGRAM = "kg", base(1, 0, 0, 0), [];
    /// Density.
    KG_PER_M3 = "kg/m3", base(1, -3, 0, 0), [];
    /// Moment of inertia.
    KG_M2 = "kg.m2", base(1, 2, 0, 0), [];
    /// Contact stiffness K of F = K d^1.5.
    N_PER_M15 = "N/m^1.5", None, [N_PER_MM15];
    /// Translational damping.
    NS_PER_M = "N.s/m", base(1, 0, -1, 0), [NS_PER_MM];
    /// Force.
    NEWTON = "N", base(1, 1, -2, 0), [KN];
    /// Torque.
    NEWTON_METRE = "N.m", base(1, 2, -2, 0), [KNM];
    /// Frequency.
    HERTZ = "Hz", base(0, 0, -1, 0), [];
    /// Power.
    WATT = "W", base(1, 2, -3, 0), [];
    /// Energy.
    JOULE = "J", base(1, 2, -2, 0), [];
    /// Time.
    SECOND = "s", base(0, 0, 1, 0), [];
    /// Speed.
    M_PER_S = "m/s", base(0, 1, -1, 0), [KM_PER_H];
    /// Relative change per speed.
    S_PER_METRE = "s/m", base(0, -1, 1, 0), [];
    /// Acceleration.
    M_PER_S2 = "m/s2", base(0, 1, -2, 0), [];
    /// Line load, and linear stiffness.
    N_PER_M = "N/m", base(1, 0, -2, 0), [N_PER_MM, N_PER_UM];
    /// Stiffness per face width.
    N_PER_M2 = "N/m2", base(1, -1, -2, 0), [N_PER_MM_UM];
    /// Torsional stiffness.
    NM_PER_RAD = "N.m/rad", base(1, 2, -2, -1), [];
    /// Torsional damping.
    NMS_PER_RAD = "N.m.s/rad", base(1, 2, -1, -1), [];
    /// Torque per square of angular speed.
    NMS2_PER_RAD2 = "N.m.s2/rad2", base(1, 2, 0, -2), [];
    /// Temperature.
    KELVIN = "K", Some(Base { kg: 0, m: 0, s: 0, rad: 0, k: 1 }), [DEG_C];
    /// Change of density per temperature.
    KG_PER_M3_K = "kg/(m3.K)", per_kelvin(1, -3, 0, 0), [];
    /// Kinematic viscosity.
    M2_PER_S = "m2/s", base(0, 2, -1, 0), [MM2_PER_S];
    /// Heat capacity.
    JOULE_PER_K = "J/K", per_kelvin(1, 2, -2, 0), [];
    /// Specific heat.
    JOULE_PER_KG_K = "J/(kg.K)", per_kelvin(0, 2, -2, 0), [];
    /// Thermal contact coefficient.
    EFFUSIVITY = "W.s^0.5/(m2.K)", None, [];
    /// Thermal conductance.
    WATT_PER_K = "W/K", per_kelvin(1, 2, -3, 0), [];
    /// Thermal conductance per angular speed.
    WATT_S_PER_K_RAD = "W.s/(K.rad)", per_kelvin(1, 2, -2, -1), [];
    /// Area.
    SQUARE_METRE = "m2", base(0, 2, 0, 0), [CM2];
    /// Power per area; pressure times speed.
    W_PER_M2 = "W/m2", base(1, 0, -3, 0), [W_PER_MM2];
    /// Dynamic viscosity.
    PA_S = "Pa.s", base(1, -1, -1, 0), [MILLI_PA_S];
}

//! Tooth friction: coefficient from sliding speed, rolling speed and load of a contact, signed and smooth. Each law has
//! its own file. The resulting forces belong to `contact`.
//!
//! The magnitude of the sliding speed enters every law as v_m = √(v² + v_ε²), and the sign as v/v_m. The signed
//! coefficient
//!
//! ```text
//! h(v) = μ(v_m) · v / v_m
//! ```
//!
//! is odd and has all derivatives through v = 0, with the slope μ(v_ε)/v_ε at zero. No law is evaluated at its
//! singularity at zero sliding. The root is preferred to tanh(v/v_ε) because it needs no exponential and applies to law
//! and sign at the same time. It differs from Coulomb's step by only (v_ε/v)²/2, which is 5e-5 at a hundred v_ε. It
//! does not stick: a loaded flank creeps at v_ε times the used fraction of the friction limit.
//!
//! Loads, radii and speeds far outside the range of gears are limited (see [`smooth`]), so that the coefficient is
//! finite and within ±[`LARGEST`] for all finite arguments. [`outside`] reports arguments outside a law's published
//! range.

pub mod benedict_kelley;
mod conditions;
pub mod coulomb;
pub mod iso14179;
mod range;
mod signed;
pub mod smooth;
mod spec;
pub mod xu_kahraman;

pub use conditions::Conditions;
pub use range::Outside;
pub use signed::{outside, signed_coefficient};
pub use spec::{FrictionLaw, LARGEST, ToothFrictionSpec};

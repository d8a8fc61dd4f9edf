//! Tooth friction: coefficient from sliding speed, rolling speed and load of a contact, signed and smooth. One law a file;
//! the forces that follow from it belong to `contact`.
//!
//! The magnitude of the sliding speed enters every law as v_m = √(v² + v_ε²), and the sign as v/v_m. So the signed
//! coefficient
//!
//! ```text
//! h(v) = μ(v_m) · v / v_m
//! ```
//!
//! is odd and has all derivatives through v = 0, with the slope μ(v_ε)/v_ε there, and no law is
//! evaluated at its singularity at zero sliding. The root is preferred to tanh(v/v_ε): it needs no exponential, applies to
//! law and sign at once, and differs from Coulomb's step by (v_ε/v)²/2 only, 5e-5 at a hundred v_ε. It does not stick: a
//! flank under load creeps at v_ε times the fraction of the friction limit that it carries.
//!
//! Loads, radii and speeds far outside the range of gears are limited (see [`smooth`]), so that the coefficient is finite
//! and lies within ±[`LARGEST`] for all finite arguments. [`outside`] reports arguments outside a law's published range.

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

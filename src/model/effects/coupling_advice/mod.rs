//! Advice to the host of a co-simulation: the energy that the cut between host and unit creates or destroys, and the
//! communication step at which this energy is a wanted fraction of the transmitted energy.
//!
//! The host sets a value u at communication points: a torque at a port driven by torque, a speed at a side driven by
//! speed. Over step n, the port moves by x: the angle Δφ, or the angular impulse ∫T dt. The unit exchanges ū x, with
//! the mean ū of its input. The host's law would exchange M x. If the host answers without delay, M is the mean of
//! u at both ends of the step. If it answers `host_delay` steps later, the same law gives
//!
//! M = u(n + ½ + `host_delay`),
//!
//! with u linear between its values at whole numbers. The cut creates the energy (M − ū) x at a load that resists, and
//! (ū − M) x at the carrier. `port` evaluates one port, `regression` shows if its host reacts, `swing` shows if its torque
//! grows from period to period, `memory` is the time over which sums decay, and `record` contains all ports.

mod memory;
mod port;
mod record;
mod regression;
mod spec;
mod swing;

pub use port::{PortStep, Shaft};
pub use record::{Coupling, Cut, Growth, PORTS};
pub use spec::{AdviceState, CouplingAdviceSpec};

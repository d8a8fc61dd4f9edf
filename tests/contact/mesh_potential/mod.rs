//! The mesh's force is the gradient of its energy, its Jacobian that of its force, and damping only ever dissipates.
//!
//! First for IMPACT, then for the other laws, whose energy also depends on the place of a pair on the path. The references
//! are central differences of the program's own energy and force; each comparison states their error.

mod damping;
mod gradient;
mod setup;
mod symmetry;

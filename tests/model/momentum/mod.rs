//! Forces of the teeth in space, and the angular momentum about the axle: what changes it, and how fast.

mod centrifugal;
mod forces;
mod rate;
mod scenes;

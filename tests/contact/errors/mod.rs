//! Errors of teeth.

mod chip;
mod gaps;
mod individual;
mod spec;

//! Tests of the integrator on problems with known solutions: one suite, run with every method.

mod accuracy;
mod continuation;
mod curve;
mod dense_output;
mod driven;
mod follow;
mod identical_bodies;
mod impact;
mod kahraman_singh;
mod methods;
mod numeric;
mod order;
mod problems;
mod rest;
mod stability;
mod switches;

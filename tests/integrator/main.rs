//! The integrator on problems whose solutions are known: one suite, run with every method.

mod accuracy;
mod alike;
mod continuation;
mod curve;
mod driven;
mod going_on;
mod impact;
mod kahraman_singh;
mod methods;
mod numeric;
mod order;
mod problems;
mod rest;
mod stability;
mod switches;

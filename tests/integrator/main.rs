//! The integrator on problems whose solutions are known: one suite, run with every method.

mod accuracy;
mod alike;
mod continuation;
mod driven;
mod going_on;
mod impact;
mod kahraman_singh;
mod methods;
mod order;
mod problems;
mod stability;
mod switches;

//! The equations of motion behind C functions, so that solvers written by others integrate them with nothing but compiled
//! code in their loops: plain right-hand side, CVODE's callbacks, and this program's own methods for comparison.
//!
//! Solvers see u = y / magnitude with y = (q, v), so that one absolute tolerance means the same for every component.
//! No run switches its equations, as none of the cases has dry friction. Runs are autonomous except driven ones.
//!
//! Functions take a run by a pointer that `foreign_new` returned. A panic ends the program; none unwinds into C.

mod calls;
mod cvode;
mod run;

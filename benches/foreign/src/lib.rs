//! Equations of motion as C functions, so that solvers by other authors can integrate them with only compiled code in
//! their loops. The functions are the plain right-hand side, CVODE's callbacks, and this program's own methods for
//! comparison.
//!
//! Solvers get u = y / magnitude with y = (q, v), so that one absolute tolerance has the same meaning for every
//! component. No run switches its equations, because none of the cases has dry friction. Runs are autonomous, except
//! for driven ones.
//!
//! Functions take a pointer to a run from `foreign_new`. A panic ends the program and never unwinds into C.

mod calls;
mod cvode;
mod run;

//! The C interface of FMI 3.0.

mod sources;

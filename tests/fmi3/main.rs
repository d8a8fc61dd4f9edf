//! Tests of the C interface of FMI 3.0.

mod input_ramp;

//! All methods with their theoretical properties, and generic runs.

use bevel_differential::integrate::{
    Control, ErrorNorm, Extension, Failure, Method, Point, Radau, Rodas5P, SecondOrder, SolverContext, Statistics,
    StepOutput, TimedPoint,
};

use super::follow::{AfterStep, advance};

/// Theoretical properties of a method.
pub trait Known: Method {
    const METHOD: Self;
    /// Order of the solution.
    const ORDER: u32;
    /// Order of the continuous extension.
    const EXTENSION: u32;
    /// Tolerance for single steps. It must not reject a step for its error, but must be so small that iterations within
    /// a step do not contribute to the error.
    const TOLERANCE: f64 = 1e6;
    /// Order k of the error h^k/λ under smooth forcing much stiffer than the step.
    const FORCED: u32;
}

impl Known for Rodas5P {
    const METHOD: Self = Rodas5P;
    const ORDER: u32 = 5;
    const EXTENSION: u32 = 4;
    const FORCED: u32 = 3;
}

impl Known for Radau {
    const METHOD: Self = Radau;
    const ORDER: u32 = 5;
    const EXTENSION: u32 = 3;
    const TOLERANCE: f64 = 1e-11;
    const FORCED: u32 = 3;
}

/// Runs generic tests with every method.
macro_rules! with_every_method {
    ($($test:ident)*) => {
        $(mod $test {
            #[test]
            #[allow(non_snake_case)]
            fn Rodas5P() {
                super::$test::<bevel_differential::integrate::Rodas5P>();
            }
            #[test]
            #[allow(non_snake_case)]
            fn Radau() {
                super::$test::<bevel_differential::integrate::Radau>();
            }
        })*
    };
}
pub(crate) use with_every_method;

/// A step: its dense output, and the estimate of the error at its end.
pub struct Tried<const N: usize> {
    pub extension: Extension<N>,
    pub error: Point<N>,
}

/// Takes one step of size `h`.
pub fn step<M: Known, const N: usize, S: SecondOrder<N>>(s: &S, at: &Point<N>, h: f64) -> Tried<N> {
    step_from::<M, N, S>(s, (at, 0.0), h)
}

/// Takes one step of size `h` of a driven system from `time`.
pub fn step_from<M: Known, const N: usize, S: SecondOrder<N>>(s: &S, (at, time): (&Point<N>, f64), h: f64) -> Tried<N> {
    let lin = s.linearise_at(at, time);
    let norm = ErrorNorm { weights: s.weights(at), tolerance: M::TOLERANCE };
    let mut extension = Extension::NONE;
    let to = StepOutput { counts: &mut Statistics::default(), extension: &mut extension };
    let error = M::METHOD.step(s, TimedPoint { point: at, time }, &lin, h, &norm, to).unwrap().error;
    Tried { extension, error }
}

/// Takes `count` equal steps over `length`.
pub fn fixed<M: Known, const N: usize, S: SecondOrder<N>>(
    s: &S,
    mut at: Point<N>,
    length: f64,
    count: u32,
) -> Point<N> {
    for _ in 0..count {
        at = step::<M, N, S>(s, &at, length / f64::from(count)).extension.end;
    }
    at
}

/// Takes adaptive steps up to `until`.
pub fn run<M: Known, const N: usize, S: SecondOrder<N>>(
    s: &S,
    point: &mut Point<N>,
    until: f64,
    tolerance: f64,
) -> Result<Statistics, Failure> {
    let (mut time, mut control, mut statistics) = (0.0, Control::new(1e-6), Statistics::default());
    let mut budget = 1_000_000;
    let context = SolverContext { tolerance, control: &mut control, statistics: &mut statistics, budget: &mut budget };
    advance(&M::METHOD, s, point, &mut time, until, context, |_| AfterStep::Continue)?;
    Ok(statistics)
}

//! Methods of variable steps, chosen at run time: where equations are large, the loop of steps is compiled once for all of them.

use super::{
    DormandPrince, ErrorNorm, Extension, Linearisation, Method, Point, Radau, Rodas4, Rodas5P, SecondOrder, Statistics,
    Trial,
};

/// A method of variable steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyMethod {
    /// [`Rodas5P`], the default.
    Rodas5P,
    /// [`Radau`].
    Radau,
    /// [`Rodas4`].
    Rodas4,
    /// [`DormandPrince`].
    DormandPrince,
}

impl Method for AnyMethod {
    fn estimate(&self) -> u32 {
        match self {
            Self::Rodas5P => Rodas5P.estimate(),
            Self::Radau => Radau.estimate(),
            Self::Rodas4 => Rodas4.estimate(),
            Self::DormandPrince => DormandPrince.estimate(),
        }
    }

    fn is_implicit(&self) -> bool {
        *self != Self::DormandPrince
    }

    fn step<const N: usize, S: SecondOrder<N> + ?Sized>(
        &self,
        system: &S,
        start: (&Point<N>, f64),
        lin: &Linearisation<N, S::Rates>,
        h: f64,
        norm: &ErrorNorm<N>,
        to: (&mut Statistics, &mut Extension<N>),
    ) -> Option<Trial<N, S::Rates>> {
        match self {
            Self::Rodas5P => Rodas5P.step(system, start, lin, h, norm, to),
            Self::Radau => Radau.step(system, start, lin, h, norm, to),
            Self::Rodas4 => Rodas4.step(system, start, lin, h, norm, to),
            Self::DormandPrince => DormandPrince.step(system, start, lin, h, norm, to),
        }
    }
}

//! Check that all numbers of a value are finite. Structs list all their fields, so that none can be forgotten.

/// Largest magnitude: the product of two such numbers is finite.
const LARGEST: f64 = 1e150;

/// A value whose numbers can be checked.
pub trait Finite {
    /// True if all numbers are finite, and so small that their products are finite too.
    fn is_finite(&self) -> bool;
}

impl Finite for f64 {
    fn is_finite(&self) -> bool {
        self.abs() <= LARGEST
    }
}

impl<T: Finite, const N: usize> Finite for [T; N] {
    fn is_finite(&self) -> bool {
        self.iter().all(Finite::is_finite)
    }
}

impl<T: Finite> Finite for Option<T> {
    fn is_finite(&self) -> bool {
        self.as_ref().is_none_or(Finite::is_finite)
    }
}

impl<T: Finite, U: Finite> Finite for (T, U) {
    fn is_finite(&self) -> bool {
        self.0.is_finite() && self.1.is_finite()
    }
}

/// Implements [`Finite`] for structs. Fields with real numbers come first; all others follow after a semicolon.
/// Compilation fails if a field is missing.
macro_rules! finite {
    ($($struct:ty { $($field:ident),+ $(; $($other:ident),+)? })+) => {$(
        impl $crate::numeric::Finite for $struct {
            fn is_finite(&self) -> bool {
                let Self { $($field,)+ $($($other: _,)+)? } = self;
                $($crate::numeric::Finite::is_finite($field))&&+
            }
        }
    )+};
}

pub(crate) use finite;

#[cfg(test)]
mod tests {
    use super::Finite;

    struct Inner {
        number: f64,
        count: u32,
    }

    struct Outer {
        array: [Inner; 2],
        option: Option<(f64, [f64; 2])>,
    }

    finite! {
        Inner { number; count }
        Outer { array, option }
    }

    #[test]
    fn a_number_that_is_not_finite_is_found_wherever_it_is() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e200, -1e200] {
            for index in 0..6 {
                let at = |k: usize| if k == index { bad } else { 1.0 };
                let inner = |k: usize| Inner { number: at(k), count: 1 };
                let outer = Outer { array: [inner(0), inner(1)], option: Some((at(2), [at(3), at(4)])) };
                assert_eq!(outer.is_finite(), index == 5, "{bad} at {index}, {}", outer.array[0].count);
            }
        }
        assert!(Outer { array: [0.0, 1.0].map(|number| Inner { number, count: 0 }), option: None }.is_finite());
    }
}

//! Numbers at random, the same for the same seed on every machine, and values as careless hosts hand them over.

use bevel_differential::variables::{Access, Variable, real_start};

/// Generator SplitMix64 of Steele, Lea and Flood (2014): any seed will do, neighbouring ones too.
pub struct Random(u64);

impl Random {
    /// The sequence of `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Any 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let a = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let b = (a ^ (a >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        b ^ (b >> 31)
    }

    /// From 0 to `n` - 1; 0 if `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        if n == 0 { 0 } else { (self.bits() >> 11) as usize % n }
    }

    /// True once in `n`.
    pub fn chance(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// One of `from`, which is not empty.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// From 0 to 1.
    pub fn fraction(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Any number, often one that hurts.
    pub fn real(&mut self) -> f64 {
        let any = f64::from_bits(self.bits());
        let near = (self.below(2001) as f64 - 1000.0) * 10f64.powi(self.below(9) as i32 - 6);
        let hard = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, 5e-324, f64::MAX, -1e300];
        let hard = self.pick(&hard);
        self.pick(&[near, near, near, any, hard])
    }

    /// A value for a real variable: mostly near its start value, now and then from its range, or any.
    pub fn value_for(&mut self, row: &Variable) -> f64 {
        let start = real_start(row).unwrap_or(0.0);
        match (self.below(8), row.range) {
            (0, _) => self.real(),
            (1, Some(range)) => range.min + self.fraction() * (range.max - range.min),
            (2, Some(range)) => self.pick(&[range.min, range.max]),
            _ => start * (0.8 + 0.4 * self.fraction()),
        }
    }

    /// A value for an integer, a choice or a switch: mostly one that exists.
    pub fn integer_for(&mut self, row: &Variable) -> i32 {
        if self.chance(8) {
            return self.bits() as i32;
        }
        match (row.access, row.range) {
            (Access::Enumeration(kind, ..), _) => self.below(kind.choices.len() + 1) as i32 + 1,
            (Access::Boolean(_), _) => self.below(2) as i32,
            (_, Some(range)) => (range.min + self.fraction() * (range.max.min(24.0) - range.min)).round() as i32,
            _ => self.below(20) as i32,
        }
    }
}

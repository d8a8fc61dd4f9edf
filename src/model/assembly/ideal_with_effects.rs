//! Constants of the ideal differential with effects on bodies.
//!
//! All speeds follow from the speeds that Willis' equation leaves free: v = P u with u = (ω_c, ψ̇, ends). Some of u are
//! imposed (u_c), the others are free (u_f); P_c and P_f are their columns of P. Forces Q and imposed accelerations
//! u̇_c give u̇_f = (P_fᵀ M P_f)⁻¹ P_fᵀ (Q − M P_c u̇_c), so v̇ = W Q + f u̇_c with constant W = P_f (P_fᵀ M P_f)⁻¹
//! P_fᵀ and f = (1 − W M) P_c.

use super::{BodyEffects, Ideal};
use crate::integrate::{Matrix, size_for};
use crate::model::effect_kinds::{BodyMotion, Slopes};
use crate::model::scene::layout::LEFT;
use crate::model::scene::{ATTACHED_COUNT, CARRIER, Dogs, ENDS, Inputs, Layout, PLANET, Plan};
use crate::numeric::lanes;

/// Size of vectors and matrices for side gears, carrier, planets in one group, and attached bodies.
pub const IDEAL_SIZE: usize = size_for(PLANET + 1 + ATTACHED_COUNT);

/// Size of vectors and matrices of steps if no bodies other than half-shaft ends are attached.
pub const SHAFTS_SIZE: usize = size_for(PLANET + 1 + ENDS);

/// Number of motions that may be imposed: drive, spin, left and right end.
pub const IMPOSED: usize = 4;

/// Constants of a scene whose forces are linear, because only half-shafts act.
#[derive(Clone, Copy, Debug)]
pub struct Linear {
    /// Index of the half-shafts' heat in the ledger.
    pub heat_index: usize,
    /// Derivatives of the accelerations with respect to positions.
    pub by_position: Matrix<IDEAL_SIZE>,
    /// Derivatives of the accelerations with respect to velocities.
    pub by_velocity: Matrix<IDEAL_SIZE>,
}

/// Constants of an ideal differential with effects.
#[derive(Clone, Debug)]
pub struct IdealWithEffects {
    /// Scene plan.
    pub plan: Plan,
    /// Index of each degree of freedom.
    pub layout: Layout,
    /// Degrees of freedom of attached bodies other than half-shaft ends, and of the bodies relative to which they turn.
    pub others: Vec<(usize, usize)>,
    /// Inertia by degree of freedom, summed over all planets [kg·m²].
    pub inertia: [f64; IDEAL_SIZE],
    /// Inertias of ends that are rigid on their side gears [kg·m²].
    pub rigid_end: [f64; 2],
    /// r = z_p/z_s.
    pub ratio: f64,
    /// Columns of W, which gives accelerations from forces.
    pub mobility: [[f64; IDEAL_SIZE]; IDEAL_SIZE],
    /// Columns of f for the drive, the spin and both ends; zero if the motion is not imposed.
    pub follow: [[f64; IDEAL_SIZE]; IMPOSED],
    /// Constants of a scene in which only half-shafts act, apart from dry friction.
    pub linear: Option<Box<Linear>>,
    /// True if any motion is imposed.
    pub is_imposed: bool,
    /// Effects on bodies.
    pub body_effects: BodyEffects,
}

impl IdealWithEffects {
    /// Constants of the scene.
    pub fn new(ideal: &Ideal, body_effects: BodyEffects) -> Self {
        let plan = ideal.plan;
        let layout = plan.layout();
        let (by_freedom, rigid_end) = ideal.inertia.by_freedom(&plan);
        let mut inertia: [f64; IDEAL_SIZE] = std::array::from_fn(|i| by_freedom[i]);
        inertia[PLANET] = ideal.inertia.planets * ideal.inertia.planet;
        let n = layout.count();
        let r = ideal.ratio;
        // columns of P
        let (mut carrier, mut spin) = ([0.0; IDEAL_SIZE], [0.0; IDEAL_SIZE]);
        carrier[..=CARRIER].fill(1.0);
        (spin[LEFT], spin[LEFT + 1], spin[PLANET]) = (r, -r, 1.0);
        let mut columns = vec![carrier, spin];
        columns.extend((0..ATTACHED_COUNT).map(|k| std::array::from_fn(|i| f64::from(plan.attached(k) == Some(i)))));
        // the column of an attached body has a single one, at its degree of freedom
        let of_port = columns.iter().skip(2).position(|column| column[layout.port] != 0.0).map_or(0, |k| 2 + k);
        let imposed = [plan.drive_imposed, plan.spin_imposed, plan.side_imposed[0], plan.side_imposed[1]];
        let imposed: [Option<usize>; IMPOSED] = std::array::from_fn(|k| imposed[k].then_some([of_port, 1, 2, 3][k]));
        let is_free =
            |k: usize, column: &[f64; IDEAL_SIZE]| !imposed.contains(&Some(k)) && *column != [0.0; IDEAL_SIZE];
        let free: Vec<[f64; IDEAL_SIZE]> =
            columns.iter().enumerate().filter(|&(k, column)| is_free(k, column)).map(|(_, column)| *column).collect();
        let p = nalgebra::DMatrix::from_fn(n, free.len(), |i, j| free[j][i]);
        let m = nalgebra::DMatrix::from_fn(n, n, |i, j| if i == j { inertia[i] } else { 0.0 });
        // inertias are positive, so the reduced matrix has an inverse
        let reduced = (p.transpose() * &m * &p).try_inverse();
        let w = reduced.map_or_else(|| nalgebra::DMatrix::zeros(n, n), |inverse| &p * inverse * p.transpose());
        let c = nalgebra::DMatrix::from_fn(n, IMPOSED, |i, k| imposed[k].map_or(0.0, |column| columns[column][i]));
        let follow = &c - &w * &m * &c;
        let mut this = Self {
            plan,
            layout,
            others: layout.attached().skip(if layout.has_ends() { ENDS } else { 0 }).collect(),
            inertia,
            rigid_end,
            ratio: r,
            mobility: [[0.0; IDEAL_SIZE]; IDEAL_SIZE],
            follow: [[0.0; IDEAL_SIZE]; IMPOSED],
            linear: None,
            is_imposed: imposed.iter().any(Option::is_some),
            body_effects,
        };
        for i in 0..n {
            for k in 0..IMPOSED {
                this.follow[k][i] = follow[(i, k)];
            }
            for j in 0..n {
                this.mobility[j][i] = w[(i, j)];
            }
        }
        // ideal gears have no pins, so without other attached bodies the springs are half-shafts
        if let [effect] = &this.body_effects.forces[..]
            && this.others.is_empty()
            && let Some(heat_index) = effect.heat_of_springs()
        {
            this.linear = Some(Box::new(this.with_half_shafts(heat_index)));
        }
        this
    }

    /// Constants of the scene if only half-shafts act, with the index of their heat.
    fn with_half_shafts(&self, heat_index: usize) -> Linear {
        let (mut by_position, mut by_velocity) = ([[0.0; IDEAL_SIZE]; IDEAL_SIZE], [[0.0; IDEAL_SIZE]; IDEAL_SIZE]);
        let mut slopes = Slopes::new([&mut by_position, &mut by_velocity]);
        let motion = BodyMotion {
            q: &[0.0; IDEAL_SIZE],
            v: &[0.0; IDEAL_SIZE],
            layout: &self.layout,
            inputs: &Inputs::ZERO,
            input_rates: &Inputs::ZERO,
            dogs: &Dogs::default(),
            oil_viscosity: None,
        };
        self.body_effects.forces.iter().for_each(|effect| effect.slopes(&motion, &mut slopes));
        let [by_position, by_velocity] = [by_position, by_velocity].map(|forces| {
            let mut product = [[0.0; IDEAL_SIZE]; IDEAL_SIZE];
            self.accelerations_by(&forces, &mut product);
            product
        });
        Linear { heat_index, by_position, by_velocity }
    }

    /// Writes the derivatives of the accelerations to `product`, from the derivatives of the forces.
    pub fn accelerations_by<const N: usize>(&self, forces: &Matrix<N>, product: &mut Matrix<N>) {
        for (i, row) in product.iter_mut().enumerate() {
            let mut sum = [0.0; N];
            for (k, force) in forces.iter().enumerate() {
                lanes::add_times(&mut sum, self.mobility[k][i], force);
            }
            *row = sum;
        }
    }
}

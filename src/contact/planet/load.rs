//! Loads of a mesh of any kind, in the form that the equations of motion need.

use super::{COORDINATES, Q, W, X};
use crate::contact::detailed::{DetailedLoad, LOCAL, WITH_OTHER};
use crate::contact::mesh::{MeshForce, MeshJacobian};
use crate::numeric::{Dual, Scalar};

/// A block of derivatives of a mesh's forces with respect to its coordinates.
pub type Block = [[f64; COORDINATES]; COORDINATES];

/// Loads that press the gears on their seats, where they rub [N].
#[derive(Clone, Copy, Debug, Default)]
pub struct Pressing {
    /// Load along the planet's axis, away from the apex.
    pub planet_axial: f64,
    /// Load along the side gear's axis, away from the apex.
    pub side_axial: f64,
    /// Load on the side gear along the carrier's direction of rotation.
    pub tangential: f64,
}

/// Derivatives of [`Pressing`] with respect to the coordinates of the mesh, their rates, and the coordinates of the
/// planet's other mesh.
#[derive(Clone, Copy, Debug)]
pub struct PressingSlopes {
    /// Derivatives of [`Pressing::planet_axial`].
    pub planet_axial: [f64; WITH_OTHER],
    /// Derivatives of [`Pressing::side_axial`].
    pub side_axial: [f64; WITH_OTHER],
    /// Derivatives of [`Pressing::tangential`].
    pub tangential: [f64; WITH_OTHER],
    /// Derivatives of the force along q.
    pub force: [f64; WITH_OTHER],
}

impl PressingSlopes {
    const NONE: Self = {
        let none = [0.0; WITH_OTHER];
        Self { planet_axial: none, side_axial: none, tangential: none, force: none }
    };
}

/// Load of a mesh.
pub trait MeshLoad: Copy {
    /// True if the kind of contact computes the loads that press the gears on their seats.
    const PRESSES: bool;
    /// No load.
    fn none() -> Self;
    /// Forces along the coordinates.
    fn force(&self) -> [f64; COORDINATES];
    /// Heat of contact damping and of tooth friction [W].
    fn heat(&self) -> [f64; 2];
    /// Loads that press the gears on their seats.
    fn pressing(&self) -> Pressing {
        Pressing::default()
    }
}

/// Load of a mesh with its derivatives.
pub trait LinearisedLoad: MeshLoad {
    /// True if a mesh depends on the coordinates of the planet's other mesh.
    const COUPLED: bool;
    /// Elastic energy [J].
    fn energy(&self) -> f64;
    /// ∂force/∂coordinates.
    fn by_position(&self) -> Block;
    /// ∂force/∂(rates of the coordinates).
    fn by_rate(&self) -> Block;
    /// ∂force/∂(coordinates of the planet's other mesh).
    fn by_other(&self) -> Block {
        [[0.0; COORDINATES]; COORDINATES]
    }
    /// Derivatives of the loads that press the gears on their seats.
    fn pressing_slopes(&self) -> PressingSlopes {
        PressingSlopes::NONE
    }
}

/// Derivatives of a mesh whose side gear has no axial displacement.
#[inline(always)]
pub fn without_displacement(&[[qq, qx], [xq, xx]]: &[[f64; 2]; 2]) -> Block {
    [[qq, qx, 0.0], [xq, xx, 0.0], [0.0; COORDINATES]]
}

impl MeshLoad for MeshForce {
    const PRESSES: bool = false;
    #[inline(always)]
    fn none() -> Self {
        Self::default()
    }
    #[inline(always)]
    fn force(&self) -> [f64; COORDINATES] {
        [self.force[Q], self.force[X], 0.0]
    }
    #[inline(always)]
    fn heat(&self) -> [f64; 2] {
        [self.heat, 0.0]
    }
}

/// Load of flanks that fit, with its derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub struct LinearisedForce {
    /// Forces.
    pub force: MeshForce,
    /// Derivatives and energy.
    pub by: MeshJacobian,
}

impl MeshLoad for LinearisedForce {
    const PRESSES: bool = false;
    #[inline(always)]
    fn none() -> Self {
        Self::default()
    }
    #[inline(always)]
    fn force(&self) -> [f64; COORDINATES] {
        self.force.force()
    }
    #[inline(always)]
    fn heat(&self) -> [f64; 2] {
        self.force.heat()
    }
}

impl LinearisedLoad for LinearisedForce {
    const COUPLED: bool = false;
    #[inline(always)]
    fn energy(&self) -> f64 {
        self.by.energy
    }
    #[inline(always)]
    fn by_position(&self) -> Block {
        without_displacement(&self.by.by_position)
    }
    #[inline(always)]
    fn by_rate(&self) -> Block {
        without_displacement(&self.by.by_rate)
    }
}

/// Numbers with derivatives with respect to the variables of one mesh or of both meshes.
pub trait Slopes: Scalar {
    /// True for numbers with derivatives with respect to the coordinates of the planet's other mesh.
    const COUPLED: bool;
    /// All derivatives.
    fn slopes(&self) -> [f64; WITH_OTHER];
}

impl Slopes for Dual<LOCAL> {
    const COUPLED: bool = false;
    #[inline(always)]
    fn slopes(&self) -> [f64; WITH_OTHER] {
        let [q, x, w, dq, dx, dw] = self.d;
        [q, x, w, dq, dx, dw, 0.0, 0.0, 0.0]
    }
}

impl Slopes for Dual<WITH_OTHER> {
    const COUPLED: bool = true;
    #[inline(always)]
    fn slopes(&self) -> [f64; WITH_OTHER] {
        self.d
    }
}

impl<T: Scalar> MeshLoad for DetailedLoad<T> {
    const PRESSES: bool = true;
    #[inline(always)]
    fn none() -> Self {
        Self::zero()
    }
    #[inline(always)]
    fn force(&self) -> [f64; COORDINATES] {
        [self.force[Q].value(), self.force[X].value(), self.force[W].value()]
    }
    #[inline(always)]
    fn heat(&self) -> [f64; 2] {
        self.heat
    }
    #[inline(always)]
    fn pressing(&self) -> Pressing {
        Pressing {
            planet_axial: self.planet_axial.value(),
            side_axial: self.side_axial.value(),
            tangential: self.tangential.value(),
        }
    }
}

/// Block of the derivatives of the forces that starts at variable `part`.
#[inline(always)]
fn block<T: Slopes>(force: &[T; 3], part: usize) -> Block {
    force.map(|force| {
        let slopes = force.slopes();
        [slopes[part], slopes[part + 1], slopes[part + 2]]
    })
}

impl<T: Slopes> LinearisedLoad for DetailedLoad<T> {
    const COUPLED: bool = T::COUPLED;
    #[inline(always)]
    fn energy(&self) -> f64 {
        self.energy
    }
    #[inline(always)]
    fn by_position(&self) -> Block {
        block(&self.force, 0)
    }
    #[inline(always)]
    fn by_rate(&self) -> Block {
        block(&self.force, COORDINATES)
    }
    #[inline(always)]
    fn by_other(&self) -> Block {
        block(&self.force, LOCAL)
    }
    #[inline(always)]
    fn pressing_slopes(&self) -> PressingSlopes {
        PressingSlopes {
            planet_axial: self.planet_axial.slopes(),
            side_axial: self.side_axial.slopes(),
            tangential: self.tangential.slopes(),
            force: self.force[Q].slopes(),
        }
    }
}

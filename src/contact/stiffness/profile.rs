//! Half of a tooth's profile in pieces, from the root circle up: fillet, radial line, involute.
//!
//! The tooth is centred on the y axis, and the gear's axis is the origin. Each piece returns half the chord x and the
//! height y of a point, and dy/du. The parameter u of a piece is chosen so that the piece is smooth and y rises
//! strictly.

use crate::numeric::{sin_cos, sqrt};

/// A point of the profile.
#[derive(Clone, Copy, Debug)]
pub struct ProfilePoint {
    /// Half the chord x [m].
    pub half_chord: f64,
    /// Height y above the gear's axis [m].
    pub height: f64,
    /// dy/du [m per unit of u].
    pub rise: f64,
}

/// A smooth piece of the profile.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    /// Fillet arc about (x, y) with a radius; u is the angle φ of (x − ρ cosφ, y + ρ sinφ).
    Arc {
        /// Centre x [m].
        x: f64,
        /// Centre y [m].
        y: f64,
        /// Radius ρ [m].
        radius: f64,
    },
    /// Fillet cut by the rounded tip of a rack. u = x_c is the distance that the rack has rolled past the position at
    /// which the rounding's centre, the instant centre and the axis are in line.
    Trochoid {
        /// Reference radius r [m].
        pitch: f64,
        /// Distance H from the reference circle to the centre of the rack's tip rounding [m].
        depth: f64,
        /// Tip radius ρ of the rack [m].
        radius: f64,
        /// Distance E_c from the middle of the tooth space to the rounding's centre [m].
        offset: f64,
        /// Half pitch angle π/z [rad].
        half_pitch: f64,
    },
    /// Radial line below the base circle; u = y.
    Radial {
        /// Slope x/y.
        slope: f64,
    },
    /// Involute; u is the roll length ρ, the distance to the point at which the normal touches the base circle.
    Involute {
        /// Base radius r_b [m].
        base: f64,
        /// Half tooth angle γ_b at the base circle [rad].
        angle: f64,
    },
}

impl Piece {
    /// Point at parameter `u`.
    pub fn at(&self, u: f64) -> ProfilePoint {
        match *self {
            Self::Arc { x, y, radius } => {
                let (s, c) = sin_cos(u);
                ProfilePoint { half_chord: x - radius * c, height: y + radius * s, rise: radius * c }
            }
            Self::Trochoid { pitch, depth, radius, offset, half_pitch } => {
                // (p, q): point of the rounding on the normal through the instant centre. A counter-clockwise rotation
                // by a = (x_c − E_c)/r gives the frame of the gap. Reflection at half a pitch then gives the frame of
                // the tooth.
                let reach = sqrt(u * u + depth * depth);
                let (k, dk) = (1.0 + radius / reach, -radius * u / (reach * reach * reach));
                let (p, q) = (u * k, pitch - depth * k);
                let (dp, dq) = (k + u * dk, -depth * dk);
                let turn = half_pitch + (u - offset) / pitch;
                let (s, c) = sin_cos(turn);
                let half_chord = q * s - p * c;
                ProfilePoint { half_chord, height: q * c + p * s, rise: dq * c + dp * s - half_chord / pitch }
            }
            Self::Radial { slope } => ProfilePoint { half_chord: slope * u, height: u, rise: 1.0 },
            Self::Involute { base, angle } => {
                let tau = angle - u / base;
                let (s, c) = sin_cos(tau);
                ProfilePoint { half_chord: base * s + u * c, height: base * c - u * s, rise: u * c / base }
            }
        }
    }
}

/// A piece and its range of parameters in the profile.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// The piece.
    pub piece: Piece,
    /// Parameter at its lower end.
    pub from: f64,
    /// Parameter at its upper end.
    pub to: f64,
}

//! Bending stress as two handbooks give it, with a geometry factor read from their charts: to compare with.

/// Factors of ANSI/AGMA 2003-B97.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agma2003 {
    /// Geometry factor Y_J, from the standard's chart.
    pub geometry: f64,
    /// Load distribution factor K_Hβ.
    pub load_distribution: f64,
    /// Size factor Y_x.
    pub size: f64,
    /// Lengthwise curvature factor Y_β: 1 for straight teeth.
    pub curvature: f64,
    /// Overload factor K_A.
    pub overload: f64,
    /// Dynamic factor K_v.
    pub dynamic: f64,
}

impl Agma2003 {
    /// Straight teeth of outer module `module` [m] with Y_J and K_Hβ, K_A = K_v = 1.
    pub fn new(geometry: f64, load_distribution: f64, module: f64) -> Self {
        Self { geometry, load_distribution, size: size_factor(module), curvature: 1.0, overload: 1.0, dynamic: 1.0 }
    }

    /// σ = 2T/(b d) · K_A K_v/m · Y_x K_Hβ/(Y_β Y_J) [Pa], for the torque of one mesh [N·m], face width, outer pitch
    /// diameter and outer module [m].
    pub fn stress(&self, torque: f64, face_width: f64, diameter: f64, module: f64) -> f64 {
        2.0 * torque / (face_width * diameter)
            * (self.overload * self.dynamic / module)
            * self.size
            * self.load_distribution
            / (self.curvature * self.geometry)
    }
}

/// Y_x = 0.4867 + 0.008339 m/mm for 1.6 mm ≤ m ≤ 50 mm, 0.5 below (AGMA 2003-B97), with `module` in m.
pub fn size_factor(module: f64) -> f64 {
    let mm = module * 1e3;
    if mm < 1.6 { 0.5 } else { 0.4867 + 0.008339 * mm.min(50.0) }
}

/// Liu Weixin, *Automotive Design*: differential gears, σ = 2 T k_s k_m/(k_v m b d₂ J) [Pa].
///
/// T = 0.6 T₀/N is the torque of one mesh on the side gear, `case_torque` T₀ that of the differential's case [N·m];
/// k_s = (m/25.4 mm)^¼, k_m = k_v = 1. `diameter` d₂ is the side gear's outer pitch diameter [m].
pub fn liu_weixin(case_torque: f64, planets: f64, module: f64, face_width: f64, diameter: f64, geometry: f64) -> f64 {
    let torque = 0.6 * case_torque / planets;
    let size = crate::numeric::pow(module / 25.4e-3, 0.25);
    2.0 * torque * size / (module * face_width * diameter * geometry)
}

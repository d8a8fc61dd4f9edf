//! Load of a mesh as its strength is rated.

/// Load of one mesh.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshLoad {
    /// Sum of normal forces referred to the mean cone distance [N].
    pub normal: f64,
    /// Largest pressure of a pair [Pa].
    pub pressure: f64,
    /// Whether the drive flank carries.
    pub driving: bool,
}

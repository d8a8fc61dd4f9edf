//! User parameters of the contact law.

choices! {
    /// Law of force against penetration.
    pub enum ContactLaw: "ContactLaw" {
        Impact = 1, "impact": "Adams IMPACT at the mean cone distance";
        Line = 2, "line": "linear tooth stiffness from geometry, over the face width";
        LineWeber = 3, "line_weber": "tooth stiffness from geometry, with a Hertz part that depends on the load";
    }
}

impl ContactLaw {
    /// True if the law has the stiffness of the teeth, valid at every cone distance. Other laws have one resultant for
    /// the whole face.
    pub const fn is_of_teeth(self) -> bool {
        matches!(self, Self::Line | Self::LineWeber)
    }
}

choices! {
    /// Damping of a tooth pair.
    pub enum DampingModel: "DampingModel" {
        Step = 1, "step": "contact.damping, built up over contact.penetration_depth as in Adams IMPACT";
        Restitution = 2, "restitution": "Hunt-Crossley, from contact.restitution at contact.impact_speed";
    }
}

spec! {
    /// Contact law and its constants.
    ///
    /// The start values are the study's Adams settings.
    pub struct ContactSpec {
        /// The law.
        pub law: ContactLaw = ContactLaw::Impact,
        /// True if the stiffness is computed by the study's Hertz formula instead of the given value.
        pub stiffness_from_hertz: bool = false,
        /// Stiffness K [N/m^e].
        // 5.77e5 N/mm^1.5 · (1000 mm/m)^1.5
        pub stiffness: f64 = 5.77e5 * 1e3 * 1e3_f64.sqrt(),
        /// Exponent e.
        pub exponent: f64 = 1.5,
        /// Damping C at full penetration [N·s/m].
        pub damping: f64 = 5e4,
        /// Penetration of full damping d_max [m].
        pub penetration_depth: f64 = 1e-4,
        /// The damping model.
        pub damping_model: DampingModel = DampingModel::Step,
        /// Coefficient of restitution e at the impact speed.
        pub restitution: f64 = 0.8,
        /// Impact speed at which the restitution is valid [m/s].
        pub impact_speed: f64 = 0.1,
        /// Line load at the mean cone distance for the Hertz part of [`ContactLaw::Line`] [N/m].
        pub line_load: f64 = 4e5,
        /// True if the stiffness of a lumped mesh is computed from the geometry of its teeth instead of the given
        /// value.
        pub mesh_stiffness_from_geometry: bool = true,
        /// Stiffness of a lumped mesh per face width c_γ [N/m²].
        pub mesh_stiffness: f64 = 1.8e10,
    }
}

//! Loaded sections of planet 1's left mesh at an instant.
//!
//! A section of solid teeth is where the solids touch, at the polar angle φ about the axis of each gear. Teeth with a
//! contact law touch where the aligned flanks do: on the path of contact, or at a tip corner. Errors and displacements
//! move their load along the face. On the unit sphere, a flank has the radius of curvature tan ψ(φ). The relative
//! radius at the cone distance R is
//!
//!   ρ = R / (cot ψ_p + cot ψ_s)
//!
//! A tip corner is not a cylinder. Its pressure is calculated with the radii of the flanks at the end of the path. It
//! is therefore lower than the real pressure at the edge.
//!
//! The load per width w(R) of `line` and `line_weber` follows from the law at each cone distance. For aligned teeth that is
//! w = 2FR/(R_e² − R_i²). `impact` has one resultant, which is spread evenly: w = F/b.

use bevel_differential::contact::pairs::{Flank, Spot};
use bevel_differential::geometry::Pair;
use bevel_differential::geometry::action::LineOfAction;
use bevel_differential::model::{Simulation, ToothLoad};
use bevel_differential::strength::LineContact;

/// Number of sections into which solid teeth in contact over the whole face are divided.
const SECTIONS_OF_SOLIDS: usize = 8;
/// Number of sections of the face for teeth with a contact law.
const SECTIONS: usize = 32;
/// A load over more than this fraction of the face counts as a load over the whole face.
const WHOLE: f64 = 1.0 - 1e-9;

/// A tooth pair: true if the drive flanks touch, and the indices of the planet's and the side gear's tooth.
pub type PairName = (bool, [usize; 2]);

/// A loaded section of a tooth pair at an instant.
#[derive(Clone, Copy, Debug)]
pub struct LoadedSection {
    /// Time [s].
    pub time: f64,
    /// Tooth pair.
    pub name: PairName,
    /// True if the section touches at a tip corner.
    pub is_corner: bool,
    /// Position on the path of contact from the planet's rotation [rad].
    pub s: f64,
    /// Cone distance [m].
    pub cone: f64,
    /// Width of the section along the face [m].
    pub width: f64,
    /// Polar angles on planet and side gear [rad].
    pub polar: [f64; 2],
    /// Normal force per width [N/m].
    pub line_load: f64,
    /// Relative radius of curvature [m].
    pub radius: f64,
    /// Hertz pressure [Pa].
    pub pressure: f64,
    /// Half-width of the contact strip [m].
    pub half_width: f64,
}

impl LoadedSection {
    /// Normal force [N].
    pub fn force(&self) -> f64 {
        self.line_load * self.width
    }
}

/// Gears of a scene, with data for their sections.
pub struct Flanks {
    /// The gears.
    pub pair: Pair,
    action: LineOfAction,
    contact: LineContact,
    /// True if the load of an aligned pair grows with the cone distance.
    grows: bool,
}

impl Flanks {
    /// Gears of `simulation`, both with the same Young's modulus [Pa] and Poisson's ratio. `grows` is true if the load
    /// of an aligned pair grows with the cone distance.
    pub fn new(simulation: &Simulation, young_modulus: f64, poisson_ratio: f64, grows: bool) -> Self {
        let pair = *simulation.pair();
        let (action, contact) = (LineOfAction::new(&pair), LineContact::new(&pair, young_modulus, poisson_ratio));
        Self { pair, action, contact, grows }
    }

    /// Loaded sections of planet 1's left mesh at the present time of `simulation`.
    pub fn instant(&self, simulation: &Simulation) -> Vec<LoadedSection> {
        let (mut all, time): (Vec<LoadedSection>, f64) = (Vec::new(), simulation.time());
        // slices of a pair are consecutive, and the first one provides the load of all
        let mut last = None;
        simulation.loads_over_the_face(|load, line_load| {
            let name = (load.flank == Flank::Drive, load.teeth);
            if load.touch.is_some() {
                all.extend(self.of_solids(time, load));
            } else if last.replace(name) != Some(name) {
                all.extend(self.of_law(time, load, line_load));
            }
        });
        all
    }

    /// Width of a section of teeth with a contact law [m].
    pub fn width(&self) -> f64 {
        (self.pair.outer_cone - self.pair.inner_cone) / SECTIONS as f64
    }

    fn of_law(
        &self,
        time: f64,
        load: &ToothLoad,
        line_load: Option<&dyn Fn(f64) -> f64>,
    ) -> impl Iterator<Item = LoadedSection> {
        let (width, face) = (self.width(), self.pair.outer_cone - self.pair.inner_cone);
        let polar = self.polar(load);
        let loads: Vec<[f64; 2]> = (0..SECTIONS)
            .map(|i| self.pair.inner_cone + width * (i as f64 + 0.5))
            .map(|cone| match line_load {
                Some(line_load) => [cone, line_load(cone)],
                None if self.grows => [cone, self.contact.line_load(load.normal, cone)],
                None => [cone, load.normal / face],
            })
            .filter(|[_, line_load]| *line_load > 0.0)
            .collect();
        loads.into_iter().map(move |[cone, line_load]| self.section(time, load, polar, [cone, width], line_load))
    }

    /// Returns several sections for a load over the whole face, otherwise one.
    fn of_solids(&self, time: f64, load: &ToothLoad) -> impl Iterator<Item = LoadedSection> {
        let (face, loaded) = (self.pair.outer_cone - self.pair.inner_cone, load.normal / load.line_load);
        let whole = loaded > WHOLE * face;
        let (count, cone, inner) = (if whole { SECTIONS_OF_SOLIDS } else { 1 }, load.cone, self.pair.inner_cone);
        let width = if whole { face / SECTIONS_OF_SOLIDS as f64 } else { loaded };
        let polar = load.touch.map_or([0.0; 2], |touch| touch.polar);
        let cones = (0..count).map(move |i| if whole { inner + width * (i as f64 + 0.5) } else { cone });
        let load = *load;
        cones.map(move |cone| self.section(time, &load, polar, [cone, width], load.line_load))
    }

    /// Polar angles on planet and side gear at which the aligned flanks touch [rad].
    fn polar(&self, load: &ToothLoad) -> [f64; 2] {
        let contact = load.contact(&self.action);
        [0, 1].map(|i| self.action.in_gear(&contact, i, 0.0, load.turn()).point.z.clamp(-1.0, 1.0).acos())
    }

    fn section(
        &self,
        time: f64,
        load: &ToothLoad,
        polar: [f64; 2],
        [cone, width]: [f64; 2],
        line_load: f64,
    ) -> LoadedSection {
        let pair = &self.pair;
        // a tip corner is past the end of the path, so arcs from the base circles are limited to those at the path's
        // ends
        let least = [pair.pitch_arc[0] + pair.path.low, pair.pitch_arc[1] - pair.path.high];
        let cot = |i: usize| 1.0 / pair.gears[i].action_arc(polar[i]).max(least[i]).tan();
        let radius = cone / (cot(0) + cot(1));
        let pressure = self.contact.pressure_on(line_load, radius).unwrap_or(0.0);
        LoadedSection {
            time,
            name: (load.flank == Flank::Drive, load.teeth),
            is_corner: load.spot != Spot::Path,
            s: load.s,
            cone,
            width,
            polar,
            line_load,
            radius,
            pressure,
            half_width: LineContact::half_width(line_load, pressure),
        }
    }
}

//! Scene plan: bodies that move, imposed motions, and groups of planets that move identically.
//!
//! Planets that are identical and in phase move identically from the start. They form a group: one planet of the group
//! is simulated, and its forces are multiplied by the number of members.

use super::{
    ATTACHED_COUNT, CARRIER, CarrierDrive, Dog, ENDS, FEW, GearContact, InputDerivatives, Inputs, Layout, MAX_DOF,
    MAX_GROUPS, MAX_PLANETS, PINION, PROPELLER, PlanetSpin, Scene, SideDrive,
};
use crate::geometry::{GearSpec, Pair, assembly};
use crate::problem::Problem;

/// Group of planets that move identically.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Group {
    /// Phases of the left and right mesh as arcs on the unit sphere [rad].
    pub phase: [f64; 2],
    /// Number of planets in the group.
    pub members: f64,
    /// Index of the first planet in the group.
    pub planet: usize,
}

/// Bodies and imposed motions of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    groups: [Group; MAX_GROUPS],
    group_count: usize,
    /// Group of each planet.
    pub group_of: [usize; MAX_PLANETS],
    /// Number of planets.
    pub planets: usize,
    /// True if the speed of the drive is imposed.
    pub drive_imposed: bool,
    /// Speed of the drive over the speed of the carrier; `None` if the drive acts on the carrier itself.
    pub drive_ratio: Option<f64>,
    /// Inertia of a pinion that is rigid with the carrier, at the carrier's speed [kg·m²].
    pub on_carrier: f64,
    /// Turns of the carrier after which all forces repeat.
    pub turns: u32,
    /// Ratio of the speeds of each clutch's shaft and the carrier, left and right, if there are clutches.
    pub clutch_ratio: [Option<f64>; 2],
    /// Dog clutches between side gears and half-shafts, left and right.
    pub dogs: [Option<Dog>; 2],
    /// True if the planet spin is imposed.
    pub spin_imposed: bool,
    /// True for each wheel-side end whose speed is imposed, left and right.
    pub side_imposed: [bool; 2],
    /// True for each half-shaft that twists, left and right.
    pub shafts: [bool; 2],
    /// Attached bodies of the scene. The inertia of half-shaft ends is left out.
    pub attached: [Option<AttachedBody>; ATTACHED_COUNT],
    /// True if pins and seats move.
    pub has_pins: bool,
    /// Representation of tooth contact.
    pub contact: GearContact,
}

/// Requirements of effects and solver for the plan.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Requests {
    /// True if planets differ, or if each must be simulated.
    pub individual: bool,
    /// True if pins and seats move.
    pub pins: bool,
    /// True for each half-shaft that twists even if it is driven by torque, left and right.
    pub shafts: [bool; 2],
    /// Attached bodies other than half-shaft ends.
    pub attached: [Option<AttachedBody>; ATTACHED_COUNT],
    /// Speed of the drive over the speed of the carrier, if the drive acts through a gear pair.
    pub drive_ratio: Option<f64>,
    /// Inertia that is rigid with the carrier, at the carrier's speed [kg·m²].
    pub on_carrier: f64,
    /// Turns of the carrier after which all forces repeat; 0 if it makes no demand.
    pub turns: u32,
    /// Ratio of the speeds of each clutch's shaft and the carrier, left and right, if there are clutches.
    pub clutch_ratio: [Option<f64>; 2],
    /// Dog clutches between side gears and half-shafts, left and right.
    pub dogs: [Option<Dog>; 2],
}

/// Body that turns relative to another body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttachedBody {
    /// Body relative to which it turns.
    pub to: Base,
    /// Moment of inertia [kg·m²].
    pub inertia: f64,
}

impl AttachedBody {
    /// Returns the body with its inertia at the carrier's speed, for a `ratio` of the final drive.
    fn at_carrier(self, ratio: Option<f64>) -> Self {
        let ratio = ratio.filter(|_| self.to == Base::Pinion).unwrap_or(1.0);
        Self { inertia: ratio * ratio * self.inertia, ..self }
    }
}

/// Body relative to which an attached body turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Base {
    /// Degree of freedom.
    Freedom(usize),
    /// The pinion of the final drive, or the carrier if the pinion is rigid with it. The inertia is at the pinion's
    /// speed.
    Pinion,
}

impl Plan {
    /// Plan of `scene` with the gears `pair` of `spec`. Fails if its planets do not assemble.
    pub fn new(scene: &Scene, spec: &GearSpec, pair: &Pair, requests: &Requests) -> Result<Self, Problem> {
        let phases = assembly::phases(spec)?;
        let side_imposed = [scene.left_drive == SideDrive::Speed, scene.right_drive == SideDrive::Speed];
        let shafts = [0, 1].map(|s| side_imposed[s] || requests.shafts[s]);
        let mut plan = Self {
            groups: [Group::default(); MAX_GROUPS],
            group_count: 0,
            group_of: [0; MAX_PLANETS],
            planets: phases.len(),
            drive_imposed: scene.carrier_drive == CarrierDrive::Speed,
            drive_ratio: requests.drive_ratio,
            on_carrier: requests.on_carrier,
            turns: requests.turns.max(1),
            clutch_ratio: requests.clutch_ratio,
            dogs: requests.dogs,
            spin_imposed: scene.planet_spin == PlanetSpin::Imposed,
            side_imposed,
            shafts,
            attached: std::array::from_fn(|k| match k {
                0..ENDS => shafts.contains(&true).then_some(AttachedBody { to: Base::Freedom(k), inertia: 0.0 }),
                _ => requests.attached[k].map(|body| body.at_carrier(requests.drive_ratio)),
            }),
            has_pins: requests.pins,
            contact: scene.gear_contact,
        };
        if plan.contact == GearContact::Ideal {
            // without teeth, there are no phases
            plan.add_group([0.0; 2], 0);
            plan.groups[0].members = phases.len() as f64;
        } else if requests.individual {
            // groups of opposite planets are adjacent, because sums add adjacent groups first and opposite planets may
            // move identically
            let order: &[usize] = if phases.len() == 4 { &[0, 2, 1, 3] } else { &[0, 1, 2][..phases.len()] };
            for &i in order {
                plan.add_group(phases[i].map(|f| f * pair.base_pitch), i);
            }
        } else {
            for (i, fraction) in phases.iter().enumerate() {
                let phase = fraction.map(|f| f * pair.base_pitch);
                match plan.groups().iter().position(|g| g.phase == phase) {
                    Some(g) => {
                        plan.groups[g].members += 1.0;
                        plan.group_of[i] = g;
                    }
                    None => plan.add_group(phase, i),
                }
            }
        }
        Ok(plan)
    }

    fn add_group(&mut self, phase: [f64; 2], planet: usize) {
        self.groups[self.group_count] = Group { phase, members: 1.0, planet };
        self.group_of[planet] = self.group_count;
        self.group_count += 1;
    }

    /// Returns the plan with imposed planet spin.
    pub fn with_spin_held(self) -> Self {
        Self { spin_imposed: true, ..self }
    }

    /// Returns the plan with all planets in one group. Returns `None` if they are in one group already, or differ in
    /// phase.
    pub fn with_merged_planets(self) -> Option<Self> {
        let mut plan = self;
        let [first, others @ ..] = self.groups() else { return None };
        if others.is_empty() || others.iter().any(|group| group.phase != first.phase) {
            return None;
        }
        plan.groups[0].members = self.groups().iter().map(|group| group.members).sum();
        (plan.group_count, plan.group_of) = (1, [0; MAX_PLANETS]);
        Some(plan)
    }

    /// Group `g` of planets.
    #[inline]
    pub fn group(&self, g: usize) -> &Group {
        &self.groups[g]
    }

    /// Groups of planets.
    pub fn groups(&self) -> &[Group] {
        &self.groups[..self.group_count]
    }

    /// Index of each degree of freedom.
    pub fn layout(&self) -> Layout {
        let mut layout = Layout {
            groups: self.group_count,
            members: self.groups.map(|g| g.members),
            has_pins: self.has_pins,
            attached: self.attached.map(|body| body.map(|_| CARRIER)),
            first_bases: [0; FEW],
            port: CARRIER,
        };
        for (k, body) in self.attached.iter().enumerate() {
            let Some(body) = body else { continue };
            layout.attached[k] = Some(match body.to {
                Base::Freedom(i) => i,
                Base::Pinion => layout.pinion(),
            });
        }
        let first = layout.count() - layout.attached().count();
        layout.first_bases = std::array::from_fn(|k| layout.attached().nth(k).map_or(first + k, |(_, to)| to));
        layout.port = (PINION..=PROPELLER).rfind(|&k| layout.attached[k].is_some()).map_or(CARRIER, |k| layout.body(k));
        layout
    }

    /// Sets the inputs of the drive from the command of the carrier, or from that of the pinion in front of it.
    #[inline]
    pub fn refer(&self, inputs: &mut Inputs) {
        (inputs.drive_speed, inputs.drive_torque) = match self.drive_ratio {
            None => (inputs.carrier_speed, inputs.carrier_torque),
            Some(ratio) => (inputs.pinion_speed / ratio, inputs.pinion_torque * ratio),
        };
    }

    /// Returns the derivatives of the inputs with those of the drive.
    pub fn with_drive(&self, mut derivatives: InputDerivatives) -> InputDerivatives {
        derivatives.rates.iter_mut().for_each(|rates| self.refer(rates));
        derivatives
    }

    /// Moment of inertia of the bodies between carrier and drive that move separately [kg·m²], referred to the carrier.
    /// The pinion turns `joint` times as fast as the driven end of the propeller shaft.
    pub fn drive_inertia(&self, joint: f64) -> f64 {
        let of = |k: usize| self.attached[k].map_or(0.0, |body| body.inertia);
        of(PINION) + of(PROPELLER) / (joint * joint)
    }

    /// Moment of inertia of the pinion at the carrier's speed [kg·m²].
    pub fn pinion_inertia(&self) -> f64 {
        self.on_carrier + self.attached[PINION].map_or(0.0, |pinion| pinion.inertia)
    }

    /// Moment of inertia of the driven end of the propeller shaft at the carrier's speed [kg·m²], if there is one.
    pub fn propeller_inertia(&self) -> Option<f64> {
        self.attached[PROPELLER].map(|end| end.inertia)
    }

    /// True if the drive acts on the carrier itself or is rigid with it.
    pub fn drives_carrier(&self) -> bool {
        self.attached[PINION..=PROPELLER].iter().all(Option::is_none)
    }

    /// Periods by which positions are wrapped [rad]; infinite for positions that are not wrapped.
    pub fn periods(&self, pair: &Pair) -> [f64; MAX_DOF] {
        let layout = self.layout();
        let mut periods = [f64::INFINITY; MAX_DOF];
        periods[..CARRIER].fill(pair.gears[1].tooth_pitch());
        periods[CARRIER] = crate::numeric::TAU * f64::from(self.turns);
        for g in 0..layout.groups {
            periods[layout.planet(g)] = pair.gears[0].tooth_pitch();
        }
        periods
    }

    /// Degree of freedom of attached body `k`, or `None` if it does not move. The end of a half-shaft moves only if the
    /// shaft twists.
    pub fn attached(&self, k: usize) -> Option<usize> {
        let moves = if k < ENDS { self.shafts[k] } else { self.attached[k].is_some() };
        moves.then(|| self.layout().body(k))
    }

    /// Number of degrees of freedom, including imposed ones. The number of states is twice as large.
    pub fn degrees_of_freedom(&self) -> usize {
        match self.contact {
            GearContact::Ideal => 2 + self.layout().attached().count(),
            _ => self.layout().count(),
        }
    }

    /// Number of imposed degrees of freedom.
    pub fn imposed(&self) -> usize {
        let spins = if self.contact == GearContact::Ideal { 1 } else { self.layout().groups };
        usize::from(self.drive_imposed)
            + if self.spin_imposed { spins } else { 0 }
            + self.side_imposed.iter().filter(|&&imposed| imposed).count()
    }

    /// Describes the groups in which planets are simulated, for example "1 group (of 2)" or "2 groups (of 1 + 1)".
    pub fn describe_groups(&self) -> String {
        let members: Vec<String> = self.groups().iter().map(|group| group.members.to_string()).collect();
        let plural = if members.len() == 1 { "" } else { "s" };
        format!("{} group{plural} (of {})", members.len(), members.join(" + "))
    }

    /// Describes the simulated scene in one line: representation, drives, planets, states.
    pub fn describe(&self) -> String {
        let level = match self.contact {
            GearContact::Ideal => "ideal gears",
            GearContact::Lumped => "lumped mesh stiffness",
            GearContact::Tooth => "tooth contact",
            GearContact::Solid => "solid teeth",
        };
        let drive = |imposed| if imposed { "imposed" } else { "free" };
        let side = |s: usize| match (self.side_imposed[s], self.shafts[s]) {
            (true, _) => "speed through its half-shaft",
            (false, true) => "torque through its half-shaft",
            (false, false) => "torque",
        };
        format!(
            "{level}; {} speed {}; planet spin {}; left driven by {}, right by {}; {} planets simulated in {}; \
             {} states",
            if self.drive_ratio.is_some() { "pinion" } else { "carrier" },
            drive(self.drive_imposed),
            drive(self.spin_imposed),
            side(0),
            side(1),
            self.planets,
            self.describe_groups(),
            2 * self.degrees_of_freedom(),
        )
    }
}

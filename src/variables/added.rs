//! Variables added after the first version. Their value references come after those of all other variables. So no value reference
//! ever changes, because hosts store value references.

use super::Variable;

/// Names of the added variables, in the order of their value references. A new name goes to the end.
const ADDED: &[&str] = &[
    "geometry.planet_mass",
    "geometry.side_mass",
    "geometry.contact_ratio",
    "geometry.outer_cone_distance",
    "geometry.planet_pitch_angle",
    "geometry.side_pitch_angle",
    "geometry.wheel_lash",
    "safety.root_min",
    "safety.flank_min",
    "effects.mesh_history",
    "left.speed_peak_to_peak",
    "right.speed_peak_to_peak",
    "planet[1].left_transmission_error_peak_to_peak",
    "planet[1].right_transmission_error_peak_to_peak",
    "planet[2].left_transmission_error_peak_to_peak",
    "planet[2].right_transmission_error_peak_to_peak",
    "planet[3].left_transmission_error_peak_to_peak",
    "planet[3].right_transmission_error_peak_to_peak",
    "planet[4].left_transmission_error_peak_to_peak",
    "planet[4].right_transmission_error_peak_to_peak",
    "geometry.inner_cone_distance",
    "geometry.planet_tip_angle",
    "geometry.planet_root_angle",
    "geometry.planet_base_angle",
    "geometry.side_tip_angle",
    "geometry.side_root_angle",
    "geometry.side_base_angle",
    "planet[1].left_pair[1].tooth",
    "planet[1].left_pair[1].force",
    "planet[1].left_pair[1].height",
    "planet[1].left_pair[1].toe_pressure",
    "planet[1].left_pair[1].middle_pressure",
    "planet[1].left_pair[1].heel_pressure",
    "planet[1].left_pair[2].tooth",
    "planet[1].left_pair[2].force",
    "planet[1].left_pair[2].height",
    "planet[1].left_pair[2].toe_pressure",
    "planet[1].left_pair[2].middle_pressure",
    "planet[1].left_pair[2].heel_pressure",
    "planet[1].left_pair[3].tooth",
    "planet[1].left_pair[3].force",
    "planet[1].left_pair[3].height",
    "planet[1].left_pair[3].toe_pressure",
    "planet[1].left_pair[3].middle_pressure",
    "planet[1].left_pair[3].heel_pressure",
    "strength.rate_from",
    "stress.contact_rated",
    "left.wheel_angle",
    "left.wheel_speed",
    "right.wheel_angle",
    "right.wheel_speed",
    "oil.temperature",
    "oil.viscosity_40",
    "oil.viscosity_100",
    "oil.density",
    "oil.density_fall",
    "tooth_friction.viscosity_from_oil",
    "bearing_drag.viscosity_from_oil",
    "bearing_drag.reference_temperature",
    "limited_slip.mean_radius",
    "limited_slip.stribeck_speed",
    "limited_slip.slip_slope",
    "limited_slip.cold_temperature",
    "limited_slip.cold_factor",
    "limited_slip.reference_temperature",
    "limited_slip.hot_temperature",
    "limited_slip.hot_factor",
    "thrust_friction.static_ratio",
    "thrust_friction.stribeck_speed",
    "thrust_friction.slip_slope",
    "thrust_friction.cold_temperature",
    "thrust_friction.cold_factor",
    "thrust_friction.reference_temperature",
    "thrust_friction.hot_temperature",
    "thrust_friction.hot_factor",
    "wheel_brake.static_ratio",
    "wheel_brake.mean_radius",
    "wheel_brake.temperature",
    "wheel_brake.stribeck_speed",
    "wheel_brake.slip_slope",
    "wheel_brake.cold_temperature",
    "wheel_brake.cold_factor",
    "wheel_brake.reference_temperature",
    "wheel_brake.hot_temperature",
    "wheel_brake.hot_factor",
    "effects.warm_up",
    "warm_up.ambient_temperature",
    "warm_up.sump_given",
    "warm_up.oil_capacity",
    "warm_up.gear_specific_heat",
    "warm_up.clutch_capacity",
    "warm_up.washer_capacity",
    "warm_up.case_capacity",
    "warm_up.gears_to_oil",
    "warm_up.gears_to_oil_per_speed",
    "warm_up.clutch_to_oil",
    "warm_up.washers_to_oil",
    "warm_up.oil_to_case",
    "warm_up.case_to_ambient",
    "warm_up.case_to_ambient_per_speed",
    "warm_up.oil_share",
    "temperature.oil",
    "temperature.gears",
    "temperature.clutch",
    "temperature.washers",
    "temperature.case",
    "warm_up.stored",
    "warm_up.given_off",
    "strength.thermal_contact_coefficient",
    "strength.scuffing_temperature",
    "temperature.flash",
    "temperature.contact",
    "safety.scuffing",
    "warm_up.gears_above_oil",
    "warm_up.clutch_above_oil",
    "warm_up.washers_above_oil",
    "warm_up.case_above_oil",
    "warm_up.cycle",
    "thrust_friction.planet_washer_area",
    "thrust_friction.side_washer_area",
    "thrust_friction.pin_area",
    "thrust_friction.pv_limit",
    "thrust_friction.beyond_limit",
    "limited_slip.friction_area",
    "limited_slip.plate_coefficient",
    "limited_slip.pv_limit",
    "limited_slip.beyond_limit",
    "wheel_brake.friction_area",
    "wheel_brake.lining_coefficient",
    "wheel_brake.pv_limit",
    "wheel_brake.beyond_limit",
    "pv.washers",
    "pv.clutch",
    "pv.brake",
];

/// Moves the rows of `ADDED` behind all other rows, in the order of `ADDED`. Returns the new index of each row.
pub fn put_last(rows: &mut Vec<Variable>) -> Vec<usize> {
    let place = |i: usize| ADDED.iter().position(|&name| name == rows[i].name);
    let mut order: Vec<usize> = (0..rows.len()).filter(|&i| place(i).is_none()).collect();
    order.extend(ADDED.iter().filter_map(|&name| rows.iter().position(|row| row.name == name)));
    let mut places = vec![0; rows.len()];
    order.iter().enumerate().for_each(|(to, &from)| places[from] = to);
    let moved = |&from: &usize| Variable { derivative_of: rows[from].derivative_of.map(|of| places[of]), ..rows[from] };
    *rows = order.iter().map(moved).collect();
    places
}

#[cfg(test)]
mod tests {
    use super::super::{fnv1a, table};
    use super::*;

    #[test]
    fn value_references_stay_what_they_were() {
        let names: Vec<&str> = table().rows.iter().map(|row| row.name).collect();
        let (first, added) = names.split_at(names.len() - ADDED.len());
        assert_eq!(added, ADDED);
        assert_eq!((first.len(), fnv1a(first.join(" ").bytes())), (279, 0x0fe6_0d28_21ac_63fe));
    }
}

//! From a model to equations of its size: sizes are known at compile time, so that every scene gets its own code.

/// Evaluates an expression with the type `E` set to the equations of a model with teeth, in the size it needs and with
/// effects only where there are some, and `N` to its number of degrees of freedom.
macro_rules! by_size {
    ($teeth:expr, $full:expr, $body:expr) => {{
        let layout = &$teeth.layout;
        match (layout.groups, layout.pins, layout.ends, $full) {
            (1, false, false, false) => $crate::model::dynamics::sizes::by_size!(@ 4, 1, 0, false, $body),
            (2, false, false, false) => $crate::model::dynamics::sizes::by_size!(@ 5, 2, 0, false, $body),
            (_, false, false, false) => $crate::model::dynamics::sizes::by_size!(@ 7, 4, 0, false, $body),
            (1, false, false, true) => $crate::model::dynamics::sizes::by_size!(@ 4, 1, 0, true, $body),
            (2, false, false, true) => $crate::model::dynamics::sizes::by_size!(@ 5, 2, 0, true, $body),
            (_, false, false, true) => $crate::model::dynamics::sizes::by_size!(@ 7, 4, 0, true, $body),
            (1, false, true, _) => $crate::model::dynamics::sizes::by_size!(@ 6, 1, 0, true, $body),
            (2, false, true, _) => $crate::model::dynamics::sizes::by_size!(@ 7, 2, 0, true, $body),
            (_, false, true, _) => $crate::model::dynamics::sizes::by_size!(@ 9, 4, 0, true, $body),
            (1, true, false, _) => $crate::model::dynamics::sizes::by_size!(@ 7, 1, 1, true, $body),
            (2, true, false, _) => $crate::model::dynamics::sizes::by_size!(@ 9, 2, 1, true, $body),
            (_, true, false, _) => $crate::model::dynamics::sizes::by_size!(@ 13, 4, 1, true, $body),
            (1, true, true, _) => $crate::model::dynamics::sizes::by_size!(@ 9, 1, 1, true, $body),
            (2, true, true, _) => $crate::model::dynamics::sizes::by_size!(@ 11, 2, 1, true, $body),
            (_, true, true, _) => $crate::model::dynamics::sizes::by_size!(@ 15, 4, 1, true, $body),
        }
    }};
    (@ $n:literal, $g:literal, $p:literal, $full:literal, $body:expr) => {{
        #[allow(unused)]
        const N: usize = $n;
        type E<'a> = $crate::model::dynamics::equations::Equations<'a, $n, $g, $p, $full>;
        $body
    }};
}

/// The same for an ideal differential with effects.
macro_rules! by_rigid_size {
    ($model:expr, $body:expr) => {
        if $model.ideal.plan.ends {
            type E<'a> = $crate::model::dynamics::rigid_equations::RigidEquations<'a, 6>;
            $body
        } else {
            type E<'a> = $crate::model::dynamics::rigid_equations::RigidEquations<'a, 4>;
            $body
        }
    };
}

/// Evaluates an expression with the equations of any model bound to `$equations`, `N` their degrees of freedom.
macro_rules! with_equations {
    ($model:expr, $state:expr, $inputs:expr, |$equations:ident| $body:expr) => {
        match &$model.gears {
            $crate::model::assembly::model::Gears::Rigid(rigid) if $model.ideal.plan.ends => {
                const N: usize = 6;
                let $equations =
                    $crate::model::dynamics::rigid_equations::RigidEquations::<N>::new(rigid, $inputs, $state);
                $body
            }
            $crate::model::assembly::model::Gears::Rigid(rigid) => {
                const N: usize = 4;
                let $equations =
                    $crate::model::dynamics::rigid_equations::RigidEquations::<N>::new(rigid, $inputs, $state);
                $body
            }
            $crate::model::assembly::model::Gears::Teeth(teeth) => {
                let full = teeth.additions.bodies.act_in($state);
                $crate::model::dynamics::sizes::by_size!(teeth, full, {
                    let $equations = E::new(teeth, $inputs, $state);
                    $body
                })
            }
        }
    };
}

pub(in crate::model) use {by_rigid_size, by_size, with_equations};

//! Known errors of the richest model by output. They are a lower bound of its error, to which an accuracy should be
//! compared. The values come from docs/inside/stiffness.md (3-D finite elements) and the limitations in docs/inside/theory.md.

use bevel_differential::variables::Variable;

use super::want::Want;

/// A kind of output, identified by parts of its name, and its known error.
struct Bound {
    parts: &'static [&'static str],
    text: &'static str,
}

const BOUNDS: [Bound; 7] = [
    Bound {
        parts: &["damage."],
        text: "damage follows from S-N curves, whose scatter is a factor of 2 and more in life",
    },
    Bound {
        parts: &["stress.", "safety."],
        text: "stresses follow standards' formulas for straight bevel teeth: some 10 % against finite elements",
    },
    Bound {
        parts: &["heat.", "efficiency", "locking_value", "torque_bias"],
        text: "friction enters in proportion to its coefficients, which are known to 20 % at best",
    },
    Bound {
        parts: &["transmission_error", "twist", "angle"],
        text: "teeth and gear bodies are within 4 % of 3-D finite elements; the case and its bearings are rigid but for \
               pin_compliance",
    },
    Bound {
        parts: &["acceleration", "_force", "_pairs"],
        text: "means follow from balance and are exact; the share of pairs and peaks depend on tooth stiffness (4 %) and on \
               damping, which is known to a factor of 2",
    },
    Bound {
        parts: &["torque", "power"],
        text: "means follow from balance and are exact; peaks depend on inertias, lash and stiffness as given",
    },
    Bound {
        parts: &["speed", "frequency"],
        text: "means follow from the numbers of teeth and are exact; the ripple follows tooth stiffness (4 %) and the teeth's \
               real errors",
    },
];

/// Known errors of the richest model for the wanted outputs, each once.
pub fn bounds(outputs: &[&Variable], wants: &[Want]) -> Vec<&'static str> {
    let mut found = Vec::new();
    for want in wants {
        let name = outputs[want.output].name;
        let bound = BOUNDS.iter().find(|bound| bound.parts.iter().any(|part| name.contains(part)));
        if let Some(bound) = bound.filter(|bound| !found.contains(&bound.text)) {
            found.push(bound.text);
        }
    }
    found
}

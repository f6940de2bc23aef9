//! The numbers of protective falling.

use aplomb_controllers::fall::FallSpec;
use aplomb_framework::model::Model;

use super::Tunable;
use crate::dimension::{Dimension, linear, logarithmic};

impl Tunable for FallSpec {
    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        vec![
            linear("forward.reach.waist", -0.6, 0.4),
            linear("forward.reach.shoulder", 0.6, 2.2),
            linear("forward.reach.elbow", 0.1, 1.2),
            linear("forward.reach.hip", -0.2, 1.2),
            linear("forward.reach.knee", -1.6, -0.1),
            linear("forward.give.waist", -0.6, 0.4),
            linear("forward.give.shoulder", 0.6, 2.2),
            linear("forward.give.elbow", 0.4, 2.2),
            linear("forward.give.hip", -0.2, 1.2),
            linear("forward.give.knee", -1.6, -0.1),
            logarithmic("forward.reach_stiffness", 0.2, 1.2),
            logarithmic("forward.give_stiffness", 0.1, 1.0),
            logarithmic("forward.ramp", 0.08, 0.5),
            linear("backward.reach.waist", -1.2, 0.0),
            linear("backward.reach.shoulder", -1.0, 0.6),
            linear("backward.reach.elbow", 0.1, 1.5),
            linear("backward.reach.hip", 0.2, 2.0),
            linear("backward.reach.knee", -2.4, -0.3),
            linear("backward.reach.ankle", -0.4, 0.5),
            linear("backward.give.waist", -1.2, 0.0),
            linear("backward.give.shoulder", -1.0, 1.0),
            linear("backward.give.elbow", 0.1, 2.2),
            linear("backward.give.hip", 0.2, 2.0),
            linear("backward.give.knee", -2.4, -0.3),
            logarithmic("backward.reach_stiffness", 0.2, 1.2),
            logarithmic("backward.give_stiffness", 0.1, 1.0),
            logarithmic("backward.ramp", 0.08, 0.6),
        ]
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        let (way, rest) = match name.strip_prefix("forward.") {
            Some(rest) => (&mut self.forward, rest),
            None => (
                &mut self.backward,
                name.strip_prefix("backward.").unwrap_or(name),
            ),
        };
        match rest.split_once('.') {
            Some(("reach", joint)) => way.reach.entry(joint.to_owned()).or_insert(0.0),
            Some((_, joint)) => way.give.entry(joint.to_owned()).or_insert(0.0),
            None => match rest {
                "reach_stiffness" => &mut way.reach_stiffness,
                "give_stiffness" => &mut way.give_stiffness,
                _ => &mut way.ramp,
            },
        }
    }
}

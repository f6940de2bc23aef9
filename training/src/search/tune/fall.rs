//! The numbers of protective falling.

use aplomb_controllers::kinds::fall::{FallSpec, Over};
use aplomb_framework::character::Model;

use crate::search::dimension::{Dimension, linear, logarithmic};
use crate::search::tune::numbers::Tunable;

impl Tunable for FallSpec {
    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        let mut all = vec![
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
        ];
        if self.over.is_some() {
            all.extend([
                linear("over.beyond", 1.6, 2.6),
                linear("over.reach.waist", -1.0, 0.3),
                linear("over.reach.shoulder", 1.8, 3.1),
                linear("over.reach.elbow", 0.0, 1.2),
                linear("over.reach.hip", 0.0, 1.6),
                linear("over.reach.knee", -1.6, 0.0),
                linear("over.give.waist", -1.0, 0.3),
                linear("over.give.shoulder", 1.2, 3.1),
                linear("over.give.elbow", 0.2, 2.2),
                linear("over.give.hip", 0.0, 2.0),
                linear("over.give.knee", -2.0, 0.0),
                logarithmic("over.reach_stiffness", 0.2, 1.2),
                logarithmic("over.give_stiffness", 0.1, 1.0),
                logarithmic("over.ramp", 0.08, 0.4),
            ]);
        }
        all
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        let (way, rest) = match name.split_once('.') {
            Some(("forward", rest)) => (&mut self.forward, rest),
            Some(("over", rest)) => {
                let over = self.over.get_or_insert_with(|| Over {
                    beyond: std::f64::consts::PI,
                    way: self.backward.clone(),
                });
                if rest == "beyond" {
                    return &mut over.beyond;
                }
                (&mut over.way, rest)
            }
            _ => (
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

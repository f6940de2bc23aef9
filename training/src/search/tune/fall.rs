//! The numbers of protective falling.

use aplomb_controllers::kinds::fall::{FallSpec, Over, Way};
use aplomb_framework::character::Model;

use crate::search::dimension::{Dimension, linear, logarithmic};
use crate::search::tune::numbers::Tunable;

impl Tunable for FallSpec {
    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        let mut all = Vec::new();
        let mut way = |name: &str, ways: &Way, ranges: &[(&str, f64, f64)]| {
            for phase in ["reach", "give"] {
                let range = |(joint, low, high): &(&str, f64, f64)| {
                    linear(format!("{name}.{phase}.{joint}"), *low, *high)
                };
                all.extend(ranges.iter().map(range));
            }
            let apart = ways.apart.keys();
            all.extend(apart.map(|stem| linear(format!("{name}.apart.{stem}"), -0.6, 0.6)));
            all.push(logarithmic(format!("{name}.reach_stiffness"), 0.2, 1.2));
            all.push(logarithmic(format!("{name}.give_stiffness"), 0.1, 1.0));
            all.push(logarithmic(format!("{name}.ramp"), 0.08, 0.5));
        };
        way(
            "forward",
            &self.forward,
            &[
                ("waist", -0.6, 0.4),
                ("neck", 0.2, 1.04),
                ("shoulder", 0.6, 2.6),
                ("elbow", 0.1, 2.2),
                ("hip", -0.2, 1.4),
                ("knee", -1.8, -0.1),
            ],
        );
        way(
            "backward",
            &self.backward,
            &[
                ("waist", -1.2, 0.0),
                ("neck", -1.04, -0.3),
                ("shoulder", -1.0, 1.0),
                ("elbow", 0.1, 2.2),
                ("hip", 0.2, 2.0),
                ("knee", -2.4, -0.3),
                ("ankle", -0.4, 0.5),
            ],
        );
        if let Some(over) = &self.over {
            way(
                "over",
                &over.way,
                &[
                    ("waist", -1.0, 0.3),
                    ("neck", -1.04, 0.0),
                    ("shoulder", 1.2, 3.1),
                    ("elbow", 0.0, 2.2),
                    ("hip", 0.0, 2.0),
                    ("knee", -2.0, 0.0),
                ],
            );
            all.push(linear("over.beyond", 1.6, 2.6));
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
            Some(("apart", stem)) => way.apart.entry(stem.to_owned()).or_insert(0.0),
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

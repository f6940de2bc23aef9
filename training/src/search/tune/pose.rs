//! The numbers of a pose controller: every named angle and duration of every state, and damping.

use aplomb_controllers::kinds::pose::PoseSpec;
use aplomb_controllers::target::joints_named;
use aplomb_framework::character::Model;

use crate::search::dimension::{Dimension, linear, logarithmic};
use crate::search::tune::numbers::Tunable;

impl Tunable for PoseSpec {
    fn dimensions(&self, model: &Model) -> Vec<Dimension> {
        let mut all = Vec::new();
        for (i, state) in self.states.iter().enumerate() {
            for joint in state.pose.keys() {
                let range = joints_named(model, joint)
                    .ok()
                    .and_then(|j| j.first().copied())
                    .and_then(|j| model.joints().nth(j))
                    .map_or([-1.0, 1.0], |j| j.range);
                all.push(linear(format!("{i}.pose.{joint}"), range[0], range[1]));
            }
            let apart = state.apart.keys();
            all.extend(apart.map(|stem| linear(format!("{i}.apart.{stem}"), -0.8, 0.8)));
            all.push(logarithmic(format!("{i}.duration"), 0.08, 1.5));
            all.push(linear(format!("{i}.stiffness"), 0.2, 1.6));
        }
        all.push(linear("damping", 0.4, 1.0));
        all
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        let Some((state, rest)) = name.split_once('.') else {
            return &mut self.damping;
        };
        let state = &mut self.states[state.parse::<usize>().unwrap_or(0)];
        match rest.split_once('.') {
            Some(("apart", stem)) => state.apart.entry(stem.to_owned()).or_insert(0.0),
            Some((_, joint)) => state.pose.entry(joint.to_owned()).or_insert(0.0),
            None if rest == "duration" => &mut state.duration,
            None => &mut state.stiffness,
        }
    }
}

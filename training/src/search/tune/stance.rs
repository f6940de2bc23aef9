//! The numbers of quiet standing.

use aplomb_controllers::kinds::stance::StanceSpec;
use aplomb_framework::character::Model;

use crate::search::dimension::{Dimension, linear, logarithmic};
use crate::search::tune::numbers::{Tunable, share_bend};

impl Tunable for StanceSpec {
    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        vec![
            linear("com_ahead", -0.05, 0.03),
            logarithmic("position_gain", 0.2, 10.0),
            logarithmic("velocity_gain", 0.5, 8.0),
            logarithmic("bend_gain", 0.1, 30.0),
            linear("bend_margin", -0.02, 0.1),
            logarithmic("stiffness", 0.3, 2.5),
            linear("pose.knee", -0.2, 0.0),
            linear("pose.elbow", 0.0, 0.4),
        ]
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        match name {
            "com_ahead" => &mut self.com_ahead,
            "position_gain" => &mut self.position_gain,
            "velocity_gain" => &mut self.velocity_gain,
            "bend_gain" => &mut self.bend_gain,
            "bend_margin" => &mut self.bend_margin,
            "stiffness" => &mut self.stiffness,
            other => {
                let joint = other.strip_prefix("pose.").unwrap_or(other);
                self.pose.entry(joint.to_owned()).or_insert(0.0)
            }
        }
    }

    fn settle(&mut self) {
        share_bend(&mut self.pose);
    }
}

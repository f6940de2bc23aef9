//! The numbers of a protective step.

use aplomb_controllers::kinds::step::StepSpec;
use aplomb_framework::character::Model;

use crate::search::dimension::{Dimension, linear, logarithmic};
use crate::search::tune::numbers::Tunable;

impl Tunable for StepSpec {
    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        let mut all = Vec::new();
        for way in ["forward", "backward"] {
            all.extend([
                linear(format!("{way}.swing_time"), 0.18, 0.45),
                linear(format!("{way}.reach"), 0.2, 1.4),
                linear(format!("{way}.beyond"), -0.15, 0.25),
                linear(format!("{way}.lift"), 0.03, 0.2),
                linear(format!("{way}.lean"), -0.35, 0.2),
            ]);
        }
        all.extend([
            logarithmic("swing_stiffness", 100.0, 3000.0),
            logarithmic("swing_weight", 0.03, 30.0),
            linear("close_time", 0.25, 0.7),
            linear("close_lift", 0.02, 0.12),
            linear("close_within", 0.02, 0.16),
            linear("margin", 0.0, 0.1),
            logarithmic("glide", 0.2, 4.0),
            linear("bend", 0.0, 0.3),
            logarithmic("gains.kl", 5.0, 200.0),
            logarithmic("gains.dl", 3.0, 60.0),
            logarithmic("gains.dh", 0.1, 30.0),
            logarithmic("gains.kt", 5.0, 200.0),
            logarithmic("gains.dt", 2.0, 50.0),
            logarithmic("gains.angular", 0.01, 10.0),
            logarithmic("gains.tracking", 1e-4, 1.0),
            logarithmic("gains.root", 0.1, 30.0),
            linear("pose.knee", -0.5, -0.05),
        ]);
        all
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        let (group, field) = name.split_once('.').unwrap_or(("", name));
        let g = &mut self.gains;
        match (group, field) {
            ("forward" | "backward", _) => {
                let p = if group == "forward" {
                    &mut self.forward
                } else {
                    &mut self.backward
                };
                match field {
                    "swing_time" => &mut p.swing_time,
                    "reach" => &mut p.reach,
                    "beyond" => &mut p.beyond,
                    "lift" => &mut p.lift,
                    _ => &mut p.lean,
                }
            }
            ("gains", "kl") => &mut g.kl,
            ("gains", "dl") => &mut g.dl,
            ("gains", "dh") => &mut g.dh,
            ("gains", "kt") => &mut g.kt,
            ("gains", "dt") => &mut g.dt,
            ("gains", "angular") => &mut g.angular,
            ("gains", "tracking") => &mut g.tracking,
            ("gains", _) => &mut g.root,
            ("pose", joint) => self.pose.entry(joint.to_owned()).or_insert(0.0),
            (_, "swing_stiffness") => &mut self.swing_stiffness,
            (_, "swing_weight") => &mut self.swing_weight,
            (_, "close_time") => &mut self.close_time,
            (_, "close_lift") => &mut self.close_lift,
            (_, "close_within") => &mut self.close_within,
            (_, "margin") => &mut self.margin,
            (_, "glide") => &mut self.glide,
            _ => &mut self.bend,
        }
    }

    fn settle(&mut self) {
        crate::search::tune::numbers::share_bend(&mut self.pose);
    }
}

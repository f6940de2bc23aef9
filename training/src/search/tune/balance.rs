//! The numbers of standing balance by momentum control.

use aplomb_controllers::kinds::balance::BalanceSpec;
use aplomb_framework::character::Model;

use crate::search::dimension::{Dimension, linear, logarithmic};
use crate::search::tune::numbers::{Tunable, share_bend};

impl Tunable for BalanceSpec {
    fn dimensions(&self, _: &Model) -> Vec<Dimension> {
        vec![
            logarithmic("kl", 5.0, 400.0),
            logarithmic("dl", 3.0, 80.0),
            logarithmic("kl_height", 10.0, 400.0),
            logarithmic("dh", 0.1, 30.0),
            logarithmic("kt", 2.0, 200.0),
            logarithmic("dt", 1.0, 50.0),
            logarithmic("angular", 0.01, 10.0),
            logarithmic("tracking", 1e-4, 1.0),
            logarithmic("root", 0.03, 30.0),
            logarithmic("tilted", 1e-2, 1e3),
            logarithmic("lifted", 1e-4, 1.0),
            logarithmic("shoulder", 0.03, 10.0),
            logarithmic("elbow", 0.03, 3.0),
            logarithmic("neck", 0.03, 10.0),
            logarithmic("waist", 0.03, 10.0),
            logarithmic("hip", 0.03, 10.0),
            logarithmic("knee", 0.03, 10.0),
            linear("com_ahead", -0.05, 0.03),
            linear("margin", 0.0, 0.02),
            linear("pose.knee", -0.35, 0.0),
            linear("pose.shoulder", -0.2, 0.3),
            linear("pose.elbow", 0.0, 0.6),
        ]
    }

    fn slot(&mut self, name: &str) -> &mut f64 {
        let g = &mut self.gains;
        match name {
            "kl" => &mut g.kl,
            "dl" => &mut g.dl,
            "kl_height" => &mut g.kl_height,
            "dh" => &mut g.dh,
            "kt" => &mut g.kt,
            "dt" => &mut g.dt,
            "angular" => &mut g.angular,
            "tracking" => &mut g.tracking,
            "root" => &mut g.root,
            "tilted" => &mut g.tilted,
            "lifted" => &mut g.lifted,
            "margin" => &mut g.margin,
            "com_ahead" => &mut self.com_ahead,
            other => match other.strip_prefix("pose.") {
                Some(joint) => self.pose.entry(joint.to_owned()).or_insert(0.0),
                None => self.joint_weights.entry(other.to_owned()).or_insert(1.0),
            },
        }
    }

    fn settle(&mut self) {
        share_bend(&mut self.pose);
        let g = &mut self.gains;
        g.dl_height = 2.0 * g.kl_height.sqrt();
    }
}

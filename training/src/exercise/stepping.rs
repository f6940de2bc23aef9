//! How well a step takes pushes that balance in place does not.
//!
//! push, supervisor → rollout → steady on parallel feet, time, way, bent trunk → cost.

use aplomb_framework::control::Supervisor;
use aplomb_framework::math::square;
use aplomb_framework::run::Simulation;

use crate::exercise::bearing::Bearing;

/// s after the push within which it is to stand.
const LONGEST: f64 = 6.0;
/// rad that nobody minds the trunk to lean.
const LEANT: f64 = 0.5;
/// m that nobody sees the soles slide.
const SLID: f64 = 0.02;
/// s for which it must stand.
const STEADY: f64 = 0.3;

/// What became of one push.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepped {
    /// Whether it stood still on parallel feet in time, and never came down.
    pub stood: bool,
    /// s from the push.
    pub time: f64,
    /// m that the centre of mass was moved.
    pub way: f64,
    /// Mean of the trunk's pitch squared, rad².
    pub bent: f64,
    /// The furthest that the trunk leant either way, rad.
    pub lean: f64,
    /// Mean of the squared joint velocities, (rad/s)².
    pub motion: f64,
    /// m by which loaded soles slid.
    pub slid: f64,
}

impl Stepped {
    /// What it is charged: time, way, a bent trunk, sliding soles and needless motion, each little, and much
    /// for coming down, the more the sooner.
    #[must_use]
    pub fn cost(&self) -> f64 {
        if self.stood {
            let motion = 0.003 * self.motion.min(100.0);
            let bent = 0.5 * self.bent.min(1.0) + 0.8 * (self.lean - LEANT).clamp(0.0, 1.0);
            let slid = 3.0 * (self.slid - SLID).clamp(0.0, 0.5);
            0.06 * self.time + 0.2 * self.way + bent + motion + slid
        } else {
            3.0 - 0.25 * self.time
        }
    }
}

/// Runs `supervisor` from a push on.
#[must_use]
pub fn step(start: &Simulation, supervisor: &Supervisor) -> Stepped {
    let mut run = start.clone();
    run.set_supervisor(0, supervisor.clone());
    let (begun, x) = (run.time(), run.sensors(0).com[0]);
    let dt = run.world().settings().dt;
    let mut all = Stepped {
        stood: false,
        time: LONGEST,
        way: 0.0,
        bent: 0.0,
        lean: 0.0,
        motion: 0.0,
        slid: 0.0,
    };
    let mut bearing = Bearing::new(run.sensors(0));
    let (mut steps, mut steady) = (0.0, 0.0);
    while run.time() - begun < LONGEST {
        run.step();
        let now = run.sensors(0);
        steps += 1.0;
        all.bent += square(now.trunk_pitch());
        all.lean = all.lean.max(now.trunk_pitch().abs());
        bearing.observe(now, dt);
        if now.is_down() {
            break;
        }
        steady = if now.stands() && now.feet_apart() < 0.06 {
            steady + dt
        } else {
            0.0
        };
        if steady >= STEADY {
            all.stood = true;
            break;
        }
    }
    all.time = run.time() - begun;
    all.way = (run.sensors(0).com[0] - x).abs();
    all.bent /= steps;
    all.motion = bearing.motion();
    all.slid = bearing.slid();
    all
}

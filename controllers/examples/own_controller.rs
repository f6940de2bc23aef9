//! A controller of one's own, from type to timeline: `wave` holds still and swings an arm.
use aplomb_controllers::{registry, servo::Servo};
use aplomb_framework::{Result, contract::Contract, controller::Controller, model::Model};
use aplomb_framework::{registry::Spec, scenario::Scenario, simulation::Simulation};
use aplomb_framework::{sensors::Sensors, trajectory::EventKind};
use std::sync::Arc;

#[derive(Debug, Clone)]
#[rustfmt::skip]
struct Wave { contract: Contract, servo: Servo, pose: Vec<f64>, joint: usize, since: f64 }

#[derive(serde::Deserialize)]
#[rustfmt::skip]
struct WaveSpec { joint: String }

impl Spec for WaveSpec {
    const KIND: &'static str = "wave";
    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let joint = model.joint_index(&self.joint)?; // what can go wrong goes wrong here
        let (servo, pose) = (Servo::new(model, 1.0, 0.5), vec![0.0; model.joint_count()]);
        #[rustfmt::skip]
        let wave = Wave { contract, servo, pose, joint, since: 0.0 };
        Ok(Box::new(wave))
    }
}

impl Controller for Wave {
    fn contract(&self) -> &Contract {
        &self.contract
    }
    fn enter(&mut self, now: &Sensors) {
        self.since = now.time;
    }
    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.pose[self.joint] = 0.8 - 0.8 * (5.0 * (now.time - self.since)).cos(); // rad
        self.servo.track(now, &self.pose, 1.0, torques);
    }
    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
}

const REPERTOIRE: &str = r#"(name: "waver", fallback: "rest", controllers: [
    File("skills/balance.ron"), File("skills/rest.ron"),
    Here((kind: "wave", spec: (joint: "shoulder_r"), contract: (name: "wave", weight: 0,
        precondition: Posture([standing]), expected: Posture([standing]),
        postcondition: Posture([standing]), hold: 3.0))), // done after 3 s of it
])"#;

fn main() -> Result<()> {
    let registry = registry()
        .with::<WaveSpec>()
        .with_file("repertoires/waver.ron", REPERTOIRE);
    let mut scenario = Scenario::standing("humanoid", 6.0);
    scenario.characters[0].repertoire = Some("waver".to_owned());
    let mut simulation = Simulation::new(&scenario, &registry)?;
    simulation.run(1.0);
    simulation.command(0, "wave")?;
    simulation.run(5.0);
    for event in simulation.events() {
        if let EventKind::Switch { to, why, .. } = &event.kind {
            println!("{:5.2} s  {to} ({why})", event.time);
        }
    }
    assert!(simulation.outcome(0).standing, "still standing");
    Ok(())
}

//! A controller of one's own, from type to timeline: `wave` holds still and swings an arm.
use aplomb_controllers::registry;
use aplomb_controllers::servo::Servo;
use aplomb_framework::math::cos;
use aplomb_framework::prelude::*;

/// Contract, servos, target pose (rad, one a joint), the joint that swings.
#[derive(Debug, Clone)]
struct Wave(Contract, Servo, Vec<f64>, usize);

#[derive(serde::Deserialize)]
struct WaveSpec(String); // in a file: ("shoulder_r")

impl Spec for WaveSpec {
    const KIND: &'static str = "wave";
    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let joint = model.joint_index(&self.0)?; // what can go wrong goes wrong here
        let (servo, pose) = (Servo::new(model, 1.0, 1.0), vec![0.0; model.joint_count()]);
        Ok(Box::new(Wave(contract, servo, pose, joint)))
    }
}

impl Controller for Wave {
    fn contract(&self) -> &Contract {
        &self.0
    }
    fn enter(&mut self, _: &Sensors) {} // nothing to forget
    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        let Self(_, servo, pose, joint) = self;
        pose[*joint] = 0.8 - 0.8 * cos(5.0 * now.time);
        servo.track(now, pose, 1.0, torques); // N·m
    }
    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
}

const REPERTOIRE: &str = r#"(name: "waver", fallback: "rest", controllers: [
    File("skills/balance.ron"), File("skills/rest.ron"),
    Here((kind: "wave", spec: ("shoulder_r"), contract: (name: "wave", weight: 0,
        precondition: Posture([standing]), expected: Posture([standing]),
        postcondition: Posture([standing]), hold: 3.0))), // done after 3 s of it
])"#;

fn main() -> Result<()> {
    let known = registry()
        .with::<WaveSpec>()
        .with_file("repertoires/waver.ron", REPERTOIRE);
    let mut scenario = Scenario::standing("humanoid", 6.0);
    scenario.characters[0].repertoire = Some("waver".to_owned());
    let mut simulation = Simulation::new(&scenario, &known)?;
    simulation.command(0, "wave")?;
    simulation.run(scenario.duration);
    simulation
        .events()
        .iter()
        .for_each(|e| println!("{:.2} s {:?}", e.time, e.kind));
    assert!(simulation.outcome(0).standing, "still standing");
    Ok(())
}

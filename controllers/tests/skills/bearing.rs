//! The humanoid: human muscles, limbs that meet, and how he looks while he stands and steps.

use aplomb_controllers::registry;
use aplomb_framework::run::Simulation;
use aplomb_framework::scenario::{Scenario, ScheduledInput};

/// A run after a push of the trunk at 1 s, N·s, with what `see` is shown of every step.
fn pushed(impulse: f64, seconds: f64, mut see: impl FnMut(&Simulation)) -> Simulation {
    let mut scenario = Scenario::standing("humanoid", seconds);
    let push = ScheduledInput::push(1.0, "torso", impulse);
    scenario.events.push(push);
    let mut run = Simulation::new(&scenario, &registry()).unwrap();
    while run.time() < seconds {
        run.step();
        see(&run);
    }
    run
}

#[test]
fn light_pushes_are_stood_upright_by_the_ankles() {
    for impulse in [-20.0, 20.0] {
        let mut lean = 0.0f64;
        let run = pushed(impulse, 5.0, |run| {
            lean = lean.max(run.sensors(0).trunk_pitch().abs());
        });
        assert!(lean < 0.3, "{impulse} N·s: the trunk leans by {lean} rad");
        assert_eq!(super::switches(&run).len(), 1, "{impulse} N·s");
    }
}

#[test]
fn a_step_leaves_the_ground_before_it_goes_and_is_soon_over() {
    for impulse in [-60.0, 60.0] {
        let (mut lifted, mut highest) = (None, 0.0f64);
        let run = pushed(impulse, 6.0, |run| {
            let now = run.sensors(0);
            assert!(!now.is_down(), "{impulse} N·s");
            let off = now.feet.iter().position(|f| !f.touching());
            if off.is_some() && now.time > 1.0 && lifted.is_none() {
                lifted = Some(now.time);
            }
            for foot in &now.model.feet {
                let ends = [foot.heel, foot.toe].map(|p| now.kinematics.point(foot.link, p)[1]);
                highest = highest.max(ends[0].min(ends[1]));
            }
        });
        let lifted = lifted.unwrap() - 1.0;
        assert!(lifted > 0.1 && lifted < 0.3, "{impulse} N·s: {lifted} s");
        assert!(highest > 0.02, "{impulse} N·s: {highest} m");
        assert!(run.outcome(0).standing, "{impulse} N·s");
    }
}

#[test]
fn no_torque_is_beyond_the_muscles_at_their_speed() {
    let mut worked = 0;
    pushed(-150.0, 6.0, |run| {
        let (now, actor) = (run.sensors(0), &run.actors()[0]);
        for ((joint, rate), peak) in now
            .model
            .joints()
            .zip(now.state.rates())
            .zip(&actor.peak_torque)
        {
            let [least, greatest] = joint.muscles.limits();
            assert!(*peak <= greatest.max(-least), "{}: {peak} N·m", joint.name);
            let [least, greatest] = joint.muscles.range(*rate);
            assert!(least <= 0.0 && greatest >= 0.0);
            worked += usize::from(greatest < 0.5 * joint.muscles.positive.torque);
        }
    });
    assert!(worked > 100, "some joints turn fast: {worked}");
}

//! Parameters of a scenario in props, hinges and commands.

use aplomb_framework::input::Source;
use aplomb_framework::scenario::Scenario;

use super::{SCENARIO, changed, check_refusal, line_of, simulation};

/// A ball is thrown, a bag hangs in the air.
const THROWN: &str = r#"(
    name: "thrown",
    duration: 1.0,
    characters: [(character: "humanoid", repertoire: "pair", start: (x: -10))],
    parameters: {
        "mass": (default: 7, min: 0.5, max: 20),
        "speed": 6,
        "height": (default: 1.25, min: 1),
        "hold": 200,
    },
    props: [
        (name: "ball", shape: Capsule(radius: 0.1, from: (0, 0), to: (0, 0)),
            mass: "mass", position: (3, "height"), velocity: ("-speed", 0.5), grip: "hold"),
        (name: "bag", shape: Box(half: (0.15, 0.4), centre: (0, 0)), mass: 30.0, position: (1, 1.3)),
        (name: "beam", shape: Box(half: (0.5, 0.05), centre: (0, 0)), mass: 0, position: (1, 2.5)),
    ],
    joints: [
        (prop: "bag", at: (0, 0.4), to: "beam", to_at: (0, -0.8), breaks: "hold"),
    ],
    events: [Command(at: 0.2, text: "wave")],
)
"#;

fn thrown() -> Scenario {
    Scenario::parse(&Source::new("thrown.ron", THROWN)).unwrap()
}

#[test]
fn parameters_reach_props_and_hinges() {
    let mut scenario = thrown();
    assert_eq!(scenario.parameter("mass"), Some(7.0));
    assert_eq!(scenario.parameter("weight"), None);
    let ball = scenario.prop(&scenario.props[0]).unwrap();
    assert_eq!((ball.mass, ball.grip, ball.friction), (7.0, 200.0, 1.0));
    assert_eq!((ball.position, ball.velocity), ([3.0, 1.25], [-6.0, 0.5]));
    for (name, value) in [("mass", 5.0), ("speed", 8.0), ("hold", 300.0)] {
        scenario.set(name, value).unwrap();
    }
    let ball = scenario.prop(&scenario.props[0]).unwrap();
    assert_eq!(
        (ball.mass, ball.velocity, ball.grip),
        (5.0, [-8.0, 0.5], 300.0)
    );
    let hinge = scenario.hinge(&scenario.joints[0]).unwrap();
    assert_eq!((hinge.prop, hinge.to, hinge.breaks), (1, Some(2), 300.0));
}

#[test]
fn a_hinge_without_its_other_point_is_where_the_prop_is() {
    let text = changed(THROWN, "to: \"beam\", to_at: (0, -0.8), ", "");
    let text = changed(
        &text,
        "position: (1, 1.3)",
        "position: (1, 1.3), angle: 0.5",
    );
    let scenario = Scenario::parse(&Source::new("thrown.ron", text)).unwrap();
    let hinge = scenario.hinge(&scenario.joints[0]).unwrap();
    let (sin, cos) = 0.5_f64.sin_cos();
    let expected = [1.0 - 0.4 * sin, 1.3 + 0.4 * cos];
    let off = (hinge.to_at[0] - expected[0]).hypot(hinge.to_at[1] - expected[1]);
    assert!(hinge.to.is_none() && off < 1e-12, "{hinge:?}");
}

#[test]
fn values_out_of_bounds_are_refused_in_the_file_and_when_set() {
    for (name, value, message) in [
        ("mass", 21.0, "parameters.mass is 21; accepted: 0.5 to 20"),
        ("mass", f64::NAN, "parameters.mass is NaN"),
        (
            "height",
            0.5,
            "parameters.height is 0.5; accepted: 1 to 1000000",
        ),
        (
            "height",
            2e3,
            "props[0].position[1] is 2000 (by the parameter 'height')",
        ),
        (
            "hold",
            -1.0,
            "props[0].grip is -1 (by the parameter 'hold')",
        ),
        ("hold", 0.0, "joints[0].breaks is 0"),
        ("sped", 1.0, "did you mean 'speed'"),
    ] {
        let mut scenario = thrown();
        let refusal = scenario.set(name, value).unwrap_err().to_string();
        assert!(refusal.contains(message), "{name}={value}: {refusal}");
        assert_eq!(scenario, thrown(), "{name}={value} leaves it as it was");
    }
    for (from, to, line, message) in [
        (
            "default: 7",
            "default: 70",
            "70",
            "parameters.mass.default is 70; accepted: 0.5 to 20",
        ),
        ("min: 0.5, max", "min: 5, most", "most", "'most'"),
        (
            "min: 0.5",
            "min: 25",
            "25",
            "parameters.mass.min is 25; accepted: -1000000 to 20",
        ),
        ("max: 20", "max: inf", "inf", "parameters.mass.max is inf"),
        (
            "\"speed\": 6",
            "\"speed\": \"6\"",
            "\"6\"",
            "a number or (default:",
        ),
        (
            "mass: \"mass\"",
            "mass: \"mas\"",
            "\"mas\"",
            "did you mean 'mass'",
        ),
        (
            "mass: \"mass\"",
            "mass: \"-mass\"",
            "\"-mass\"",
            "mass is -7 (by the parameter 'mass'); accepted: 0 to 1000000",
        ),
        (
            "\"-speed\"",
            "\"-sped\"",
            "\"-sped\"",
            "did you mean 'speed'",
        ),
        (
            "\"speed\": 6",
            "\"speed\": 1001",
            "\"-speed\"",
            "props[0].velocity[0] is -1001 (by the parameter 'speed')",
        ),
        (
            "to: \"beam\"",
            "to: \"beem\"",
            "beem",
            "did you mean 'beam'",
        ),
        ("to: \"beam\"", "to: \"bag\"", "to: \"bag\"", "'bag' itself"),
        (
            "mass: 30.0",
            "mass: 0",
            "to: \"beam\"",
            "fixed like the prop",
        ),
        (
            "(0, -0.8)",
            "(0, -0.7)",
            "(0, -0.7)",
            "joints[0].to_at is (1, 1.8) in the world; accepted: at most 0.05 m",
        ),
        (
            "at: (0, 0.4)",
            "at: (0, NaN)",
            "(0, NaN)",
            "joints[0].at[1] is NaN",
        ),
        (
            "name: \"beam\"",
            "name: \"bag\"",
            "(prop: \"bag\"",
            "the name of several",
        ),
    ] {
        let text = changed(THROWN, from, to);
        let refusal = simulation(&text).unwrap_err().to_string();
        let place = line_of("shove.ron", &text, line);
        check_refusal(&refusal, &place, message, to);
    }
}

#[test]
fn commands_speak_of_parameters() {
    let scenario = Scenario::parse(&Source::new("shove.ron", SCENARIO)).unwrap();
    for (text, filled) in [
        ("bend", "bend"),
        ("bend depth={impulse}", "bend depth=30"),
        ("bend a={impulse} b={-impulse}", "bend a=30 b=-30"),
    ] {
        assert_eq!(scenario.filled(text).unwrap(), filled);
    }
    for (command, message) in [
        ("wave x={impluse}", "did you mean 'impulse'"),
        ("wave x={impulse", "a brace has no other"),
        ("wave x=impulse}", "a brace has no other"),
        ("wave x={impulse}", "'wave' takes no parameters"),
    ] {
        let text = changed(SCENARIO, "text: \"wave\"", &format!("text: \"{command}\""));
        let refusal = simulation(&text).unwrap_err().to_string();
        assert!(refusal.contains(message), "{command}: {refusal}");
    }
}

#[test]
fn the_thrown_ball_flies_and_the_bag_hangs() {
    let text = changed(THROWN, "\"hold\": 200", "\"hold\": 400");
    let mut run = simulation(&text).unwrap();
    run.run(0.2);
    let ball = run.world().prop_motion(0);
    let y = 1.25 + 0.5 * 0.2 - 0.5 * 9.81 * 0.04;
    assert!((ball.position[0] - 1.8).abs() < 1e-3 && (ball.position[1] - y).abs() < 3e-3);
    let bag = run.world().prop_motion(1);
    assert!((bag.position[1] - 1.3).abs() < 2e-3 && run.world().hinge_holds(0));
    let mut weak = simulation(&changed(THROWN, "\"hold\": 200", "\"hold\": 250")).unwrap();
    weak.run(0.3);
    assert!(!weak.world().hinge_holds(0), "it weighs 294 N");
}

#[test]
fn the_mind_closes_the_hands() {
    let closed = |grips: bool| {
        let pool = changed(
            super::REPERTOIRE,
            "spec: (",
            &format!("spec: (grips: {grips}, "),
        );
        let registry = super::registry();
        let model = aplomb_framework::character::Model::load("humanoid").unwrap();
        let source = Source::new("pair.ron", pool);
        let supervisor =
            aplomb_framework::control::repertoire::build(&source, None, &registry, &model).unwrap();
        let mut scenario = Scenario::standing("humanoid", 1.0);
        scenario.settings.gravity = 0.0;
        // A ball at the tips of the hands, above the thighs of somebody who bends.
        scenario.characters[0].start.angles = [("shoulder_r", 1.5), ("shoulder_l", 1.5)]
            .map(|(j, a)| (j.to_owned(), a))
            .into();
        let mut world = aplomb_framework::world::World::new(scenario.settings);
        let state = aplomb_framework::run::start_state(&model, &scenario.characters[0].start);
        world.spawn(&model, &state.unwrap());
        let hand = &model.hands[0];
        let [x, y] = world.sense(0).kinematics.point(hand.link, hand.tip);
        let ball = format!(
            "(name: \"ball\", shape: Capsule(radius: 0.1, from: (0, 0), to: (0, 0)), mass: 1, \
             grip: 100, position: ({}, {y}))",
            x + 0.135
        );
        scenario.props = vec![aplomb_framework::input::options().from_str(&ball).unwrap()];
        let cast = vec![(model, supervisor)];
        let mut run = aplomb_framework::run::Simulation::with_cast(&scenario, cast).unwrap();
        run.run(0.01);
        let sensed = run.sensors(0).props[0].held;
        assert_eq!(sensed, run.world().holds(0, 0));
        sensed
    };
    assert!(closed(true) && !closed(false));
}

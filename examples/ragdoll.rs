//! Temporary: recordings to look at.
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use aplomb::render;
use aplomb_framework::model::{Model, Shape};
use aplomb_framework::state::State;
use aplomb_framework::trajectory::{Cast, Event, EventKind, Header, Trajectory, push_character};
use aplomb_framework::world::{Prop, Settings, World};

fn run(seconds: f64, impulse: f64, two: bool) -> Trajectory {
    let model = Model::load("humanoid").unwrap();
    let mut world = World::new(Settings::default());
    let mut state = State::standing(&model);
    world.spawn(&model, &state);
    if two {
        state.q[0] = 1.1;
        world.spawn(&model, &state);
    }
    let names: Vec<String> = ["balance", "step", "protective_fall", "rest", "rise"]
        .map(String::from)
        .into();
    let props = if two {
        vec![]
    } else {
        vec![Prop {
            name: "crate".into(),
            shape: Shape::Box {
                half: [0.2, 0.2],
                centre: [0.0, 0.0],
            },
            mass: 5.0,
            position: [2.6, 0.2],
            angle: 0.0,
            velocity: [0.0, 0.0],
            friction: 0.6,
            restitution: 0.0,
        }]
    };
    for p in &props {
        world.add_prop(p);
    }
    let cast = Cast {
        model: model.source.clone(),
        controllers: names.clone(),
    };
    let count = if two { 2 } else { 1 };
    let header = Header {
        scenario: if two {
            "two characters"
        } else {
            "push from behind"
        }
        .into(),
        seed: 7,
        dt: 1e-3,
        cast: vec![cast; count],
        props: props.clone(),
    };
    let mut t = Trajectory::new(header, vec![Arc::clone(&model); count]);
    let mut event = |time, kind| {
        t.events.push(Event {
            time,
            character: 0,
            kind,
        })
    };
    let push = |j| EventKind::Push {
        link: "torso".into(),
        impulse: [j, 0.0],
    };
    event(
        0.0,
        EventKind::Command {
            text: "stand".into(),
            accepted: true,
        },
    );
    event(0.6, push(0.3 * impulse));
    event(1.5, push(impulse));
    let mut active = 0;
    let mut fell = None;
    let mut events = vec![];
    if props.is_empty() {
        world.detect_contacts();
    }
    for step in 0..=(seconds * 1000.0) as usize {
        let time = step as f64 * 1e-3;
        let mut row = vec![];
        let mut torques = vec![];
        for who in 0..count {
            let s = world.sense(who).clone();
            if who == 0 {
                let next = if time < 1.58 {
                    0
                } else if time < 1.75 {
                    1
                } else if s.com[1] > 0.35 && active < 3 {
                    2
                } else if fell.is_some_and(|f| time > f + 4.0) {
                    4
                } else {
                    3
                };
                if next == 3 && fell.is_none() {
                    fell = Some(time);
                    events.push(Event {
                        time,
                        character: 0,
                        kind: EventKind::Fell,
                    });
                }
                if next != active {
                    events.push(Event {
                        time,
                        character: 0,
                        kind: EventKind::Switch {
                            from: Some(names[active].clone()),
                            to: names[next].clone(),
                            why: "x".into(),
                            bids: vec![],
                        },
                    });
                    active = next;
                }
            }
            push_character(
                &mut row,
                &s,
                (time < 1.75).then_some(0.04),
                if who == 0 { active } else { 0 },
            );
            let limp = who == 0 && active >= 3;
            let pitch = s.com[0] + 0.33 * s.com_velocity[0]
                - s.state.q[0].mul_add(0.0, 0.04 + if who == 1 { 1.1 } else { 0.0 });
            let torque: Vec<f64> = model
                .joints()
                .enumerate()
                .map(|(j, joint)| {
                    let goal = if active == 2 && who == 0 {
                        if joint.name.starts_with("shoulder") {
                            1.2
                        } else if joint.name.starts_with("knee") {
                            -0.8
                        } else if joint.name == "hip_r" {
                            0.9
                        } else {
                            0.2
                        }
                    } else if joint.name.starts_with("ankle") {
                        0.0
                    } else if joint.name.starts_with("elbow_r") {
                        0.3
                    } else {
                        0.0
                    };
                    let gain = if limp { 0.05 } else { 1.0 };
                    let mut x = gain * joint.kp * (goal - s.state.angles()[j])
                        - joint.kd * s.state.rates()[j] * gain.max(0.2);
                    if joint.name.starts_with("ankle") && !limp {
                        x -= 900.0 * pitch;
                    }
                    x.clamp(-joint.torque, joint.torque)
                })
                .collect();
            torques.push(torque);
        }
        for p in world.prop_poses() {
            row.extend(p);
        }
        t.push_row(&row);
        for (who, torque) in torques.iter().enumerate() {
            world.actuate(who, torque);
        }
        if step == 600 {
            world.push(0, 1, [0.3 * impulse, 0.0], 0.1);
        }
        if step == 1500 {
            world.push(0, 1, [impulse, 0.0], 0.1);
        }
        world.step();
    }
    t.events.extend(events);
    t.events.push(Event {
        time: seconds - 0.5,
        character: 0,
        kind: EventKind::Stood,
    });
    t.events.sort_by(|a, b| a.time.total_cmp(&b.time));
    t
}

fn main() {
    let out = Path::new("out");
    for (name, t) in [
        ("fall", run(10.0, 90.0, false)),
        ("two", run(5.0, -80.0, true)),
        ("short", run(0.5, 20.0, false)),
    ] {
        for file in ["svg", "png", "gif", "mp4"] {
            let start = Instant::now();
            let path = out.join(format!("{name}.{file}"));
            render::write(&t, &path, true).unwrap();
            println!(
                "{name}.{file}: {:?} {} kB",
                start.elapsed(),
                std::fs::metadata(&path).unwrap().len() / 1000
            );
        }
        for time in [0.3, 1.55, 2.0] {
            let step = t.step_at(time);
            let camera = render::Camera::following(&t, 0, step, [480.0, 300.0]).unwrap();
            let svg = render::frame(&t, step, &camera).unwrap();
            std::fs::write(
                out.join(format!("{name}-{time}.png")),
                render::png(&svg, 1.0).unwrap(),
            )
            .unwrap();
        }
    }
}

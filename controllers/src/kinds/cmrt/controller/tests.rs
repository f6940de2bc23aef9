use super::*;
use aplomb_framework::sensing::Sensors;

fn shipped(name: &str) -> (Arc<Model>, CmrtController) {
    let model = Model::load("humanoid").unwrap();
    let source = crate::registry().file(name).unwrap();
    let file = ControllerFile::parse(source).unwrap();
    let mut contract = file.contract.clone();
    contract.resolve(&model).unwrap();
    let spec: CmrtSpec = file.parameters().unwrap();
    let controller = spec.controller(contract, &model).unwrap();
    (model, controller)
}

#[test]
fn a_command_times_the_task_and_the_pose_is_reached_with_it() {
    let (model, bend) = shipped("clips/bend.ron");
    let slow = bend
        .clone()
        .commanded(&"bend duration=1.2".parse().unwrap())
        .unwrap();
    let hip = model.joint_index("hip_r").unwrap();
    let at = |controller: &CmrtController, time: f64| {
        let mut pose = vec![0.0; model.joint_count()];
        controller.pose_at(time, &mut pose);
        pose[hip]
    };
    assert_eq!(bend.length(), 2.6);
    assert_eq!(at(&bend, 0.9), at(&bend, 0.0));
    assert!((at(&bend, 1.4) - 2.2).abs() < 1e-9 && (at(&slow, 2.2) - 2.2).abs() < 1e-9);
    let half = 0.5 * (at(&bend, 0.0) + 2.2);
    assert!((at(&bend, 1.2) - half).abs() < 1e-9 && (at(&slow, 1.6) - half).abs() < 1e-9);
    assert!(bend.commanded(&"bend duration=9".parse().unwrap()).is_err());
}

/// The reference's displacement `time` s after the beginning, in the air, where nothing else moves it.
fn displacement(mut controller: CmrtController, model: &Arc<Model>, time: f64) -> f64 {
    let mut now = Sensors::new(model, 9.81);
    let mut torques = vec![0.0; model.joint_count()];
    controller.enter(&now);
    now.time += time;
    controller.act(&now, &mut torques);
    controller.reference_com().unwrap() - now.com[0]
}

#[test]
fn overlapping_motions_superpose() {
    let (model, both) = shipped("clips/duck_twice.ron");
    let only = |kept: usize| {
        let others = (0..4).filter(|i| *i != kept);
        others.fold(both.clone(), |c, i| c.with_cmrt(i, None))
    };
    let time = 1.9;
    let parts: Vec<f64> = (0..4)
        .map(|i| displacement(only(i), &model, time))
        .collect();
    let sum: f64 = parts.iter().sum();
    assert!(
        parts.iter().filter(|d| d.abs() > 1e-4).count() >= 2,
        "{parts:?}"
    );
    assert!((displacement(both, &model, time) - sum).abs() < 1e-12);
}

#[test]
fn a_bent_pose_has_a_pitch_that_keeps_a_foot_flat() {
    let (model, bend) = shipped("clips/bend.ron");
    let last = &bend.waypoints[bend.waypoints.len() - 1];
    let angle = |stem: &str| last.pose[model.joint_index(stem).unwrap()];
    let foot = last.pitch + angle("hip_r") + angle("knee_r") + angle("ankle_r");
    assert!(foot.abs() < 1e-9, "{foot}");
    assert!(last.height < 0.8 * bend.waypoints[0].height);
}

#[test]
fn hands_are_closed_in_their_phases_only() {
    let (model, catch) = shipped("clips/catch.ron");
    let grips = |time: f64| {
        let mut catch = catch.clone();
        let mut now = Sensors::new(&model, 9.81);
        catch.enter(&now);
        now.time += time;
        catch.act(&now, &mut vec![0.0; model.joint_count()]);
        catch.grips()
    };
    assert!(grips(1.5) && grips(2.9));
    assert!(!grips(catch.length() + 0.1));
}

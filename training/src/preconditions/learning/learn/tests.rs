use aplomb_framework::control::boundary::DecisionFunction;

use super::*;
use crate::preconditions::learning::synthetic::rings;

const SUBJECT: Subject = Subject {
    controller: "balance",
    character: "humanoid",
    seed: 7,
};

fn with_names(mut set: Dataset) -> Dataset {
    let names = ["com_velocity_x", "com_offset", "angle.knee_r"];
    set.features = names.map(str::to_owned).to_vec();
    set
}

fn sets() -> (Dataset, Dataset) {
    (with_names(rings(300, 3, 1)), with_names(rings(700, 3, 2)))
}

fn learned(kernels: &str, threads: usize) -> (LearnedPrecondition, Report) {
    let (train, test) = sets();
    let manual: Vec<bool> = test.rows.iter().map(|row| row[0].abs() < 1.0).collect();
    let settings = LearnSettings {
        kernels: Kernel::allowed(kernels).unwrap(),
        curve_sizes: vec![1, 100, 300, 1000],
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let go = |_| ControlFlow::Continue(());
    let work = || learn(SUBJECT, &train, &test, &manual, &settings, go);
    pool.unwrap().install(work).unwrap().unwrap()
}

fn without_times(
    (learned, mut report): (LearnedPrecondition, Report),
) -> (LearnedPrecondition, Report) {
    report.svm.train_s = 0.0;
    report.svm.choice_s = 0.0;
    report.svm.query_us = 0.0;
    report.nn.query_us = 0.0;
    report.curve.iter_mut().for_each(|p| p.train_s = 0.0);
    (learned, report)
}

#[test]
fn the_report_is_whole_and_the_same_on_any_number_of_threads() {
    let (one, two) = (learned("auto", 1), learned("auto", 2));
    let (learned, report) = &one;
    assert!(report.svm.metrics.balanced_accuracy > 0.9, "{report:?}");
    assert!(report.svm.metrics.accuracy > report.majority, "{report:?}");
    assert!(
        report.svm.auc > 0.95 && report.svm.log_loss < 0.3,
        "{report:?}"
    );
    assert!(report.nn.metrics.accuracy > 0.75, "{report:?}");
    assert!(report.svm.query_us > 0.0 && report.nn.query_us > 0.0);
    assert_eq!(report.svm.solver, "linfa-svm");
    // A ball is a polynomial of degree 2.
    assert!(report.svm.kernel.starts_with("poly"), "{report:?}");
    assert!(learned.calibration.slope < 0.0);
    let sizes: Vec<usize> = report.curve.iter().map(|p| p.train).collect();
    assert_eq!(sizes, [100, 300]);
    assert_eq!(report.curve[1].svm, report.svm.metrics.balanced_accuracy);
    assert!(report.manual.accuracy > 0.5 && report.manual.accuracy < 0.9);
    let slice = report.slice.as_ref().unwrap();
    assert_eq!((slice.x.0.as_str(), slice.x.1.len()), ("com_offset", 41));
    assert_eq!(
        (slice.y.0.as_str(), slice.y.1.len()),
        ("com_velocity_x", 41)
    );
    assert_eq!((slice.probability.len(), slice.samples.len()), (41, 500));
    assert!(slice.probability[20][20] > 0.9 && slice.probability[0][0] < 0.5);
    assert_eq!(without_times(one.clone()), without_times(two));
}

#[test]
fn a_radial_machine_is_learned_if_asked_for() {
    let (learned, report) = learned("rbf", 2);
    assert_eq!(report.svm.kernel, "rbf");
    assert!(matches!(
        learned.decision,
        DecisionFunction::Gaussian { .. }
    ));
    assert!(report.svm.metrics.balanced_accuracy > 0.85, "{report:?}");
}

#[test]
fn the_watch_may_end_the_work_at_every_step() {
    let (train, test) = sets();
    let manual = vec![true; test.rows.len()];
    let settings = LearnSettings {
        kernels: vec![Kernel::Linear, Kernel::Poly2],
        curve_sizes: vec![50],
    };
    for last in [Stage::Choice, Stage::Training, Stage::Testing, Stage::Curve] {
        let watch = |progress: LearningProgress| match progress.stage == last {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let ended = learn(SUBJECT, &train, &test, &manual, &settings, watch);
        assert_eq!(ended.unwrap(), None);
    }
}

#[test]
fn wrong_arguments_are_refused() {
    let (train, test) = sets();
    let settings = LearnSettings::default();
    let told = |train: &Dataset, manual: &[bool], settings: &LearnSettings| {
        let go = |_| ControlFlow::Continue(());
        let result = learn(SUBJECT, train, &test, manual, settings, go);
        result.unwrap_err().to_string()
    };
    let manual = vec![true; test.rows.len()];
    let found = told(&train, &manual[1..], &settings);
    assert!(found.contains("verdicts is 699; accepted: 700"), "{found}");
    let found = told(&test, &manual, &settings);
    assert!(found.contains("row is in both sets"), "{found}");
    let none = LearnSettings {
        kernels: Vec::new(),
        ..settings
    };
    let found = told(&train, &manual, &none);
    assert!(found.contains("kernels"), "{found}");
}

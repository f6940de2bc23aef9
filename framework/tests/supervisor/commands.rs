//! Commands, and supervisors within supervisors.

use aplomb_framework::control::{Condition, Controller, Supervisor};
use aplomb_framework::events::{EventKind, Found, Unmet};
use aplomb_framework::sensing::Sensors;

use super::common::Puppet;
use super::{DT, fallback, sensors, slower_than, supervisor, switches};

#[test]
fn no_command_overrides_a_failed_precondition() {
    let run = Puppet::new(
        "run",
        0,
        Condition::All(vec![Condition::Always, slower_than(0.5)]),
    );
    let (entries, obediences) = (run.entries(), run.obediences());
    let mut supervisor = supervisor(vec![run, fallback()]);
    let (mut now, mut torques) = (sensors(), vec![0.0; 12]);
    now.com_velocity[0] = 0.75;
    supervisor.command("run").unwrap();
    supervisor.act(&now, &mut torques);
    assert_eq!(supervisor.active(), Some("rest"));
    let unmet = Unmet {
        clause: "com_velocity_x ≤ 0.5".to_owned(),
        found: Found::Value(0.75),
    };
    let refused = EventKind::Refused {
        command: "run".to_owned(),
        controller: Some("run".to_owned()),
        unmet,
    };
    assert!(supervisor.take_events().contains(&(0.0, refused)));
    assert_eq!(
        (entries(), obediences()),
        (0, 0),
        "a refused command leaves no trace"
    );
    // The refusal is final: the command isn't kept for better times.
    now.com_velocity[0] = 0.0;
    now.time = DT;
    supervisor.act(&now, &mut torques);
    assert_eq!((supervisor.active(), entries()), (Some("rest"), 0));
    supervisor.command("run").unwrap();
    supervisor.act(&now, &mut torques);
    assert_eq!(
        (supervisor.active(), entries(), obediences()),
        (Some("run"), 1, 1)
    );
}

#[test]
fn an_unknown_command_is_refused_with_the_nearest() {
    let mut supervisor = supervisor(vec![
        Puppet::new("step_forward", 3, Condition::Always),
        fallback(),
    ]);
    let refusal = supervisor.command("step_foward").unwrap_err().to_string();
    assert_eq!(
        refusal,
        "unknown command 'step_foward' (did you mean 'step_forward'?); known: step_forward, rest"
    );
    assert!(
        supervisor
            .command("step_forward length=1")
            .unwrap_err()
            .to_string()
            .contains("takes no parameters")
    );
    assert!(supervisor.command("").is_err());
}

#[test]
fn several_commands_in_one_step_are_all_answered_in_order() {
    let pool = vec![
        Puppet::new("a", 0, Condition::Always),
        Puppet::new("b", 0, slower_than(-1.0)),
        Puppet::new("c", 0, Condition::Always),
        fallback(),
    ];
    let mut supervisor = supervisor(pool);
    for text in ["a", "b", "c", "a", "c"] {
        supervisor.command(text).unwrap();
    }
    supervisor.act(&sensors(), &mut [0.0; 12]);
    let told = |(_, kind): &(f64, EventKind)| match kind {
        EventKind::Command {
            text,
            accepted: true,
        } => Some(format!("{text} obeyed")),
        EventKind::Refused { command, .. } => Some(format!("{command} refused")),
        _ => None,
    };
    let answers: Vec<String> = supervisor.take_events().iter().filter_map(told).collect();
    assert_eq!(
        answers,
        ["a obeyed", "b refused", "c obeyed", "a obeyed", "c obeyed"]
    );
    assert_eq!(supervisor.active(), Some("c"));
}

#[test]
fn a_supervisor_is_a_member_like_any_other() {
    let inner = || {
        let pool = vec![
            Puppet::new("slow", 5, slower_than(0.5)).with_torque(1.0),
            Puppet::new("hop", 0, Condition::Always).with_torque(2.0),
            Puppet::new("still", 1, Condition::Always).with_torque(3.0),
        ];
        let pool = pool.into_iter().map(Puppet::boxed).collect();
        Supervisor::new("inner", pool, "still").unwrap()
    };
    let pool: Vec<Box<dyn Controller>> = vec![Box::new(inner()), fallback().boxed()];
    let mut supervisor = Supervisor::new("outer", pool, "rest").unwrap();
    let (now, mut torques) = (sensors(), vec![0.0; 12]);
    supervisor.act(&now, &mut torques);
    assert_eq!((supervisor.active(), torques[0]), (Some("inner"), 1.0));
    let decisions = supervisor.take_events();
    let all: Vec<&str> = switches(&decisions).iter().map(|s| s.2).collect();
    assert_eq!(all, ["inner", "slow"]);
    supervisor.command("hop").unwrap();
    supervisor.act(&now, &mut torques);
    assert_eq!((supervisor.active(), torques[0]), (Some("inner"), 2.0));
    let clone = supervisor.clone_box();
    assert_eq!(clone.contract(), supervisor.contract());
    assert!(
        supervisor
            .command("hopp")
            .unwrap_err()
            .to_string()
            .contains("'hop'")
    );
}

/// A command that an outer supervisor refuses must not come into force when the inner one is
/// next entered.
#[test]
fn a_refused_command_is_not_carried_out_later() {
    let hop = Puppet::new("hop", 2, slower_than(0.5)).with_torque(2.0);
    let slow = Puppet::new("slow", 5, slower_than(0.4)).with_torque(1.0);
    let rest = Puppet::new("still", 1, Condition::Always).with_torque(3.0);
    let pool = vec![slow.boxed(), hop.boxed(), rest.boxed()];
    let inner = Supervisor::new("inner", pool, "still").unwrap();
    // The inner pool behind a gate of its own.
    let gated = Gated::new(inner, slower_than(0.5));
    let pool: Vec<Box<dyn Controller>> = vec![Box::new(gated), fallback().boxed()];
    let mut supervisor = Supervisor::new("outer", pool, "rest").unwrap();
    let (mut now, mut torques) = (sensors(), vec![0.0; 12]);
    now.com_velocity[0] = 0.9;
    supervisor.act(&now, &mut torques);
    supervisor.command("hop").unwrap();
    now.time = DT;
    supervisor.act(&now, &mut torques);
    let refused = |(_, kind): &(f64, EventKind)| matches!(kind, EventKind::Refused { .. });
    assert!(supervisor.take_events().iter().any(refused));
    now.com_velocity[0] = 0.0;
    for step in 2..200 {
        now.time = f64::from(step) * DT;
        supervisor.act(&now, &mut torques);
    }
    assert_eq!(
        torques[0],
        1.0,
        "`slow` has won; nobody hops: {:?}",
        supervisor.take_events()
    );
}

/// A controller behind a pre-condition of its own.
#[derive(Debug, Clone)]
struct Gated {
    contract: aplomb_framework::control::Contract,
    inner: Supervisor,
}

impl Gated {
    fn new(inner: Supervisor, precondition: Condition) -> Self {
        let mut contract = inner.contract().clone();
        contract.precondition = precondition;
        Self { contract, inner }
    }
}

impl Controller for Gated {
    fn contract(&self) -> &aplomb_framework::control::Contract {
        &self.contract
    }
    fn enter(&mut self, now: &Sensors) {
        self.inner.enter(now);
    }
    fn act(&mut self, now: &Sensors, torques: &mut [f64]) {
        self.inner.act(now, torques);
    }
    fn clone_box(&self) -> Box<dyn Controller> {
        Box::new(self.clone())
    }
    fn obey(
        &mut self,
        command: &aplomb_framework::control::Command,
    ) -> aplomb_framework::Result<bool> {
        self.inner.obey(command)
    }
}

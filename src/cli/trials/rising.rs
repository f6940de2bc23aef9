//! When a character that was down stands again.
//!
//! whether it stands, whether it fell, every step → the time from down to standing.

use aplomb::framework::run::STANDING_FOR;
use aplomb::framework::sensing::Sensors;

/// Watches one trial. Asks what is sensed, not the run's events: a heap that comes down on its feet
/// and rises from there has never fallen, so that the run does not note that it stood.
#[derive(Debug, Clone, Copy)]
pub(super) struct RisingRecord {
    /// s
    down_since: Option<f64>,
    /// Without a break, s.
    standing_since: Option<f64>,
    /// s
    took: Option<f64>,
}

impl RisingRecord {
    /// Of a character that begins upright, or as a heap on the floor: the heap's time counts from
    /// the start.
    pub(super) fn new(fallen: bool) -> Self {
        Self {
            down_since: fallen.then_some(0.0),
            standing_since: None,
            took: None,
        }
    }

    /// It falls.
    pub(super) fn fell(&mut self, now: &Sensors) {
        self.down_since.get_or_insert(now.time);
    }

    /// Takes in a step; whether it has just proved, standing for long enough, that it is up again.
    pub(super) fn observe(&mut self, now: &Sensors) -> bool {
        if !now.stands() {
            self.standing_since = None;
            return false;
        }
        let since = *self.standing_since.get_or_insert(now.time);
        if now.time - since < STANDING_FOR - 1e-9 {
            return false;
        }
        let Some(down) = self.down_since.take() else {
            return false;
        };
        self.took.get_or_insert(since - down);
        true
    }

    /// The time from the first fall, or of a heap from the start, to standing, s; none if it never
    /// got up.
    pub(super) fn took(&self) -> Option<f64> {
        self.took
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use aplomb::framework::character::Model;
    use aplomb::framework::run::Simulation;
    use aplomb::framework::scenario::Scenario;

    /// Standing from the first to before the second time of each pair, s; else in the air. Falls
    /// at `falls`.
    fn rising(fallen: bool, stands: &[[f64; 2]], falls: &[f64]) -> RisingRecord {
        let model = Model::load("humanoid").unwrap();
        let scenario = Scenario::standing("humanoid", 1.0);
        let registry = aplomb::controllers::registry();
        let mut run = Simulation::new(&scenario, &registry).unwrap();
        run.run(0.1);
        let mut up = run.sensors(0).clone();
        assert!(up.stands());
        let mut down = Sensors::new(&model, 9.81);
        let mut rising = RisingRecord::new(fallen);
        for step in 0..600 {
            let time = 0.01 * f64::from(step);
            (up.time, down.time) = (time, time);
            if falls.iter().any(|t| (t - time).abs() < 1e-6) {
                rising.fell(&down);
            }
            let standing = stands
                .iter()
                .any(|[a, b]| time > a - 1e-6 && time < b - 1e-6);
            rising.observe(if standing { &up } else { &down });
        }
        rising
    }

    fn assert_took(rising: RisingRecord, seconds: f64) {
        let took = rising.took().unwrap();
        assert!((took - seconds).abs() < 1e-9, "{took}");
    }

    #[test]
    fn the_time_is_from_the_fall_to_the_moment_it_stands() {
        assert_took(rising(false, &[[0.0, 1.0], [3.0, 6.0]], &[1.5]), 1.5);
        assert_eq!(rising(false, &[[0.0, 6.0]], &[]).took(), None);
        assert_eq!(rising(false, &[[0.0, 1.0]], &[1.5]).took(), None);
    }

    #[test]
    fn standing_for_less_than_a_second_is_not_up() {
        assert_took(rising(false, &[[2.0, 2.9], [3.5, 6.0]], &[1.0]), 2.5);
        assert_eq!(rising(false, &[[5.5, 6.0]], &[1.0]).took(), None);
    }

    #[test]
    fn a_heap_counts_from_the_start_whether_it_ever_fell_or_not() {
        assert_took(rising(true, &[[2.0, 6.0]], &[]), 2.0);
        assert_took(rising(true, &[[2.0, 6.0]], &[0.1]), 2.0);
        assert_took(rising(true, &[[0.0, 0.5], [2.0, 6.0]], &[0.7]), 2.0);
    }

    #[test]
    fn a_second_fall_changes_nothing() {
        let stands = [[1.0, 2.2], [4.5, 6.0]];
        assert_took(rising(false, &stands, &[0.5, 2.5]), 0.5);
        assert_took(rising(true, &stands, &[2.5]), 1.0);
    }

    #[test]
    fn it_is_up_as_soon_as_a_run_calls_it_standing() {
        let scenario = Scenario::standing("humanoid", 2.0);
        let mut run = Simulation::new(&scenario, &aplomb::controllers::registry()).unwrap();
        let mut rising = RisingRecord::new(true);
        let mut proved = 0;
        for _ in 0..1500 {
            run.step();
            proved += u32::from(rising.observe(run.sensors(0)));
            assert_eq!(run.outcome(0).standing, rising.took().is_some());
        }
        assert_eq!(proved, 1);
    }
}

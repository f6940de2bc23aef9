//! Random characters.

use aplomb_framework::character::Model;
use aplomb_framework::input::Source;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A random tree with `joints` joints whose masses and inertias spread over `decades` decades.
pub(crate) fn random_tree(seed: u64, joints: usize, decades: f64) -> Model {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut links = String::new();
    for i in 0..=joints {
        let point = |rng: &mut ChaCha8Rng| {
            let (x, y): (f64, f64) = (rng.gen_range(-0.8..0.8), rng.gen_range(-0.8..0.8));
            format!("({x:?}, {y:?})")
        };
        let spread = |rng: &mut ChaCha8Rng| 10f64.powf(decades * rng.gen_range(-0.5..0.5));
        let joint = if i == 0 {
            String::new()
        } else {
            let parent = rng.gen_range(0..i);
            let anchor = point(&mut rng);
            format!(
                "joint: (name: \"j{i}\", parent: \"l{parent}\", anchor: {anchor}, \
                 range: (-3.0, 3.0), torque: 50.0, kp: 50.0, kd: 1.0),"
            )
        };
        let (mass, inertia) = (2.0 * spread(&mut rng), 0.2 * spread(&mut rng));
        let com = point(&mut rng);
        links += &format!(
            "(name: \"l{i}\", {joint} mass: {mass:?}, com: {com}, inertia: {inertia:?}, \
             shape: Capsule(radius: 0.05, from: (0.0, 0.0), to: (0.0, -0.2))),\n"
        );
    }
    let text = format!(
        "(name: \"tree\", trunk: \"l0\", head: \"l0\", \
         feet: [(link: \"l{joints}\", heel: (-0.1, 0.0), toe: (0.1, 0.0))], links: [\n{links}])"
    );
    Model::parse(&Source::new("random tree", text)).unwrap()
}

//! Bends at durations between those for which trajectories were learned.

use anyhow::Result;

use super::clips::ClipFigures;
use crate::cli::clips::load;
use crate::cli::reproduce::page::Page;
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;

pub(super) const STUDY: Study = Study {
    name: "interpolation",
    about: "bends at durations between the learned ones: where interpolated trajectories succeed",
    takes: ["10 s", "1 minute"],
    run,
};

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Interpolation",
        "The bend of the clip `bend` at durations of its task for which no trajectory was learned: knots and
         control points are interpolated between the two learned ones next to it. A duration succeeds if at least 18
         of 20 slightly different starts do (see `clips`). Nothing is searched anew here, so where it fails this does
         not tell whether a trajectory of its own would succeed.",
    );
    let learned = load("bend", &[], None)?.learned_values();
    let (seed, step) = (work.settings.seed, work.size(0.2, 0.05));
    let ends = learned.first().zip(learned.last());
    let [low, high] = ends.map_or([0.0; 2], |(low, high)| [*low, *high]);
    let mut rows = Vec::new();
    let [mut good, mut bad] = [Vec::new(), Vec::new()];
    for i in 0..=((high - low) / step).round() as u32 {
        let duration = (1e6 * (low + step * f64::from(i))).round() / 1e6;
        let found: [ClipFigures; 1] = work.command(&format!(
            "aplomb clips bend --set duration={duration} --seed {seed}"
        ))?;
        let [clip] = found;
        let Some(judged) = clip.learned else { continue };
        let is_learned = learned.iter().any(|l| (l - duration).abs() < 1e-9);
        if !is_learned {
            let list = if judged.succeeds { &mut good } else { &mut bad };
            list.push(format!("{duration} s"));
        }
        rows.push(vec![
            format!("{duration} s"),
            (if is_learned { "learned" } else { "between" }).to_owned(),
            judged.told(),
            (if judged.succeeds { "yes" } else { "**no**" }).to_owned(),
            format!("{:.3}", judged.objective),
            format!("{:.3}", judged.cop_norm),
        ]);
    }
    page.paragraph(&format!(
        "Durations between the learned ones: {} tried, {} succeed. It fails at: {}.",
        good.len() + bad.len(),
        good.len(),
        if bad.is_empty() {
            "none".to_owned()
        } else {
            bad.join(", ")
        }
    ));
    page.table(
        &[
            "duration",
            "trajectory",
            "starts that succeed",
            "succeeds",
            "objective",
            "CoP",
        ],
        &rows,
    );
    Ok(page)
}

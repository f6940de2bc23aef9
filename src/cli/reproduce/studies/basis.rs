//! Searches for trajectories in the few dimensions of a basis, beside searches in all.

use anyhow::Result;
use serde::Deserialize;

use crate::cli::reproduce::page::{Page, decimals, percent};
use crate::cli::reproduce::study::Study;
use crate::cli::reproduce::work::Work;

pub(super) const STUDY: Study = Study {
    name: "basis",
    about: "a search for trajectories in the principal components of a family, beside a full one",
    takes: ["30 s", "6 minutes"],
    run,
};

/// Where the files of the searches go; they are not shipped.
const FOLDER: &str = "out/reproduce";
/// The search in few dimensions is as good as the full one when it is within this part of it.
const WITHIN: f64 = 0.034;

/// What `aplomb train basis --json` tells.
#[derive(Debug, Deserialize)]
struct BasisFigures {
    values: Vec<f64>,
    components: usize,
    explained: Vec<f64>,
}

/// What `aplomb train cmrt --json` tells.
#[derive(Debug, Deserialize)]
struct SearchFigures {
    evaluations: usize,
    course: Vec<(usize, f64)>,
}

impl SearchFigures {
    fn best(&self) -> f64 {
        self.course
            .last()
            .map_or(f64::NAN, |(_, objective)| *objective)
    }

    /// Evaluations until the best objective is at most this.
    fn until(&self, objective: f64) -> Option<usize> {
        let reached = self.course.iter().find(|(_, best)| *best <= objective);
        reached.map(|(evaluations, _)| *evaluations)
    }
}

fn run(work: &mut Work<'_>) -> Result<Page> {
    let mut page = Page::new(
        "Basis",
        "The principal components of trajectories learned for slabs of several masses (`push`), and
         searches for other masses in three of them instead of in all eight knots and control points. Both begin
         with the shipped trajectory, have the same seed and end when 100 evaluations bring less than 5 %. An
         objective is the best that the search has seen, averaged over two starts; least is best. It is one search
         each: another seed gives other numbers, and what making the family cost is not counted. *Never*: the search in few dimensions
         ended before it was as good.",
    );
    let seed = work.settings.seed;
    let (count, evaluations, least) = work.size((3, 12, 1), (7, 3000, 200));
    let file = format!("{FOLDER}/push.{count}.{seed}.basis.ron");
    let basis: BasisFigures = work.command(&format!(
        "aplomb train basis push --over mass=33..153 --count {count} --components 3 \
         --evaluations {evaluations} --least {least} --seed {seed} --out {file}"
    ))?;
    let explained = basis.explained.iter().take(basis.components);
    let explained: Vec<String> = explained.map(|part| percent(*part)).collect();
    page.paragraph(&format!(
        "The family: {} masses from 33 to 153 kg. Its components explain {} of the variance.",
        basis.values.len(),
        explained.join(", ")
    ));
    let masses: &[u32] = work.size(&[110], &[60, 90, 110, 150]);
    let (evaluations, least) = work.size((20, 1), (3000, 100));
    let mut rows = Vec::new();
    for mass in masses {
        let mut search = |name: &str, more: &str| -> Result<SearchFigures> {
            work.command(&format!(
                "aplomb train cmrt push --set mass={mass} --warm --evaluations {evaluations} \
                 --least {least} --seed {seed} --out {FOLDER}/push.{mass}.{name}.ron{more}"
            ))
        };
        let full = search("full", "")?;
        let reduced = search("reduced", &format!(" --basis {file}"))?;
        let goal = full.best() * (1.0 + WITHIN);
        let until = |s: &SearchFigures| s.until(goal).map_or("never".to_owned(), |n| n.to_string());
        rows.push(vec![
            format!("{mass} kg"),
            full.evaluations.to_string(),
            decimals(Some(full.best()), 3),
            reduced.evaluations.to_string(),
            decimals(Some(reduced.best()), 3),
            format!("{:+.1} %", 100.0 * (reduced.best() / full.best() - 1.0)),
            until(&full),
            until(&reduced),
        ]);
    }
    page.table(
        &[
            "mass",
            "full: evaluations",
            "objective",
            "reduced: evaluations",
            "objective",
            "reduced against full, + is worse",
            "full: evaluations to within 3.4 % of its best",
            "reduced: to the same",
        ],
        &rows,
    );
    Ok(page)
}

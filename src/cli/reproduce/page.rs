//! A study's page in Markdown.
//!
//! what it measures, paragraphs, tables, the parts it is made from → text.

use std::fmt::Write;

use super::work::{StudySettings, Used};

/// A figure that README shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Highlight {
    pub(super) what: String,
    pub(super) figure: String,
}

/// What a study found.
#[derive(Debug, Default)]
pub(super) struct Page {
    title: &'static str,
    text: String,
    pub(super) highlights: Vec<Highlight>,
}

impl Page {
    /// Begins with what the study measures, how to read it, and what is not measured.
    pub(super) fn new(title: &'static str, about: &str) -> Self {
        Self {
            title,
            text: format!("{}\n", joined(about)),
            highlights: Vec::new(),
        }
    }

    /// Adds a paragraph.
    pub(super) fn paragraph(&mut self, text: &str) {
        self.text += &format!("\n{}\n", joined(text));
    }

    /// Adds a table; numbers are to the right, the first column is not.
    pub(super) fn table(&mut self, headings: &[&str], rows: &[Vec<String>]) {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let headings: Vec<String> = headings.iter().map(|h| (*h).to_owned()).collect();
        let marks = (0..headings.len()).map(|i| if i == 0 { "---" } else { "---:" });
        self.text += &format!(
            "\n{}|{}|\n",
            line(&headings),
            marks.collect::<Vec<_>>().join("|")
        );
        self.text.extend(rows.iter().map(|row| line(row)));
    }

    /// Adds a figure for README.
    pub(super) fn highlight(&mut self, what: impl Into<String>, figure: impl Into<String>) {
        let (what, figure) = (what.into(), figure.into());
        self.highlights.push(Highlight { what, figure });
    }

    /// The whole page.
    pub(super) fn markdown(&self, study: &str, settings: StudySettings, used: &[Used]) -> String {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let newest = used.iter().map(|u| u.date.as_str()).max();
        let newest = newest.unwrap_or("nothing was run");
        let mut page = format!("# {}\n\n", self.title);
        let option = if settings.quick { " --quick" } else { "" };
        let jobs = used.iter().map(|u| u.jobs).max().unwrap_or(0);
        let _ = writeln!(
            page,
            "Written by `aplomb reproduce {study}{option} --seed {}`: version {}, {newest}, {cores} cores, {jobs} jobs.",
            settings.seed,
            env!("CARGO_PKG_VERSION"),
        );
        if settings.quick {
            page += "**A quick run with small counts: it shows that the study works, its figures say little.**\n";
        }
        page += &format!("\n{}", self.text);
        if !used.is_empty() {
            page += "\n## How it was made\n\n| command | took |\n|---|---:|\n";
            for used in used {
                let (command, note) = match used.command.split_once(" (") {
                    Some((command, note)) => (command, format!(" ({note}")),
                    None => (used.command.as_str(), String::new()),
                };
                let _ = writeln!(page, "| `{command}`{note} | {:.0} s |", used.wall_s);
            }
        }
        page
    }
}

/// The lines of a text in the source as one.
fn joined(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// `97.5 %`.
pub(super) fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// A number with so many decimals; a dash if there is none.
pub(super) fn decimals(value: Option<f64>, decimals: usize) -> String {
    value.map_or("–".to_owned(), |x| format!("{x:.decimals$}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_names_its_seed_its_date_and_its_commands() {
        let mut page = Page::new("Of pushes", "How hard\n   they are.");
        page.table(&["way", "N·s"], &[vec!["forward".into(), "40".into()]]);
        let used = Used {
            command: "aplomb run --push I (I = 1)".into(),
            date: "2026-01-31".into(),
            wall_s: 2.4,
            jobs: 2,
        };
        let settings = StudySettings {
            quick: false,
            seed: 5,
        };
        let text = page.markdown("pushes", settings, &[used]);
        for part in [
            "# Of pushes\n",
            "`aplomb reproduce pushes --seed 5`",
            "2026-01-31",
            "2 jobs",
            "\nHow hard they are.\n",
            "| way | N·s |\n|---|---:|\n| forward | 40 |\n",
            "| `aplomb run --push I` (I = 1) | 2 s |",
        ] {
            assert!(text.contains(part), "{part} is not in\n{text}");
        }
        assert!(!text.contains("quick"));
    }
}

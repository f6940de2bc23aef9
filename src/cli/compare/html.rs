//! The comparison as one page: tables, and for every controller its figures. It needs nothing that
//! is not in it: no script, no font, no picture from elsewhere.

use anyhow::{Context, Result};
use aplomb::render::comparison::{Figure, figures};
use aplomb::training::preconditions::report::Report;

use super::read::ReportFile;
use super::table::{Table, both, name, short};

/// Fonts, spaces, and where paper may break.
const STYLE: &str = include_str!("page.css");
/// What every SVG file says and a page does not need.
const NAMESPACE: &str = " xmlns=\"http://www.w3.org/2000/svg\"";

/// The whole page.
pub(super) fn page(entries: &[ReportFile]) -> Result<String> {
    let mut body = String::from(
        "<h1>Learned pre-conditions</h1>\n<p>A pre-condition foretells whether a controller will \
         succeed from a situation. Compared on rollouts that none of them has seen: a support \
         vector machine (SVM), the nearest neighbour, the condition made by hand, and always \
         giving the answer that is more frequent in the training set (majority). Intervals are \
         Wilson's.</p>\n",
    );
    for table in both(entries.iter().map(|e| &e.report)) {
        body.push_str(&tabled(&table));
    }
    body.push_str("<nav>");
    for (k, entry) in entries.iter().enumerate() {
        let controller = escaped(&name(&entry.report.controller));
        body.push_str(&format!("<a href=\"#c{k}\">{controller}</a> "));
    }
    body.push_str("</nav>\n");
    for (k, entry) in entries.iter().enumerate() {
        let figures = figures(&entry.report)
            .with_context(|| format!("{} cannot be drawn", entry.path.display()))?;
        body.push_str(&section(k, &entry.report, &figures));
    }
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>Learned pre-conditions</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}\
         </body>\n</html>\n"
    ))
}

fn tabled(table: &Table) -> String {
    let class = |k: usize| match k < table.words {
        true => "",
        false => " class=\"number\"",
    };
    let mut text = format!(
        "<div class=\"wide\"><table>\n<caption>{}</caption>\n<thead><tr>",
        escaped(table.title)
    );
    for (k, heading) in table.headings.iter().enumerate() {
        let heading = escaped(heading);
        text.push_str(&format!("<th scope=\"col\"{}>{heading}</th>", class(k)));
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        text.push_str("<tr>");
        for (k, cell) in row.iter().enumerate() {
            text.push_str(&format!("<td{}>{}</td>", class(k), escaped(cell)));
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody>\n</table></div>\n");
    text
}

fn section(k: usize, report: &Report, figures: &[Figure]) -> String {
    let controller = escaped(&name(&report.controller));
    let mut text = format!(
        "<section id=\"c{k}\">\n<h2>{controller}</h2>\n{}",
        facts(report)
    );
    text.push_str("<div class=\"figures\">\n");
    for figure in figures {
        let label = format!(
            " role=\"img\" aria-label=\"{}, {controller}\"",
            figure.title
        );
        let svg = figure
            .svg
            .replacen(NAMESPACE, &label, 1)
            .replace(NAMESPACE, "");
        let (title, caption) = (figure.title, escaped(&figure.caption));
        text.push_str(&format!(
            "<figure>\n{svg}<figcaption><b>{title}.</b> {caption}</figcaption>\n</figure>\n"
        ));
    }
    text.push_str("</div>\n</section>\n");
    text
}

/// What the tables do not say.
fn facts(r: &Report) -> String {
    let svm = &r.svm;
    let features: Vec<String> = r.features.iter().map(|f| name(f)).collect();
    let facts = format!(
        "{}, seed {}. {} training samples, {:.1} % of them successes; {} test samples, {:.1} %. \
         SVM: {} kernel, C {}, gamma {} on standardised features, {} support vectors, log-loss of \
         the calibrated probability {:.3}; solved by {} in {} s after {} s of choosing kernel, C \
         and gamma. Features: {}.",
        name(&r.character),
        r.seed,
        r.train,
        100.0 * r.positive_rate,
        r.test,
        100.0 * r.test_positive_rate,
        name(&svm.kernel),
        short(svm.c),
        short(svm.gamma),
        svm.support_vectors,
        svm.log_loss,
        name(&svm.solver),
        short(svm.train_s),
        short(svm.choice_s),
        features.join(", ")
    );
    format!("<p>{}</p>\n", escaped(&facts))
}

/// What would otherwise be markup.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_no_markup() {
        assert_eq!(escaped("<b>\"&"), "&lt;b&gt;&quot;&amp;");
    }
}

//! Axes of a chart: grid, ticks and labels with units, even or logarithmic.

use svg::node::element::Group;

use super::Chart;
use crate::render::style::{
    FAINT_INK, FRAME, GRID, INK, line, nice_step, px, rectangle, text, tick_label,
};

/// Above so many decades only powers of ten are labelled.
const DECADES: f64 = 2.2;

/// 1, 2 and 5 times powers of ten, or those alone over a wide range, by their logarithm. The range is
/// one of logarithms.
pub(in crate::render) fn logarithmic([low, high]: [f64; 2]) -> Vec<(f64, String)> {
    let times: &[f64] = if high - low > DECADES {
        &[1.0]
    } else {
        &[1.0, 2.0, 5.0]
    };
    let powers = low.floor() as i32..=high.ceil() as i32;
    let values = powers.flat_map(|p| times.iter().map(move |t| (t, p)));
    values
        .map(|(t, p)| (p, t * 10_f64.powi(p)))
        .map(|(p, v)| (v.log10(), format!("{v:.0$}", (-p).max(0) as usize)))
        .filter(|(log, _)| (low..=high).contains(log))
        .collect()
}

/// Steps of 1, 2 or 5 times a power of ten, at most about `most` over the range.
pub(in crate::render) fn even([low, high]: [f64; 2], most: f64) -> Vec<(f64, String)> {
    let step = nice_step(high - low, most);
    let (first, last) = (low / step - 1e-9, high / step + 1e-9);
    let values = (first.ceil() as i64..=last.floor() as i64).map(|k| k as f64 * step);
    values.map(|v| (v, tick_label(v, step))).collect()
}

impl Chart {
    /// Grid, ticks, labels; `below` is the label of the x axis, if that is labelled as well.
    pub(in crate::render) fn axes(&self, label: &str, below: Option<&str>) -> Group {
        let ticks = even(self.span, self.size[0] / 75.0);
        Group::new()
            .add(self.rows(label))
            .add(self.columns(&ticks, below))
    }

    /// Grid, and the labels of the x axis, of a chart beside another with the same y axis.
    pub(in crate::render) fn inner_axes(&self, below: Option<&str>) -> Group {
        let up = even(self.value, (self.size[1] / 34.0).max(3.0));
        let up: Vec<_> = up.into_iter().map(|(v, _)| (v, String::new())).collect();
        let ticks = even(self.span, self.size[0] / 75.0);
        Group::new()
            .add(self.rows_at(&up, ""))
            .add(self.columns(&ticks, below))
    }

    /// Grid, ticks and label of the y axis.
    pub(in crate::render) fn rows(&self, label: &str) -> Group {
        let ticks = even(self.value, (self.size[1] / 34.0).max(3.0));
        self.rows_at(&ticks, label)
    }

    /// The same with ticks at some values.
    pub(in crate::render) fn rows_at(&self, ticks: &[(f64, String)], label: &str) -> Group {
        let [x, y] = self.at;
        let [width, height] = self.size;
        let mut group = Group::new();
        for (value, name) in ticks {
            let level = y + self.y(*value);
            let colour = if *value == 0.0 { FRAME } else { GRID };
            group = group
                .add(line([x, level], [x + width, level], colour, 1.0))
                .add(text([x - 7.0, level + 3.6], 10.5, INK, "end", name));
        }
        let middle = [x - 46.0, y + height / 2.0];
        let turn = format!("rotate(-90 {} {})", px(middle[0]), px(middle[1]));
        group.add(text(middle, 11.0, INK, "middle", label).set("transform", turn))
    }

    /// Grid and ticks of the x axis at some values; their labels and the axis's, if it has one.
    pub(in crate::render) fn columns(&self, ticks: &[(f64, String)], below: Option<&str>) -> Group {
        let bottom = self.at[1] + self.size[1];
        let mut group = Group::new();
        for (along, name) in ticks {
            let at = self.across(*along);
            group = group
                .add(line([at, self.at[1]], [at, bottom], GRID, 1.0))
                .add(line([at, bottom], [at, bottom + 4.0], INK, 1.0));
            if below.is_some() {
                group = group.add(text([at, bottom + 16.0], 10.5, INK, "middle", name));
            }
        }
        if let Some(below) = below {
            let at = [self.at[0] + self.size[0] / 2.0, bottom + 33.0];
            group = group.add(text(at, 11.0, INK, "middle", below));
        }
        group
    }

    /// The frame, drawn after everything else.
    pub(in crate::render) fn frame(&self) -> Group {
        let frame = rectangle(self.at, self.size, "none");
        Group::new().add(frame.set("stroke", FAINT_INK).set("stroke-width", 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithmic_ticks_are_labelled_as_plain_numbers() {
        let names = |range| -> Vec<String> {
            let ticks = logarithmic(range);
            ticks.into_iter().map(|(_, name)| name).collect()
        };
        assert_eq!(names([-1.1, 0.5]), ["0.1", "0.2", "0.5", "1", "2"]);
        assert_eq!(names([0.0, 3.0]), ["1", "10", "100", "1000"]);
    }
}

//! Samples of a controller's successes and failures, in memory and on disk.
//!
//! features of a situation, success ↔ CSV: a header of feature names whose last is `success`, then a
//! line a sample, with numbers that read back bit for bit and success as 0 or 1.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use aplomb_framework::control::boundary::MOST_FEATURES;
use aplomb_framework::input::{Error, Result, write_atomically};
use csv::{ReaderBuilder, StringRecord, WriterBuilder};

/// The most samples that are read.
pub const MOST_ROWS: usize = 2_000_000;
/// The largest file that is read: 4 GiB.
const LARGEST: u64 = 1 << 32;
/// Name of the last column.
const SUCCESS: &str = "success";

/// Situations in which a controller began, and whether it succeeded.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Dataset {
    /// Names of the features, in the order of the columns.
    pub features: Vec<String>,
    /// A row for every sample, a value for every feature, in the features' SI units.
    pub rows: Vec<Vec<f64>>,
    /// For every row, whether the controller succeeded.
    pub success: Vec<bool>,
}

impl Dataset {
    /// Reads a CSV file.
    ///
    /// # Errors
    /// [`Error::Read`] if there is no such regular file; [`Error::Invalid`] with line and column if
    /// the header does not end in `success` or names a column twice, a row is shorter or longer than
    /// the header (as the last of a truncated file is), a value is no finite number, success is
    /// neither 0 nor 1, or there are more than [`MOST_ROWS`] samples or [`MOST_FEATURES`] features.
    pub fn read(path: &Path) -> Result<Self> {
        let fail = |reason: String| Error::Read {
            path: path.to_owned(),
            reason,
        };
        let file = File::open(path).map_err(|e| fail(e.to_string()))?;
        let meta = file.metadata().map_err(|e| fail(e.to_string()))?;
        if !meta.is_file() || meta.len() > LARGEST {
            return Err(fail(format!(
                "it is no regular file of at most {LARGEST} bytes"
            )));
        }
        let mut reader = ReaderBuilder::new()
            .flexible(true)
            .has_headers(false)
            .from_reader(BufReader::new(file.take(LARGEST)));
        let mut records = reader.records();
        let header = match records.next() {
            Some(header) => header.map_err(|e| fail(e.to_string()))?,
            None => return Err(fail("it is empty; a header is the least".to_owned())),
        };
        let mut set = Self {
            features: features(path, &header)?,
            ..Self::default()
        };
        for record in records {
            let record = record.map_err(|e| fail(e.to_string()))?;
            if set.rows.len() == MOST_ROWS {
                let accepted = format!("at most {MOST_ROWS}");
                let place = path.display().to_string();
                return Err(Error::invalid(place, "samples", "more", accepted));
            }
            set.push(path, &record)?;
        }
        Ok(set)
    }

    /// Appends the sample of a line.
    fn push(&mut self, path: &Path, record: &StringRecord) -> Result<()> {
        let line = record.position().map_or(0, csv::Position::line);
        let place = || format!("{}:{line}", path.display());
        let columns = self.features.len() + 1;
        if record.len() != columns {
            let found = format!("{} values", record.len());
            let accepted = format!("{columns}, as many as the header has (is it cut short?)");
            return Err(Error::invalid(place(), "row", found, accepted));
        }
        let mut row = Vec::with_capacity(columns - 1);
        for (name, text) in self.features.iter().zip(record) {
            match text.trim().parse::<f64>() {
                Ok(value) if value.is_finite() => row.push(value),
                _ => {
                    let found = format!("'{}'", aplomb_framework::input::shortened(text));
                    return Err(Error::invalid(
                        place(),
                        name.as_str(),
                        found,
                        "a finite number",
                    ));
                }
            }
        }
        self.success.push(match record[columns - 1].trim() {
            "0" => false,
            "1" => true,
            other => {
                let found = format!("'{}'", aplomb_framework::input::shortened(other));
                return Err(Error::invalid(place(), SUCCESS, found, "0 or 1"));
            }
        });
        self.rows.push(row);
        Ok(())
    }

    /// Writes a CSV file whole or not at all.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the samples are not such as [`Dataset::read`] accepts; [`Error::Write`].
    pub fn write(&self, path: &Path) -> Result<()> {
        self.check_values(&path.display().to_string())?;
        let fail = |e: csv::Error| Error::Write {
            path: path.to_owned(),
            reason: e.to_string(),
        };
        let mut writer = WriterBuilder::new().from_writer(Vec::new());
        let header = self.features.iter().map(String::as_str).chain([SUCCESS]);
        writer.write_record(header).map_err(fail)?;
        for (row, success) in self.rows.iter().zip(&self.success) {
            for value in row {
                writer.write_field(format!("{value:?}")).map_err(fail)?;
            }
            let success = if *success { "1" } else { "0" };
            writer.write_field(success).map_err(fail)?;
            writer.write_record(None::<&[u8]>).map_err(fail)?;
        }
        let bytes = writer
            .into_inner()
            .map_err(|e| fail(e.into_error().into()))?;
        write_atomically(path, &bytes)
    }

    /// How many successes and how many failures there are.
    #[must_use]
    pub fn counts(&self) -> (usize, usize) {
        let successes = self.success.iter().filter(|s| **s).count();
        (successes, self.success.len() - successes)
    }

    /// Part of the samples that are successes; 0 without samples.
    #[must_use]
    pub fn positive_rate(&self) -> f64 {
        self.counts().0 as f64 / self.success.len().max(1) as f64
    }

    /// The first `count` samples, or all if there are fewer.
    #[must_use]
    pub fn head(&self, count: usize) -> Self {
        let count = count.min(self.rows.len());
        Self {
            features: self.features.clone(),
            rows: self.rows[..count].to_vec(),
            success: self.success[..count].to_vec(),
        }
    }

    /// Refuses samples from which no boundary can be learned or measured: values that are not
    /// finite, or fewer than two successes or failures. `place` is what messages call the set.
    ///
    /// # Errors
    /// [`Error::Invalid`].
    pub fn check(&self, place: &str) -> Result<()> {
        self.check_values(place)?;
        let (successes, failures) = self.counts();
        if successes.min(failures) < 2 {
            let found = format!("{successes} times 1 and {failures} times 0");
            let accepted = "each at least twice: a boundary needs both";
            return Err(Error::invalid(place, SUCCESS, found, accepted));
        }
        Ok(())
    }

    /// Refuses what [`Dataset::read`] would refuse in a file; line 2 is the first sample.
    fn check_values(&self, place: &str) -> Result<()> {
        check_names(place, &self.features)?;
        if self.rows.len() != self.success.len() || self.rows.len() > MOST_ROWS {
            let found = format!("{} rows, {} labels", self.rows.len(), self.success.len());
            let accepted = format!("as many of both, at most {MOST_ROWS}");
            return Err(Error::invalid(place, "samples", found, accepted));
        }
        for (i, row) in self.rows.iter().enumerate() {
            let line = || format!("{place}:{}", i + 2);
            if row.len() != self.features.len() {
                let found = format!("{} features", row.len());
                let accepted = self.features.len().to_string();
                return Err(Error::invalid(line(), "row", found, accepted));
            }
            if let Some(bad) = row.iter().position(|v| !v.is_finite()) {
                let (name, value) = (&self.features[bad], row[bad]);
                return Err(Error::invalid(
                    line(),
                    name.as_str(),
                    value,
                    "a finite number",
                ));
            }
        }
        Ok(())
    }
}

/// The features that a header names.
fn features(path: &Path, header: &StringRecord) -> Result<Vec<String>> {
    let place = format!("{}:1", path.display());
    let mut names: Vec<String> = header.iter().map(|n| n.trim().to_owned()).collect();
    let last = names.pop().unwrap_or_default();
    if last != SUCCESS {
        let found = format!("'{}'", aplomb_framework::input::shortened(&last));
        return Err(Error::invalid(place, "last column", found, SUCCESS));
    }
    check_names(&place, &names)?;
    Ok(names)
}

fn check_names(place: &str, names: &[String]) -> Result<()> {
    if names.is_empty() || names.len() > MOST_FEATURES {
        let accepted = format!("1 to {MOST_FEATURES}");
        return Err(Error::invalid(place, "features", names.len(), accepted));
    }
    let mut seen = BTreeSet::from([SUCCESS]);
    for name in names {
        if name.is_empty() || name.trim() != name || !seen.insert(name) {
            let found = format!("'{}'", aplomb_framework::input::shortened(name));
            let accepted = "names without spaces around them, each once, and success as the last";
            return Err(Error::invalid(place, "column", found, accepted));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn small() -> Dataset {
        Dataset {
            features: vec!["com_height".to_owned(), "angle.knee_r".to_owned()],
            rows: vec![
                vec![0.1 + 0.2, -0.0],
                vec![1e-300, 5e-324],
                vec![-1.5e300, 3.0],
                vec![4.0, 4.0],
            ],
            success: vec![true, false, true, false],
        }
    }

    fn refusal(text: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.csv");
        std::fs::write(&path, text).unwrap();
        Dataset::read(&path).unwrap_err().to_string()
    }

    proptest! {
        #[test]
        fn reads_back_bit_for_bit(values in proptest::collection::vec(proptest::num::f64::NORMAL
            | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO, 1..20)) {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("x.csv");
            let set = Dataset {
                features: vec!["a".to_owned()],
                success: values.iter().map(|v| *v > 0.0).collect(),
                rows: values.iter().map(|v| vec![*v]).collect(),
            };
            set.write(&path).unwrap();
            let back = Dataset::read(&path).unwrap();
            prop_assert_eq!(&back.success, &set.success);
            for (a, b) in back.rows.iter().zip(&set.rows) {
                prop_assert_eq!(a[0].to_bits(), b[0].to_bits());
            }
        }
    }

    #[test]
    fn the_file_is_plain() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.csv");
        let set = small();
        set.write(&path).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let start =
            "com_height,angle.knee_r,success\n0.30000000000000004,-0.0,1\n1e-300,5e-324,0\n";
        assert!(text.starts_with(start), "{text}");
        assert_eq!(Dataset::read(&path).unwrap(), set);
        assert_eq!(set.positive_rate(), 0.5);
        assert_eq!(set.head(1).counts(), (1, 0));
        assert_eq!(set.head(9), set);
    }

    #[test]
    fn wrong_files_are_refused_with_line_and_column() {
        for (text, told) in [
            ("", "it is empty"),
            (
                "a,b\n1,2\n",
                "x.csv:1: last column is 'b'; accepted: success",
            ),
            ("success\n1\n", "x.csv:1: features is 0"),
            ("a,a,success\n", "x.csv:1: column is 'a'"),
            ("success,success\n", "x.csv:1: column is 'success'"),
            (",success\n", "x.csv:1: column is ''"),
            (
                "a,success\n1,1\nNaN,0\n",
                "x.csv:3: a is 'NaN'; accepted: a finite",
            ),
            ("a,success\n1,1\ninf,0\n", "x.csv:3: a is 'inf'"),
            ("a,success\n1e999,0\n", "x.csv:2: a is '1e999'"),
            ("a,success\n,0\n", "x.csv:2: a is ''"),
            (
                "a,success\n1,2\n",
                "x.csv:2: success is '2'; accepted: 0 or 1",
            ),
            ("a,success\n1,true\n", "x.csv:2: success is 'true'"),
            (
                "a,b,success\n1,2,1\n1,0.",
                "x.csv:3: row is 2 values; accepted: 3",
            ),
            ("a,success\n1,1,1\n", "x.csv:2: row is 3 values"),
        ] {
            let found = refusal(text);
            assert!(found.contains(told), "{text:?}: {found}");
        }
        let many: Vec<String> = (0..65).map(|i| format!("f{i}")).collect();
        let found = refusal(&(many.join(",") + ",success\n"));
        assert!(
            found.contains("features is 65; accepted: 1 to 64"),
            "{found}"
        );
        assert!(Dataset::read(Path::new("/")).is_err());
    }

    #[test]
    fn unlearnable_sets_are_refused() {
        let told = |set: &Dataset| set.check("training set").unwrap_err().to_string();
        assert!(small().check("training set").is_ok());
        let mut set = small();
        set.success = vec![true, true, false, true];
        let found = told(&set);
        let counts = "training set: success is 3 times 1 and 1 times 0";
        assert!(found.contains(counts), "{found}");
        assert!(found.contains("a boundary needs both"), "{found}");
        let mut set = small();
        set.rows[1][1] = f64::NAN;
        let found = told(&set);
        assert!(
            found.contains("training set:3: angle.knee_r is NaN"),
            "{found}"
        );
        let folder = tempfile::tempdir().unwrap();
        assert!(set.write(&folder.path().join("x.csv")).is_err());
        let mut set = small();
        set.rows[2].pop();
        assert!(told(&set).contains("training set:4: row is 1 features"));
        let mut set = small();
        set.success.pop();
        assert!(told(&set).contains("4 rows, 3 labels"));
    }
}

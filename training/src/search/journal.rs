//! What a search has found out so far, on disk, so that it can go on after it was ended in any way.
//!
//! point → hash → score, from the journal or from rollouts → one line a generation.
//!
//! The candidates of a search follow from its seed and the scores of the former ones, so that scores
//! are all that has to be kept. The file is text: a line that says which search it is, the
//! controller that the search began with, then a line for each finished generation with
//! `HASH:COST:REACHED` of every candidate in the order of the hashes, the cost as the bits of the
//! number. A last line without an end is of a generation that was not finished.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use aplomb_framework::input::{Error, Result};
use xxhash_rust::xxh3::xxh3_64;

use crate::exercise::Score;
use crate::search::growing;

/// The largest journal that is read: 256 MiB, some millions of evaluations.
const LARGEST: u64 = 1 << 28;
/// How a journal begins.
const TITLE: &str = "aplomb-journal-1";

/// Which search it is: names and values without spaces.
pub type JournalHeader = Vec<(&'static str, String)>;

/// A journal that is being written.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    scores: Mutex<Scores>,
}

#[derive(Debug)]
struct Scores {
    file: File,
    known: BTreeMap<u64, Score>,
    /// Of the running generation, not yet in the file.
    fresh: BTreeMap<u64, Score>,
}

/// The journal beside an output: `rise.ron.journal` for `rise.ron`.
#[must_use]
pub fn beside(out: &Path) -> PathBuf {
    let mut name = out.as_os_str().to_owned();
    name.push(".journal");
    PathBuf::from(name)
}

impl Journal {
    /// Begins a journal in the place of any that is there. `base` is the controller in one line.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn begin(path: &Path, header: &JournalHeader, base: &str) -> Result<Self> {
        let text = format!("{}\n{base}\n", first_line(header));
        Ok(Self::new(
            path,
            growing::begin(path, &text)?,
            BTreeMap::new(),
        ))
    }

    /// Goes on with a journal. Also returns the controller that its search began with.
    ///
    /// # Errors
    /// [`Error::Read`] if there is none; [`Error::Invalid`] if it is of another search, or is none.
    pub fn resume(path: &Path, header: &JournalHeader) -> Result<(Self, String)> {
        let (text, end) = growing::whole_lines(path, LARGEST)?;
        let mut lines = text.lines();
        check(path, lines.next().unwrap_or_default(), header)?;
        let base = lines.next().unwrap_or_default().to_owned();
        let mut known = BTreeMap::new();
        for (i, line) in lines.enumerate() {
            for entry in line.split_whitespace() {
                let (hash, score) = parsed(entry).ok_or_else(|| {
                    let place = format!("{}:{}", path.display(), i + 3);
                    Error::invalid(place, "entry", entry, "HASH:COST:REACHED")
                })?;
                known.insert(hash, score);
            }
        }
        Ok((Self::new(path, growing::go_on(path, end)?, known), base))
    }

    fn new(path: &Path, file: File, known: BTreeMap<u64, Score>) -> Self {
        Self {
            path: path.to_owned(),
            scores: Mutex::new(Scores {
                file,
                known,
                fresh: BTreeMap::new(),
            }),
        }
    }

    /// The score of a point of the unit cube: the journal's, or else what `measure` finds.
    pub fn score(&self, point: &[f64], measure: impl FnOnce() -> Score) -> Score {
        let hash = hash(point);
        let found = {
            let scores = self.scores();
            scores.known.get(&hash).or(scores.fresh.get(&hash)).copied()
        };
        found.unwrap_or_else(|| {
            let score = measure();
            self.scores().fresh.insert(hash, score);
            score
        })
    }

    /// The score of a point, if a finished generation has it.
    #[must_use]
    pub fn known(&self, point: &[f64]) -> Option<Score> {
        self.scores().known.get(&hash(point)).copied()
    }

    /// A generation is finished: writes down what is new.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn finish_generation(&self) -> Result<()> {
        let mut guard = self.scores();
        let scores = &mut *guard;
        let fresh = std::mem::take(&mut scores.fresh);
        if fresh.is_empty() {
            return Ok(());
        }
        let entry = |(hash, s): (&u64, &Score)| {
            format!("{hash:016x}:{:016x}:{}", s.cost.to_bits(), s.reached)
        };
        let line: Vec<String> = fresh.iter().map(entry).collect();
        // In one call: a line is there whole, or without its end.
        let written = scores.file.write_all((line.join(" ") + "\n").as_bytes());
        written.map_err(|e| growing::failed(&self.path, &e))?;
        scores.known.extend(fresh);
        Ok(())
    }

    fn scores(&self) -> MutexGuard<'_, Scores> {
        self.scores.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn first_line(header: &JournalHeader) -> String {
    let pairs = header
        .iter()
        .map(|(name, value)| format!(" {name}={value}"));
    TITLE.to_owned() + &pairs.collect::<String>()
}

/// Refuses a first line that is not this header's.
fn check(path: &Path, line: &str, header: &JournalHeader) -> Result<()> {
    let place = path.display().to_string();
    let mut words = line.split(' ');
    if words.next() != Some(TITLE) {
        let accepted = format!("the journal of a search, beginning with {TITLE}");
        return Err(Error::invalid(place, "first line", "another", accepted));
    }
    for (name, value) in header {
        let found = words.next().and_then(|w| w.strip_prefix(name));
        let found = found.and_then(|w| w.strip_prefix('='));
        let found = found.unwrap_or("missing");
        if found != value {
            let accepted = format!("{value}, which this search has");
            return Err(Error::invalid(place, *name, found, accepted));
        }
    }
    Ok(())
}

fn parsed(entry: &str) -> Option<(u64, Score)> {
    let mut parts = entry.split(':');
    let mut hex = || u64::from_str_radix(parts.next()?, 16).ok();
    let (hash, bits) = (hex()?, hex()?);
    let cost = Some(f64::from_bits(bits)).filter(|c| !c.is_nan())?;
    let reached = parts.next()?.parse().ok()?;
    Some((hash, Score { cost, reached }))
}

fn hash(point: &[f64]) -> u64 {
    let bytes: Vec<u8> = point
        .iter()
        .flat_map(|x| x.to_bits().to_le_bytes())
        .collect();
    xxh3_64(&bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(seed: u64) -> JournalHeader {
        vec![
            ("controller", "rise".to_owned()),
            ("seed", seed.to_string()),
        ]
    }

    fn score(cost: f64) -> Score {
        Score { cost, reached: 3 }
    }

    fn never() -> Score {
        unreachable!("the journal has it")
    }

    #[test]
    fn finished_generations_come_back_bit_for_bit_and_an_unfinished_one_is_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.journal");
        let journal = Journal::begin(&path, &header(1), "(base)").unwrap();
        let costs = [0.1 + 0.2, f64::INFINITY, 1e-300];
        for (i, cost) in costs.iter().enumerate() {
            journal.score(&[i as f64], || score(*cost));
            assert_eq!(journal.known(&[i as f64]), None);
            journal.finish_generation().unwrap();
            assert_eq!(journal.known(&[i as f64]), Some(score(*cost)));
        }
        let whole = std::fs::read(&path).unwrap();
        for lost in [1, 5, 30] {
            std::fs::write(&path, &whole[..whole.len() - lost]).unwrap();
            let (journal, base) = Journal::resume(&path, &header(1)).unwrap();
            assert_eq!(base, "(base)");
            assert_eq!(journal.score(&[0.0], never), score(costs[0]));
            assert_eq!(journal.score(&[1.0], never), score(costs[1]));
            assert_eq!(journal.known(&[2.0]), None);
            journal.score(&[2.0], || score(costs[2]));
            journal.finish_generation().unwrap();
            assert_eq!(std::fs::read(&path).unwrap(), whole);
        }
    }

    #[test]
    fn what_is_no_journal_of_this_search_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.journal");
        let refusal = || Journal::resume(&path, &header(1)).unwrap_err().to_string();
        assert!(refusal().contains("cannot read"), "{}", refusal());
        Journal::begin(&path, &header(2), "").unwrap();
        let told = "seed is 2; accepted: 1, which this";
        assert!(refusal().contains(told), "{}", refusal());
        for text in ["", "x\n", "aplomb-journal-1 seed=1\n", "no end"] {
            std::fs::write(&path, text).unwrap();
            assert!(refusal().contains("; accepted: "), "{}", refusal());
        }
        let bad = format!("{}\n(base)\n1:zz:3\n", first_line(&header(1)));
        std::fs::write(&path, bad).unwrap();
        assert!(
            refusal().contains("x.journal:3: entry is 1:zz:3"),
            "{}",
            refusal()
        );
    }
}

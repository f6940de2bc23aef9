//! Many rollouts: a dataset with its provenance, gathered in parallel and resumable.
//!
//! trial, seed → samples by index → partial file, a line a sample → CSV and header.
//!
//! Sample *i* of the training set has the random stream 2 *i*, that of the test set 2 *i* + 1: the
//! number of threads changes nothing, and no sample can be in both. The partial file begins with a
//! line that says which set it is; a last line without an end is of a sample that was not finished.

use std::fs::File;
use std::io::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use aplomb_framework::input::{Error, Result, Source, read_bounded, write_atomically};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use crate::exercise::skill::Skill;
use crate::preconditions::learning::dataset::Dataset;
use crate::preconditions::rollout::{Sample, Trial};
use crate::search::growing;

/// Rollouts between two writes to the partial file.
const BATCH: usize = 64;
/// The largest partial file that is read: 2 GiB.
const LARGEST: u64 = 1 << 31;
/// How a partial file begins.
const TITLE: &str = "aplomb-rollouts-1";

/// Which of the two sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SetPart {
    /// What is learned from.
    Train,
    /// What is judged by.
    Test,
}

impl SetPart {
    /// As in file names.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Train => "train",
            Self::Test => "test",
        }
    }

    fn stream(self, index: usize) -> u64 {
        2 * index as u64 + u64::from(self == Self::Test)
    }
}

/// Where a dataset comes from. Written beside it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetHeader {
    /// The controller.
    pub controller: String,
    /// Its character.
    pub character: String,
    /// Digest of the character's numbers.
    pub character_digest: String,
    /// Hash of the controller's file and of the rest of its repertoire.
    pub controller_digest: String,
    /// Hash of the disturbance's text.
    pub disturbance_digest: String,
    /// Which set.
    pub part: SetPart,
    /// Seed of all streams.
    pub seed: u64,
    /// Samples.
    pub count: usize,
    /// Version of the program.
    pub version: String,
    /// Hash of the CSV file; empty as long as it is not finished.
    pub csv_digest: String,
    /// For each sample, whether the hand-made pre-condition held: 0 or 1.
    pub manual: String,
}

/// Files of a set in a folder.
#[derive(Debug, Clone)]
pub struct Files {
    /// The samples.
    pub csv: PathBuf,
    /// Where they come from.
    pub header: PathBuf,
    /// What there is of them so far.
    pub partial: PathBuf,
}

impl Files {
    /// By their names.
    #[must_use]
    pub fn of(folder: &Path, controller: &str, part: SetPart) -> Self {
        let name = |rest: &str| folder.join(format!("{controller}.{}.{rest}", part.name()));
        Self {
            csv: name("csv"),
            header: name("ron"),
            partial: name("partial"),
        }
    }
}

/// A set that is to be gathered.
#[derive(Debug)]
pub struct SetPlan<'a> {
    /// What is rolled out.
    pub trial: &'a Trial,
    /// What is known of the set beforehand.
    pub header: SetHeader,
    /// Where it is written.
    pub files: Files,
    /// Whether to go on with what is there.
    pub resume: bool,
}

/// A finished set: the samples, and for each whether the hand-made pre-condition held.
#[derive(Debug, Clone, PartialEq)]
pub struct Gathered {
    /// The samples.
    pub data: Dataset,
    /// One a sample.
    pub manual: Vec<bool>,
    /// How many of the rollouts were run now; the others were found.
    pub fresh: usize,
}

/// The header of a set that is not finished.
#[must_use]
pub fn header(
    skill: &Skill,
    disturbance: &Source,
    part: SetPart,
    seed: u64,
    count: usize,
) -> SetHeader {
    let own = xxh3_64(skill.file.whole_text().as_bytes()) ^ skill.surroundings.rotate_left(1);
    SetHeader {
        controller: skill.name().to_owned(),
        character: skill.model.name.clone(),
        character_digest: skill.model.digest(),
        controller_digest: format!("{own:016x}"),
        disturbance_digest: format!("{:016x}", xxh3_64(disturbance.text.as_bytes())),
        part,
        seed,
        count,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        csv_digest: String::new(),
        manual: String::new(),
    }
}

/// Gathers a set. `watch` sees how many samples there are and may end the work: then there is no
/// set yet, but what there is is kept and can be resumed.
///
/// # Errors
/// A partial file of another set; files that cannot be read or written; a feature that is not a
/// number where the controller took over.
pub fn gather(
    plan: &SetPlan<'_>,
    mut watch: impl FnMut(usize) -> ControlFlow<()>,
) -> Result<Option<Gathered>> {
    let first = first_line(&plan.header);
    if plan.resume
        && let Some(done) = finished(plan)?
    {
        let _ = watch(plan.header.count);
        return Ok(Some(done));
    }
    let partial = &plan.files.partial;
    let (mut file, mut samples) = if plan.resume && partial.exists() {
        resumed(plan, &first)?
    } else {
        (growing::begin(partial, &format!("{first}\n"))?, Vec::new())
    };
    let found = samples.len();
    while samples.len() < plan.header.count {
        if watch(samples.len()).is_break() {
            return Ok(None);
        }
        let next = samples.len()..(samples.len() + BATCH).min(plan.header.count);
        let batch: Vec<Sample> = next
            .into_par_iter()
            .map(|i| sample(plan, i))
            .collect::<Result<_>>()?;
        let lines: String = batch.iter().map(line).collect();
        let written = file.write_all(lines.as_bytes());
        written.map_err(|e| growing::failed(partial, &e))?;
        samples.extend(batch);
    }
    let _ = watch(samples.len());
    finish(plan, samples, found).map(Some)
}

/// The line that tells a partial file's set.
fn first_line(h: &SetHeader) -> String {
    format!(
        "{TITLE} controller={} character={} character_digest={} controller_digest={} \
         disturbance_digest={} part={} seed={} count={} version={}",
        h.controller,
        h.character,
        h.character_digest,
        h.controller_digest,
        h.disturbance_digest,
        h.part.name(),
        h.seed,
        h.count,
        h.version
    )
}

/// One rollout, whose features all have a value.
fn sample(plan: &SetPlan<'_>, index: usize) -> Result<Sample> {
    let SetHeader {
        controller,
        part,
        seed,
        ..
    } = &plan.header;
    let mut rng = ChaCha8Rng::seed_from_u64(*seed);
    rng.set_stream(part.stream(index));
    let sample = plan.trial.sample(&mut rng)?;
    let names = plan.trial.features();
    let mut values = names.iter().zip(&sample.features);
    if let Some((name, value)) = values.find(|(_, value)| !value.is_finite()) {
        let place = format!("{controller}: {} sample {index}", part.name());
        let accepted = "features that have a value wherever the disturbance leads";
        return Err(Error::invalid(place, name.to_string(), value, accepted));
    }
    Ok(sample)
}

/// Features, success, whether the hand-made pre-condition held.
fn line(sample: &Sample) -> String {
    let features: String = sample.features.iter().map(|x| format!("{x},")).collect();
    let [success, manual] = [sample.success, sample.manual].map(u8::from);
    format!("{features}{success},{manual}\n")
}

/// What a line tells.
fn parsed(line: &str, columns: usize) -> Option<Sample> {
    let numbers: Option<Vec<f64>> = line.split(',').map(|n| n.parse().ok()).collect();
    let mut features = numbers.filter(|n| n.len() == columns && n.iter().all(|x| x.is_finite()))?;
    let mut flag = || match features.pop() {
        Some(0.0) => Some(false),
        Some(1.0) => Some(true),
        _ => None,
    };
    let (manual, success) = (flag()?, flag()?);
    Some(Sample {
        features,
        success,
        manual,
    })
}

/// The partial file without its unfinished end, and its samples.
fn resumed(plan: &SetPlan<'_>, first: &str) -> Result<(File, Vec<Sample>)> {
    let path = &plan.files.partial;
    let (text, end) = growing::whole_lines(path, LARGEST)?;
    let mut lines = text.lines();
    let title = lines.next().unwrap_or_default();
    if title != first {
        let mut words = first.split(' ').zip(title.split(' '));
        let differs = words.find(|(a, b)| a != b).map_or("its length", |(_, b)| b);
        let place = format!("{}:1", path.display());
        let accepted = format!("the set that is asked for: {first}");
        return Err(Error::invalid(place, "set", differs, accepted));
    }
    let columns = plan.trial.features().len() + 2;
    let read = |(i, line): (usize, &str)| {
        parsed(line, columns).ok_or_else(|| {
            let place = format!("{}:{}", path.display(), i + 2);
            let accepted = format!("{columns} numbers, the last two 0 or 1");
            Error::invalid(place, "sample", line, accepted)
        })
    };
    let samples: Vec<Sample> = lines.enumerate().map(read).collect::<Result<_>>()?;
    if samples.len() > plan.header.count {
        let place = path.display().to_string();
        let accepted = format!("at most {}", plan.header.count);
        return Err(Error::invalid(place, "samples", samples.len(), accepted));
    }
    Ok((growing::go_on(path, end)?, samples))
}

/// Writes the dataset and its header, and removes the partial file.
fn finish(plan: &SetPlan<'_>, samples: Vec<Sample>, found: usize) -> Result<Gathered> {
    let features = plan.trial.features();
    let fresh = samples.len() - found;
    let manual: Vec<bool> = samples.iter().map(|s| s.manual).collect();
    let data = Dataset {
        features: features.iter().map(ToString::to_string).collect(),
        success: samples.iter().map(|s| s.success).collect(),
        rows: samples.into_iter().map(|s| s.features).collect(),
    };
    data.write(&plan.files.csv)?;
    let header = SetHeader {
        csv_digest: csv_digest(&plan.files.csv)?,
        manual: manual.iter().map(|m| if *m { '1' } else { '0' }).collect(),
        ..plan.header.clone()
    };
    let text = ron::ser::to_string_pretty(&header, ron::ser::PrettyConfig::default());
    let text = text.map_err(|e| Error::Write {
        path: plan.files.header.clone(),
        reason: e.to_string(),
    })?;
    write_atomically(&plan.files.header, text.as_bytes())?;
    // The set is whole without it.
    drop(std::fs::remove_file(&plan.files.partial));
    Ok(Gathered {
        data,
        manual,
        fresh,
    })
}

fn csv_digest(path: &Path) -> Result<String> {
    Ok(format!("{:016x}", xxh3_64(&read_bounded(path, LARGEST)?)))
}

/// The set that is asked for, if it is there and whole.
fn finished(plan: &SetPlan<'_>) -> Result<Option<Gathered>> {
    let Files { csv, header, .. } = &plan.files;
    if !header.exists() || !csv.exists() {
        return Ok(None);
    }
    let source = Source::read(header)?;
    let known: SetHeader = source.parse()?;
    let asked = SetHeader {
        csv_digest: known.csv_digest.clone(),
        manual: known.manual.clone(),
        ..plan.header.clone()
    };
    if known != asked || csv_digest(csv)? != known.csv_digest {
        return Ok(None);
    }
    let data = Dataset::read(csv)?;
    let manual: Vec<bool> = known.manual.chars().map(|c| c == '1').collect();
    let whole = manual.len() == data.rows.len() && data.rows.len() == known.count;
    Ok(whole.then_some(Gathered {
        data,
        manual,
        fresh: 0,
    }))
}

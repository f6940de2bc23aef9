//! A repertoire file: the pool, its order, and the fallback of a character's supervisor.
//!
//! RON → registry → [`Supervisor`]. Entries are controllers written in place, or files beside the
//! repertoire or shipped with the program; a file's pre-condition may be refined by a learned
//! boundary in a file of its own.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Deserialize;

use crate::character::Model;
use crate::control::Boundary;
use crate::control::boundary::LARGEST_BOUNDARY;
use crate::control::condition::Condition;
use crate::control::registry::{ControllerFile, Registry};
use crate::control::supervisor::Supervisor;
use crate::input::{Error, LARGEST_TEXT, Result, Source, shortened};

/// At most this many controllers a repertoire.
pub const MOST_CONTROLLERS: usize = 256;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RepertoireFile {
    name: String,
    fallback: String,
    controllers: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
enum Entry {
    /// A controller file, beside the repertoire or shipped.
    File(String),
    /// A controller written in place.
    Here(Box<ControllerFile>),
    /// A controller file and a boundary file: it takes over where its own pre-condition holds and
    /// the boundary expects success.
    Learned {
        controller: String,
        boundary: String,
        /// Whether it bids by the probability of success, as [`crate::control::contract::Contract`] says.
        #[serde(default)]
        confident: bool,
    },
}

/// A controller of a repertoire with the text that it stands in, and what was learned about it.
struct Part {
    source: Source,
    controller: ControllerFile,
    learned: Option<(Source, Boundary)>,
}

impl Part {
    fn of(source: Source) -> Result<Self> {
        Ok(Self {
            controller: source.parse()?,
            source,
            learned: None,
        })
    }

    /// Adds what is in a boundary file.
    fn with_boundary(mut self, source: Source, confident: bool) -> Result<Self> {
        let boundary = Boundary::parse(&source)?;
        let contract = &mut self.controller.contract;
        if boundary.controller != contract.name {
            let problem = format!("'{}'", shortened(&boundary.controller));
            let accepted = format!("'{}', whose pre-condition it refines", contract.name);
            return Err(source.invalid("controller", "controller", problem, accepted));
        }
        contract.confident |= confident;
        self.learned = Some((source, boundary));
        Ok(self)
    }

    /// Makes sure that what was learned was learned with this character.
    fn resolve(&mut self, model: &Model) -> Result<()> {
        match &mut self.learned {
            Some((source, boundary)) => boundary.resolve_at(model, &|field| source.place(field)),
            None => Ok(()),
        }
    }

    /// The controller with its whole pre-condition: what was written by hand prunes, what was
    /// learned refines.
    fn controller(self) -> ControllerFile {
        let mut controller = self.controller;
        if let Some((_, boundary)) = self.learned {
            let precondition = &mut controller.contract.precondition;
            let by_hand = std::mem::replace(precondition, Condition::Always);
            *precondition = Condition::All(vec![by_hand, Condition::Svm(Arc::new(boundary))]);
        }
        controller
    }
}

/// Reads a repertoire by path, or a shipped one by its name (`humanoid` is
/// `repertoires/humanoid.ron`), and builds its supervisor for a character.
///
/// # Errors
/// Unreadable or invalid files, named with line and field; a pool without a valid fallback.
pub fn load(name_or_path: &str, registry: &Registry, model: &Arc<Model>) -> Result<Supervisor> {
    let (source, folder) = open(name_or_path, registry)?;
    build(&source, folder, registry, model)
}

/// Builds the supervisor of a repertoire in text. Its files are looked for in `folder`, then among
/// the registry's.
///
/// # Errors
/// As [`load`].
pub fn build(
    source: &Source,
    folder: Option<&Path>,
    registry: &Registry,
    model: &Arc<Model>,
) -> Result<Supervisor> {
    let file: RepertoireFile = source.parse()?;
    let mut pool = Vec::with_capacity(file.controllers.len());
    for mut part in parts(source, &file, folder, registry)? {
        part.resolve(model)?;
        let source = part.source.clone();
        pool.push(registry.build(&source, &part.controller(), model)?);
    }
    let mut supervisor = Supervisor::new(&file.name, pool, &file.fallback);
    if let Err(Error::Invalid { place, field, .. }) = &mut supervisor {
        *place = source.place(field);
    }
    supervisor
}

/// The controller files of a repertoire, in its order, as they stand: not built for any character.
///
/// # Errors
/// As [`load`], apart from what only building shows.
pub fn read(name_or_path: &str, registry: &Registry) -> Result<Vec<ControllerFile>> {
    let (source, folder) = open(name_or_path, registry)?;
    let file: RepertoireFile = source.parse()?;
    let parts = parts(&source, &file, folder, registry)?;
    Ok(parts.into_iter().map(Part::controller).collect())
}

/// The repertoire's text, and the folder beside it if it is a file.
fn open<'a>(name_or_path: &'a str, registry: &Registry) -> Result<(Source, Option<&'a Path>)> {
    if let Some(source) = registry.file(&format!("repertoires/{name_or_path}.ron")) {
        return Ok((source, None));
    }
    let path = Path::new(name_or_path);
    Ok((Source::read(path)?, path.parent()))
}

/// Every controller with the texts that it stands in.
fn parts(
    source: &Source,
    file: &RepertoireFile,
    folder: Option<&Path>,
    registry: &Registry,
) -> Result<Vec<Part>> {
    if file.controllers.len() > MOST_CONTROLLERS {
        let problem = format!("a list of {}", file.controllers.len());
        let accepted = format!("at most {MOST_CONTROLLERS} controllers");
        return Err(source.invalid("controllers", "controllers", problem, accepted));
    }
    let shelf = Shelf {
        source,
        folder,
        registry,
    };
    let part = |entry: &Entry| match entry {
        Entry::Here(controller) => Ok(Part {
            source: source.clone(),
            controller: ControllerFile::clone(controller),
            learned: None,
        }),
        Entry::File(name) => Part::of(shelf.find(name, "controller file", LARGEST_TEXT)?),
        Entry::Learned {
            controller,
            boundary,
            confident,
        } => {
            let part = Part::of(shelf.find(controller, "controller file", LARGEST_TEXT)?)?;
            let boundary = shelf.find(boundary, "boundary file", LARGEST_BOUNDARY)?;
            part.with_boundary(boundary, *confident)
        }
    };
    file.controllers.iter().map(part).collect()
}

/// Where the files of a repertoire are looked for: beside it, then among the shipped ones.
struct Shelf<'a> {
    source: &'a Source,
    folder: Option<&'a Path>,
    registry: &'a Registry,
}

impl Shelf<'_> {
    /// A file of at most `limit` bytes.
    fn find(&self, name: &str, kind: &'static str, limit: u64) -> Result<Source> {
        let beside: Option<PathBuf> = self.folder.map(|f| f.join(name));
        match (beside, self.registry.file(name)) {
            (Some(path), _) if path.exists() => Source::read_up_to(&path, limit),
            (_, Some(shipped)) => Ok(shipped),
            (Some(path), None) => Source::read_up_to(&path, limit),
            (None, None) => {
                let place = self.source.place(name);
                Err(Error::unknown(kind, name, self.registry.files()).at(&place))
            }
        }
    }
}

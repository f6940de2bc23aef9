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
use crate::control::pool;
use crate::control::registry::{ControllerFile, REPERTOIRES, Registry};
use crate::control::supervisor::Supervisor;
use crate::input::{Error, FieldPath, LARGEST_TEXT, Result, Source, check, shortened};

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

/// A controller of a repertoire, and what was learned about it.
struct RepertoirePart {
    controller: ControllerFile,
    learned: Option<(Source, Boundary)>,
}

impl RepertoirePart {
    fn of(source: Source) -> Result<Self> {
        Ok(Self {
            controller: ControllerFile::parse(source)?,
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
            return Err(source.locate(Error::refused("controller", problem, accepted)));
        }
        contract.confident |= confident;
        self.learned = Some((source, boundary));
        Ok(self)
    }

    /// Makes sure that what was learned was learned with this character, and looks up the joints of
    /// what it refines, as long as that stands in the contract as in its file.
    fn resolve(&mut self, model: &Model) -> Result<()> {
        let Some((source, boundary)) = &mut self.learned else {
            return Ok(());
        };
        boundary.resolve(model).map_err(|e| source.locate(e))?;
        let resolved = self.controller.contract.resolve(model);
        let source = &self.controller.source;
        resolved.map_err(|e| source.locate(e.inside("contract")))
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
/// Unreadable or invalid files, with the place of what is refused; a pool without a valid fallback.
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
        pool.push(registry.build(&part.controller(), model)?);
    }
    pool::fallback(&pool, &file.fallback).map_err(|e| source.locate(e))?;
    Supervisor::new(&file.name, pool, &file.fallback)
}

/// The controller files of a repertoire, in its order, as they stand: not built for any character.
///
/// # Errors
/// As [`load`], apart from what only building shows.
pub fn read(name_or_path: &str, registry: &Registry) -> Result<Vec<ControllerFile>> {
    let (source, folder) = open(name_or_path, registry)?;
    let file: RepertoireFile = source.parse()?;
    let parts = parts(&source, &file, folder, registry)?;
    Ok(parts.into_iter().map(RepertoirePart::controller).collect())
}

/// The repertoire's text, and the folder beside it if it is a file.
fn open<'a>(name_or_path: &'a str, registry: &Registry) -> Result<(Source, Option<&'a Path>)> {
    if let Some(source) = registry.repertoire(name_or_path) {
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
) -> Result<Vec<RepertoirePart>> {
    let count = file.controllers.len();
    let few = check::count("controllers", count, 0..=MOST_CONTROLLERS, "controllers");
    few.map_err(|e| source.locate(e))?;
    let shelf = Shelf { folder, registry };
    let find = |path: FieldPath, name: &str, kind| {
        let found = shelf.find(name, kind);
        found.map_err(|e| source.locate(e.inside(path)))
    };
    let part = |(i, entry): (usize, &Entry)| {
        let here = FieldPath::from(("controllers", i));
        match entry {
            Entry::Here(controller) => Ok(RepertoirePart {
                controller: ControllerFile {
                    source: source.part(here.then(FieldPath::inner())),
                    ..ControllerFile::clone(controller)
                },
                learned: None,
            }),
            Entry::File(name) => {
                let path = here.then(FieldPath::inner());
                RepertoirePart::of(find(path, name, EntryKind::Controller)?)
            }
            Entry::Learned {
                controller,
                boundary,
                confident,
            } => {
                let path = here.clone().then("controller");
                let part = RepertoirePart::of(find(path, controller, EntryKind::Controller)?)?;
                let path = here.then("boundary");
                let boundary = find(path, boundary, EntryKind::Boundary)?;
                part.with_boundary(boundary, *confident)
            }
        }
    };
    file.controllers.iter().enumerate().map(part).collect()
}

/// A kind of file that a repertoire names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum EntryKind {
    Controller,
    Boundary,
}

impl EntryKind {
    /// In messages.
    fn name(self) -> &'static str {
        match self {
            Self::Controller => "controller file, beside this one or shipped",
            Self::Boundary => "boundary file, beside this one or shipped",
        }
    }

    /// The largest that is read, bytes.
    fn limit(self) -> u64 {
        match self {
            Self::Controller => LARGEST_TEXT,
            Self::Boundary => LARGEST_BOUNDARY,
        }
    }

    /// Whether a shipped file may be of this kind, by its name.
    fn is(self, shipped: &str) -> bool {
        match self {
            Self::Boundary => shipped.ends_with(".boundary.ron"),
            Self::Controller => {
                !shipped.ends_with(".boundary.ron") && !shipped.starts_with(REPERTOIRES)
            }
        }
    }
}

/// Where the files of a repertoire are looked for: beside it, then among the shipped ones.
struct Shelf<'a> {
    folder: Option<&'a Path>,
    registry: &'a Registry,
}

impl Shelf<'_> {
    /// The file of this name.
    fn find(&self, name: &str, kind: EntryKind) -> Result<Source> {
        let limit = kind.limit();
        let beside: Option<PathBuf> = self.folder.map(|f| f.join(name));
        match (beside, self.registry.file(name)) {
            (Some(path), _) if path.exists() => Source::read_up_to(&path, limit),
            (_, Some(shipped)) => Ok(shipped),
            (Some(_), None) | (None, None) => {
                let known = self.registry.files();
                Err(Error::unknown(
                    kind.name(),
                    name,
                    known.filter(|f| kind.is(f)),
                ))
            }
        }
    }
}

//! A repertoire file: the pool, its order, and the fallback of a character's supervisor.
//!
//! RON → registry → [`Supervisor`]. Entries are controllers written in place, or files beside the
//! repertoire or shipped with the program.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Deserialize;

use crate::error::{Error, Result};
use crate::file::Source;
use crate::model::Model;
use crate::registry::{ControllerFile, Registry};
use crate::supervisor::Supervisor;

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
enum Entry {
    /// A controller file, beside the repertoire or shipped.
    File(String),
    /// A controller written in place.
    Here(Box<ControllerFile>),
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
    for (place, controller) in parts(source, &file, folder, registry)? {
        pool.push(registry.build(&place, &controller, model)?);
    }
    let mut mind = Supervisor::new(&file.name, pool, &file.fallback);
    if let Err(Error::Invalid { place, field, .. }) = &mut mind {
        *place = source.place(field);
    }
    mind
}

/// The controller files of a repertoire, in its order, as they stand: not built for any character.
///
/// # Errors
/// As [`load`], apart from what only building shows.
pub fn read(name_or_path: &str, registry: &Registry) -> Result<Vec<ControllerFile>> {
    let (source, folder) = open(name_or_path, registry)?;
    let file: RepertoireFile = source.parse()?;
    let parts = parts(&source, &file, folder, registry)?;
    Ok(parts
        .into_iter()
        .map(|(_, controller)| controller)
        .collect())
}

/// The repertoire's text, and the folder beside it if it is a file.
fn open<'a>(name_or_path: &'a str, registry: &Registry) -> Result<(Source, Option<&'a Path>)> {
    if let Some(source) = registry.file(&format!("repertoires/{name_or_path}.ron")) {
        return Ok((source, None));
    }
    let path = Path::new(name_or_path);
    Ok((Source::read(path)?, path.parent()))
}

/// Every controller file with the text that it stands in.
fn parts(
    source: &Source,
    file: &RepertoireFile,
    folder: Option<&Path>,
    registry: &Registry,
) -> Result<Vec<(Source, ControllerFile)>> {
    if file.controllers.len() > MOST_CONTROLLERS {
        let problem = format!("a list of {}", file.controllers.len());
        let accepted = format!("at most {MOST_CONTROLLERS} controllers");
        return Err(source.invalid("controllers", "controllers", problem, accepted));
    }
    let part = |entry: &Entry| match entry {
        Entry::Here(controller) => Ok((source.clone(), ControllerFile::clone(controller))),
        Entry::File(name) => {
            let inner = find(source, name, folder, registry)?;
            let controller = inner.parse()?;
            Ok((inner, controller))
        }
    };
    file.controllers.iter().map(part).collect()
}

fn find(source: &Source, name: &str, folder: Option<&Path>, registry: &Registry) -> Result<Source> {
    let beside: Option<PathBuf> = folder.map(|f| f.join(name));
    match (beside, registry.file(name)) {
        (Some(path), _) if path.exists() => Source::read(&path),
        (_, Some(shipped)) => Ok(shipped),
        (Some(path), None) => Source::read(&path),
        (None, None) => {
            let place = source.place(name);
            Err(Error::unknown("controller file", name, registry.files()).at(&place))
        }
    }
}

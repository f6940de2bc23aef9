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
    if let Some(source) = registry.file(&format!("repertoires/{name_or_path}.ron")) {
        return build(&source, None, registry, model);
    }
    let path = Path::new(name_or_path);
    build(&Source::read(path)?, path.parent(), registry, model)
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
    if file.controllers.len() > MOST_CONTROLLERS {
        let problem = format!("a list of {}", file.controllers.len());
        let accepted = format!("at most {MOST_CONTROLLERS} controllers");
        return Err(source.invalid("controllers", "controllers", problem, accepted));
    }
    let mut pool = Vec::with_capacity(file.controllers.len());
    for entry in &file.controllers {
        pool.push(match entry {
            Entry::Here(c) => registry.build(source, c, model)?,
            Entry::File(name) => {
                let inner = find(source, name, folder, registry)?;
                let c: ControllerFile = inner.parse()?;
                registry.build(&inner, &c, model)?
            }
        });
    }
    Supervisor::new(&file.name, pool, &file.fallback).map_err(|e| match e {
        Error::Invalid {
            field,
            problem,
            accepted,
            ..
        } => {
            let place = source.place(&field);
            Error::Invalid {
                place,
                field,
                problem,
                accepted,
            }
        }
        other => other,
    })
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

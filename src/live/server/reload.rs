//! Files that are in use: changed on disk, they take effect in the running session.
//!
//! folders of the files → what changed → scene read anew → [`Session`]; a mistake leaves the old one
//! in use and is told to the watchers.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use aplomb_framework::control::{ControllerFile, Registry, repertoire};
use aplomb_framework::input::Error;

use crate::live::answer::files;
use crate::live::scene::LiveScene;
use crate::live::session::Session;

/// How often the files are looked at.
const OFTEN: Duration = Duration::from_millis(200);
/// At most so many files of a folder are looked at.
const MOST_FILES: usize = 500;

/// Reads the scene again, or says what is wrong with its files.
type Rebuild = Box<dyn Fn() -> Result<LiveScene, String> + Send>;

/// Looks after the files that a scene was read from.
pub struct Reload {
    build: Rebuild,
    registry: Registry,
    folders: Vec<PathBuf>,
    /// Every file with its time and length when it was last looked at.
    seen: BTreeMap<PathBuf, (Option<SystemTime>, u64)>,
    /// What each controller said when it was last read.
    said: BTreeMap<String, String>,
    looked: Instant,
}

impl std::fmt::Debug for Reload {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Reload")
            .field("folders", &self.folders)
            .finish_non_exhaustive()
    }
}

impl Reload {
    /// Looks after the files of a scene that `build` reads again. `used` are the files that were
    /// named; names of shipped ones are left out. None if nothing is on disk.
    #[must_use]
    pub fn new(
        build: Rebuild,
        used: &[String],
        scene: &LiveScene,
        registry: &Registry,
    ) -> Option<Self> {
        let on_disk = used.iter().map(Path::new).filter(|p| p.is_file());
        let folder = |p: &Path| match p.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
            _ => PathBuf::from("."),
        };
        let mut folders: Vec<PathBuf> = on_disk.map(folder).collect();
        folders.sort();
        folders.dedup();
        if folders.is_empty() {
            return None;
        }
        let mut reload = Self {
            build,
            registry: registry.clone(),
            folders,
            seen: BTreeMap::new(),
            said: said(scene, registry),
            looked: Instant::now(),
        };
        reload.seen = reload.times();
        Some(reload)
    }

    fn times(&self) -> BTreeMap<PathBuf, (Option<SystemTime>, u64)> {
        let mut times = BTreeMap::new();
        for folder in &self.folders {
            let Ok(entries) = std::fs::read_dir(folder) else {
                continue;
            };
            let paths = entries.flatten().map(|e| e.path());
            let ron = paths.filter(|p| p.extension().is_some_and(|e| e == "ron"));
            for path in ron.take(MOST_FILES) {
                if let Ok(meta) = std::fs::metadata(&path) {
                    times.insert(path, (meta.modified().ok(), meta.len()));
                }
            }
        }
        times
    }

    /// Looks whether a file has changed; what the watchers are told of it.
    pub(super) fn look(&mut self, session: &mut Session) -> Option<String> {
        if self.looked.elapsed() < OFTEN {
            return None;
        }
        self.looked = Instant::now();
        let times = self.times();
        if times == self.seen {
            return None;
        }
        let changed = times
            .iter()
            .filter(|(path, time)| self.seen.get(*path) != Some(time));
        let mut names: Vec<String> = changed
            .map(|(path, _)| path.display().to_string())
            .collect();
        if names.is_empty() {
            names.push("a file that is gone".to_owned());
        }
        self.seen = times;
        Some(match self.take(session) {
            Ok(effect) => files(true, &format!("{}: {effect}", names.join(", "))),
            Err(why) => files(false, &why),
        })
    }

    /// Reads the scene anew and puts it in the place of the old one.
    fn take(&mut self, session: &mut Session) -> Result<&'static str, String> {
        let told = |e: Error| e.to_string();
        let new = (self.build)()?;
        let now = said(&new, &self.registry);
        let old = &session.scene;
        let models = |scene: &LiveScene| -> Vec<String> {
            scene
                .cast
                .iter()
                .map(|(model, _)| model.source.clone())
                .collect()
        };
        let effect = if old.scenario != new.scenario || models(old) != models(&new) {
            session.begin(new).map_err(told)?;
            "in use; the run begins anew"
        } else if self.said == now {
            "nothing that is in use has changed"
        } else {
            // Whether the new pools answer to what the scenario commands.
            new.begin().map_err(told)?;
            for (character, (_, supervisor)) in new.cast.iter().enumerate() {
                let same = |name: &str| {
                    let [before, after] = [&self.said, &now].map(|said| said.get(name));
                    before.is_some() && before == after
                };
                session.renew(character, supervisor, &same);
            }
            "in use"
        };
        self.said = now;
        Ok(effect)
    }
}

/// What each controller says, by name. Characters of one scene share their skills.
fn said(scene: &LiveScene, registry: &Registry) -> BTreeMap<String, String> {
    let roles = scene.scenario.characters.iter().zip(&scene.cast);
    let pools = roles
        .filter_map(|(role, (model, _))| repertoire::read(role.repertoire(model), registry).ok());
    let name = |file: ControllerFile| (file.contract.name.clone(), file.whole_text());
    pools.flatten().map(name).collect()
}

//! Files that are part of the program, listed by the compiler.

use include_dir::Dir;

/// Name and text of every `.ron` file of a folder and the folders in it, by name: the path within
/// the folder, without the ending.
///
/// ```
/// static CHARACTERS: include_dir::Dir = include_dir::include_dir!("$CARGO_MANIFEST_DIR/characters");
/// let all = aplomb_framework::input::shipped(&CHARACTERS);
/// assert!(all.iter().any(|(name, _)| *name == "humanoid"));
/// ```
#[must_use]
pub fn shipped(folder: &'static Dir<'static>) -> Vec<(&'static str, &'static str)> {
    let mut all: Vec<_> = folder.dirs().flat_map(shipped).collect();
    all.extend(folder.files().filter_map(|file| {
        let name = file.path().to_str()?.strip_suffix(".ron")?;
        Some((name, file.contents_utf8()?))
    }));
    all.sort_unstable();
    all
}

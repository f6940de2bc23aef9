//! Controllers as files: RON → [`Spec`] → [`Controller`]. A registry knows the kinds of controllers
//! and the shipped files; it is a value that is passed, never a global.

use std::collections::BTreeMap;
use std::sync::Arc;

use ron::value::RawValue;
use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::character::Model;
use crate::control::contract::Contract;
use crate::control::controller::Controller;
use crate::input::{Error, Result, Source};

/// The parameters of one kind of controller, as in the `spec` field of a file.
///
/// ```
/// # use aplomb_framework::{control::repertoire, prelude::*};
/// # #[derive(Debug, Clone)]
/// # struct Limp(Contract);
/// # impl Controller for Limp {
/// #     fn contract(&self) -> &Contract { &self.0 }
/// #     fn enter(&mut self, _: &Sensors) {}
/// #     fn act(&mut self, _: &Sensors, torques: &mut [f64]) { torques.fill(0.0); }
/// #     fn clone_box(&self) -> Box<dyn Controller> { Box::new(self.clone()) }
/// # }
/// #[derive(serde::Deserialize)]
/// struct LimpSpec {} // no parameters
///
/// impl Spec for LimpSpec {
///     const KIND: &'static str = "limp";
///     fn build(self, contract: Contract, _: &Arc<Model>) -> Result<Box<dyn Controller>> {
///         Ok(Box::new(Limp(contract))) // a controller as in the example of `Controller`
///     }
/// }
/// # let text = r#"(name: "faint", fallback: "limp", controllers: [
/// #     Here((kind: "limp", contract: (name: "limp", weight: 1, precondition: Always)))])"#;
/// let registry = Registry::new().with::<LimpSpec>().with_file("repertoires/faint.ron", text);
/// # let pool = repertoire::load("faint", &registry, &Model::load("humanoid")?)?;
/// # assert_eq!(pool.controllers().count(), 1);
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
pub trait Spec: DeserializeOwned {
    /// The kind's name, as in the `kind` field: `balance`, `pose`.
    const KIND: &'static str;

    /// Builds the controller for a character. This is where joint names are looked up and numbers
    /// are checked: control itself cannot fail.
    ///
    /// # Errors
    /// Whatever the spec names and the model lacks, and numbers out of bounds: by their way from the
    /// spec ([`Error::inside`]), so that the registry can tell where they stand.
    fn build(self, contract: Contract, model: &Arc<Model>) -> Result<Box<dyn Controller>>;
}

/// A controller file.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ControllerFile {
    /// A registered kind.
    pub kind: String,
    /// What the controller promises.
    pub contract: Contract,
    /// What the controller is measured by, for those who train and measure it; not read here.
    #[serde(default)]
    pub exercise: Option<Box<RawValue>>,
    /// The kind's parameters.
    #[serde(default = "empty")]
    pub spec: Box<RawValue>,
    /// The text that it stands in, for messages.
    #[serde(skip)]
    pub source: Source,
}

impl ControllerFile {
    /// Parses the text that a controller file is, or the part of a text ([`Source::part`]).
    ///
    /// # Errors
    /// [`Error::Syntax`] with line and column.
    pub fn parse(source: Source) -> Result<Self> {
        let file: Self = source.parse()?;
        Ok(Self { source, ..file })
    }

    /// All that it says, whatever its spaces and comments.
    #[must_use]
    pub fn whole_text(&self) -> String {
        format!("{} {:?} {}", self.kind, self.contract, self.spec.get_ron())
    }

    /// Its parameters.
    ///
    /// # Errors
    /// Another kind of controller, or bad syntax.
    pub fn parameters<S: Spec>(&self) -> Result<S> {
        if self.kind != S::KIND {
            let other = Error::unknown("kind", &self.kind, [S::KIND]);
            return Err(self.source.locate(other.inside("kind")));
        }
        self.source.parse_part("spec", &self.spec)
    }
}

fn empty() -> Box<RawValue> {
    RawValue::from_ron("()")
        .map(ToOwned::to_owned)
        .unwrap_or_else(|_| unreachable!("() is RON"))
}

/// The folder of the shipped repertoires.
pub(super) const REPERTOIRES: &str = "repertoires/";

type Build = fn(&Source, &RawValue, Contract, &Arc<Model>) -> Result<Box<dyn Controller>>;

/// The kinds of controllers and the shipped files that can be referred to by name.
///
/// ```
/// # use aplomb_framework::{control::repertoire, prelude::*};
/// let text = r#"(name: "faint", fallback: "limp", controllers: [
///     Here((kind: "limp", contract: (name: "limp", weight: 1, precondition: Always)))])"#;
/// let registry = Registry::new().with_file("repertoires/faint.ron", text);
/// // The file is known, its kind of controller is not: see `with`.
/// let refusal = repertoire::load("faint", &registry, &Model::load("humanoid")?).unwrap_err();
/// assert!(refusal.to_string().contains("kind is 'limp'"), "{refusal}");
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Registry {
    kinds: BTreeMap<&'static str, Build>,
    files: BTreeMap<String, &'static str>,
}

impl Registry {
    /// Knows nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a kind of controller.
    #[must_use]
    pub fn with<S: Spec>(mut self) -> Self {
        self.kinds.insert(S::KIND, build::<S>);
        self
    }

    /// Adds a shipped file under its name, for example `skills/bow.ron`.
    #[must_use]
    pub fn with_file(mut self, name: impl Into<String>, text: &'static str) -> Self {
        self.files.insert(name.into(), text);
        self
    }

    /// A shipped file.
    #[must_use]
    pub fn file(&self, name: &str) -> Option<Source> {
        let text = self.files.get(name)?;
        Some(Source::new(format!("built-in {name}"), *text))
    }

    /// A shipped repertoire by its name: `humanoid` is `repertoires/humanoid.ron`.
    #[must_use]
    pub fn repertoire(&self, name: &str) -> Option<Source> {
        self.file(&format!("{REPERTOIRES}{name}.ron"))
    }

    /// Names of the shipped repertoires.
    pub fn repertoires(&self) -> impl Iterator<Item = &str> {
        let name = |file| str::strip_prefix(file, REPERTOIRES)?.strip_suffix(".ron");
        self.files().filter_map(name)
    }

    /// Names of the shipped files.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        self.files.keys().map(String::as_str)
    }

    /// Builds a controller from a parsed file.
    ///
    /// # Errors
    /// An unknown kind, with the nearest; a spec or contract that does not fit the character.
    pub fn build(&self, file: &ControllerFile, model: &Arc<Model>) -> Result<Box<dyn Controller>> {
        let source = &file.source;
        let build = self.kinds.get(file.kind.as_str()).ok_or_else(|| {
            let known = self.kinds.keys().copied();
            source.locate(Error::unknown("controller kind", &file.kind, known).inside("kind"))
        })?;
        let mut contract = file.contract.clone();
        let resolved = contract.resolve(model);
        resolved.map_err(|e| source.locate(e.inside("contract")))?;
        build(source, &file.spec, contract, model)
    }
}

fn build<S: Spec>(
    source: &Source,
    raw: &RawValue,
    contract: Contract,
    model: &Arc<Model>,
) -> Result<Box<dyn Controller>> {
    let spec: S = source.parse_part("spec", raw)?;
    let built = spec.build(contract, model);
    built.map_err(|e| source.locate(e.inside("spec")))
}

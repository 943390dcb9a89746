//! The flags that describe a contact to solve.

use super::choice::one_of;
use super::exit_status::usage;
use super::units::Units;
use super::warnings;
use super::warnings::print_if_cut_off;
use anyhow::Result;
use asperity::contact::first_archive;
use asperity::files::path_in_text;
use asperity::formats::has_field;
use asperity::setup::{FlagValue, Key, SetupTable, lay};
use clap::{Arg, ArgAction, ArgGroup, ArgMatches, Command, Error, FromArgMatches};
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

/// The array of an archive that makes it a result.
const SETUP_ARRAY: &str = "setup";

/// Which flags of a setup a command has, and their names.
pub(crate) trait Extent {
    /// The heading of the flags of the load.
    const LOAD: &'static str;

    /// Whether a flag is one of the command.
    fn takes(key: &Key) -> bool;

    /// The name of a flag.
    fn name(key: &'static Key) -> &'static str {
        key.flag
    }

    /// The argument for a scene.
    fn scene() -> Arg {
        Arg::new("scene").value_name("SCENE.toml").help("A scene, or a file of heights; flags override its values")
    }
}

/// All of a setup.
pub(crate) struct OfSetup;

/// The surface and its grid alone.
pub(crate) struct OfSurface;

/// The problem that another code has solved, and the goals for its result. Its mean pressure has another flag, since
/// `--pressure` is a field here.
pub(crate) struct OfProblem;

impl Extent for OfSetup {
    const LOAD: &'static str = LOAD;

    fn takes(_: &Key) -> bool {
        true
    }
}

impl Extent for OfSurface {
    const LOAD: &'static str = LOAD;

    fn takes(key: &Key) -> bool {
        ["surface", "grid"].contains(&key.section())
    }
}

impl Extent for OfProblem {
    const LOAD: &'static str = "Load (one of --mean-pressure, --reduced-pressure, --mean-gap)";

    fn takes(key: &Key) -> bool {
        let is_goal = ["tolerance", "pressure-tolerance"].contains(&key.flag);
        is_goal || !SOLVE_SECTIONS.contains(&key.section()) && !key.is_of_drive()
    }

    fn name(key: &'static Key) -> &'static str {
        if key.flag == "pressure" { "mean-pressure" } else { key.flag }
    }

    fn scene() -> Arg {
        Arg::new("scene").long("setup").value_name("SCENE.toml").help("A scene; flags override its values")
    }
}

/// A surface and a solid whose load is found, and the solver.
pub(crate) struct OfSealing;

impl Extent for OfSealing {
    const LOAD: &'static str = LOAD;

    fn takes(key: &Key) -> bool {
        ["surface", "grid", "solid", "law", "solver", "stop"].contains(&key.section()) && !key.is_of_drive()
    }
}

/// A setup whose contact patches are followed: all but what is written of it.
pub(crate) struct OfPatches;

impl Extent for OfPatches {
    const LOAD: &'static str = LOAD;

    fn takes(key: &Key) -> bool {
        !["record", "flow"].contains(&key.section())
    }
}

/// Sections besides those of the drives that describe how a contact is solved, or what follows it.
const SOLVE_SECTIONS: [&str; 5] = ["friction", "path", "flow", "solver", "stop"];

/// A scene and the flags that are laid over it.
pub(crate) struct SceneArgs<E> {
    /// A scene, or a result that carries one.
    file: Option<PathBuf>,
    given: Vec<(&'static Key, Vec<String>)>,
    extent: PhantomData<E>,
}

impl<E: Extent> SceneArgs<E> {
    /// The same flags over another scene.
    pub(crate) fn with_file(&self, file: PathBuf) -> Self {
        Self { file: Some(file), given: self.given.clone(), extent: PhantomData }
    }

    /// The scene itself, if it is given.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// A scene as it is in its file.
    pub(crate) fn from_file(file: PathBuf) -> Self {
        Self { file: Some(file), given: Vec::new(), extent: PhantomData }
    }

    /// The file of a result that is not solved again: an archive, or the folder of a run that was killed, without flags.
    pub(crate) fn result(&self) -> Option<&Path> {
        let is_archive =
            |path: &&Path| path.is_dir() || path.extension().is_some_and(|it| it.eq_ignore_ascii_case("npz"));
        self.file.as_deref().filter(|_| self.given.is_empty()).filter(is_archive)
    }

    /// All files that are read for the setup in `table`, and its own.
    pub(crate) fn files(&self, table: &SetupTable) -> Vec<PathBuf> {
        self.file.iter().cloned().chain(table.files()).collect()
    }

    /// The setup as it was given, its sections and keys apart.
    pub(crate) fn table(&self) -> Result<SetupTable> {
        let path = self.file.as_deref().map(first_archive);
        path.as_deref().map_or(Ok(()), print_if_cut_off)?;
        let mut table = path.as_deref().map_or_else(|| Ok(SetupTable::default()), read)?;
        // a saved scene has numbers in SI, over which flags may lay quantities with units
        table.check_units()?;
        let mut flags = SetupTable::default();
        lay(&self.given, &mut flags);
        flags.check_units()?;
        lay(&self.given, &mut table);
        table.check_idle()?;
        warnings::print_reasons(&table.choose_preparation()?);
        table.check_force_units()?;
        Ok(table)
    }

    /// The units that the scene and the flags state, and those of a height file in the surface.
    pub(crate) fn units(&self) -> Units {
        let table = self.file.as_deref().map(|path| read(&first_archive(path)));
        let mut table = table.and_then(Result::ok).unwrap_or_default();
        lay(&self.given, &mut table);
        Units::new(&table)
    }

    fn flags() -> impl Iterator<Item = &'static Key> {
        Key::with_flags().filter(|key| E::takes(key))
    }
}

/// The setup in a scene or a result, or one of the heights in any other file.
fn read(path: &Path) -> Result<SetupTable> {
    if let Some(setups) = asperity::record::setups(path)? {
        return match setups.as_slice() {
            [setup] => Ok(SetupTable::from_toml(setup)?.with_files_of_result(path)?),
            more => {
                usage(format!("{} contains {} setups: give a recording of one contact", path.display(), more.len()))
            }
        };
    }
    match SetupTable::read(path) {
        Ok(table) if table != SetupTable::default() || is_named_scene(path) => Ok(table),
        Err(error) if !path.is_file() || is_named_scene(path) || has_setup(path) => Err(error.into()),
        _ => {
            let mut table = SetupTable::default();
            table.lay("surface.height", path_in_text(path)?.into());
            Ok(table)
        }
    }
}

/// Whether a file is an archive with a setup. A result that is damaged is no file of heights.
fn has_setup(path: &Path) -> bool {
    has_field(path, SETUP_ARRAY)
        .unwrap_or_else(|_| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("npz")))
}

/// Whether the name of a file is that of a scene, a summary or a recording, independent of its content. An archive may
/// hold a result or heights.
fn is_named_scene(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    ["toml", "json", "rrd"].iter().any(|it| ending.eq_ignore_ascii_case(it))
}

impl<E: Extent> FromArgMatches for SceneArgs<E> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let words = |key: &'static Key| {
            if matches!(key.value, FlagValue::Switch) {
                return matches.get_flag(E::name(key)).then(|| (key, Vec::new()));
            }
            let words = matches.get_many::<String>(E::name(key))?;
            Some((key, words.cloned().collect()))
        };
        let file = ["scene", "setup-of"].iter().find_map(|name| matches.get_one::<PathBuf>(name).cloned());
        Ok(Self { file, given: Self::flags().filter_map(words).collect(), extent: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<E: Extent> clap::Args for SceneArgs<E> {
    fn augment_args(command: Command) -> Command {
        let path = |arg: Arg| arg.value_parser(clap::value_parser!(PathBuf));
        let command = command
            .arg(path(E::scene()))
            .arg(
                path(Arg::new("setup-of").long("setup-of"))
                    .value_name("RESULT")
                    .help("A result (.npz, .json or .rrd) whose setup is used instead of a scene")
                    .conflicts_with("scene"),
            )
            .args(Self::flags().map(arg::<E>));
        let loads = Self::flags().filter(|key| key.section() == "load").map(E::name);
        command.group(ArgGroup::new("load").args(loads))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// Heading of the flags of the load.
pub(crate) const LOAD: &str = "Load (one of --pressure, --reduced-pressure, --mean-gap; several loads: 1e5,1e6, or 1e-3..1e-1:13 for 13 loads with equal ratios)";

/// A flag as the parser takes it.
fn arg<E: Extent>(key: &'static Key) -> Arg {
    let arg = Arg::new(E::name(key)).long(E::name(key)).value_name(key.placeholder).help(key.help);
    let arg = arg.help_heading(heading::<E>(key));
    let arg = if key.section() == "record" { arg.requires("recorded") } else { arg };
    match key.value {
        FlagValue::One => arg,
        FlagValue::List => arg.value_delimiter(','),
        FlagValue::Switch => arg.action(ArgAction::SetTrue),
        FlagValue::Choice(names) | FlagValue::Variant(names) => arg.value_parser(one_of(names())),
        FlagValue::Choices(names) => arg.value_delimiter(',').value_parser(one_of(names())),
    }
}

/// The heading of the flags of drives that have none of their own, and of their paths.
const HISTORY: &str = "History (creep, slip, sliding, rolling or adhesion)";

fn heading<E: Extent>(key: &Key) -> &'static str {
    match key.section() {
        "surface" if key.path.starts_with("surface.indenter.") => "Indenter",
        "surface" if key.path.starts_with("surface.prepare.") => "Preparation of measured heights, in this order",
        "surface" if key.path.starts_with("surface.spectrum.") || key.flag == "seed" => "Roughness",
        "surface" | "grid" => "Surface (a height file, an indenter, roughness, or a sum of them) and its cell",
        "load" => E::LOAD,
        "solid" | "law" => "Solid (contact modulus, or elastic constants; required with a mean pressure)",
        "friction" => "Friction (a tangential load after the normal one)",
        "adhesion" => "Adhesion (an attraction between the surfaces)",
        "path" => HISTORY,
        "flow" => "Flow through the contact",
        "record" => "Recording",
        _ if key.is_of_drive() => HISTORY,
        _ => "Solver",
    }
}

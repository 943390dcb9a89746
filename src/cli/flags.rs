//! The flags that describe a contact to solve.

use super::choice::one_of;
use super::outcome::usage;
use anyhow::Result;
use asperity::setup::{FLAGS, Flag, Table, Value, lay};
use clap::{Arg, ArgGroup, ArgMatches, Command, Error, FromArgMatches};
use std::path::{Path, PathBuf};

/// A scene and the flags that are laid over it: those of the surface and its grid alone, or of the whole setup.
pub struct Scene<const WHOLE: bool> {
    /// A scene, or a result that carries one.
    file: Option<PathBuf>,
    given: Vec<(&'static Flag, Vec<String>)>,
}

impl<const WHOLE: bool> Scene<WHOLE> {
    /// The setup as it was given, its sections and keys apart.
    pub fn table(&self) -> Result<Table> {
        let mut table = self.file.as_deref().map_or_else(|| Ok(Table::default()), read)?;
        lay(&self.given, &mut table);
        Ok(table)
    }

    /// The flags, of which those of a recording only where one can be made.
    fn flags() -> impl Iterator<Item = &'static Flag> {
        FLAGS.iter().filter(|flag| match flag.section() {
            "surface" | "grid" => true,
            "record" => WHOLE && cfg!(feature = "record"),
            _ => WHOLE,
        })
    }
}

/// The setup in a scene or a result.
fn read(path: &Path) -> Result<Table> {
    #[cfg(feature = "record")]
    if let Some(setups) = asperity::record::setups(path)? {
        return match setups.as_slice() {
            [setup] => Ok(Table::from_toml(setup)?),
            more => usage(format!("{} holds {} setups: give a recording of one contact", path.display(), more.len())),
        };
    }
    Ok(Table::read(path)?)
}

impl<const WHOLE: bool> FromArgMatches for Scene<WHOLE> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let words = |flag: &'static Flag| {
            let words = matches.get_many::<String>(flag.name)?;
            Some((flag, words.cloned().collect()))
        };
        let file = ["scene", "setup-of"].iter().find_map(|name| matches.get_one::<PathBuf>(name).cloned());
        Ok(Self { file, given: Self::flags().filter_map(words).collect() })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl<const WHOLE: bool> clap::Args for Scene<WHOLE> {
    fn augment_args(command: Command) -> Command {
        let path = |arg: Arg| arg.value_parser(clap::value_parser!(PathBuf));
        let command = command
            .arg(path(Arg::new("scene")).value_name("SCENE.toml").help("A scene; flags override what it says"))
            .arg(
                path(Arg::new("setup-of").long("setup-of"))
                    .value_name("RESULT")
                    .help("The setup that a result carries (.npz, .json or .rrd), instead of a scene")
                    .conflicts_with("scene"),
            )
            .args(Self::flags().map(arg));
        if WHOLE {
            command.group(ArgGroup::new("load").args(["pressure", "reduced-pressure", "mean-gap"]))
        } else {
            command
        }
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// Heading of the flags of the load.
pub const LOAD: &str = "Load (one of --pressure, --reduced-pressure, --mean-gap; several as 1e5,1e6 or 1e-3..1e-1:13)";

/// A flag as the parser takes it.
fn arg(flag: &'static Flag) -> Arg {
    let arg = Arg::new(flag.name).long(flag.name).value_name(flag.placeholder).help(flag.help);
    let arg = arg.help_heading(heading(flag)).allow_negative_numbers(true);
    let needs_recording = flag.section() == "record" && flag.name != "length-unit";
    let arg = if needs_recording { arg.requires("recorded") } else { arg };
    match flag.value {
        Value::One => arg,
        Value::List => arg.value_delimiter(','),
        Value::Choice(names) | Value::Variant(names) => arg.value_parser(one_of(names.iter().copied())),
        Value::Choices(names) => arg.value_delimiter(',').value_parser(one_of(names.iter().copied())),
    }
}

fn heading(flag: &Flag) -> &'static str {
    match flag.section() {
        "surface" if flag.path.starts_with("surface.indenter.") => "Indenter",
        "surface" if !["height", "detrend"].contains(&flag.name) => "Roughness",
        "surface" | "grid" => "Surface (a height file, an indenter, roughness, or a sum of them) and its cell",
        "load" => LOAD,
        "solid" => "Solid (the contact modulus, or elastic constants; a mean pressure needs it)",
        "record" => "Recording",
        _ => "Solver",
    }
}

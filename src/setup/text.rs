//! Setups as text.

use super::fault::{found_in, keys_of};
use super::{Cell, Key, Method, Recipe, Setup};
use crate::contact::first_archive;
use crate::error::{ConflictRule, FileError, SetupError, TextFault, TextPlace};
use crate::files::{path_in_text, read_text_bytes, write_beside};
use crate::formats::{has_field, read_fields, read_text};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::Path;

/// The only method that has settings.
const GFMD: &str = "gfmd";

/// A setup that is not checked yet: sections and keys with any values, which can be overridden before it is read.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct SetupTable(toml::Table);

impl SetupTable {
    /// The sections and keys of a TOML text, or of one inline table in braces as [`SetupTable::to_line`] writes it.
    ///
    /// # Errors
    /// [`SetupError::Text`] with the line for a text that is no TOML.
    pub fn from_toml(text: &str) -> Result<Self, SetupError> {
        let parsed = match text.trim_start().starts_with('{') {
            true => toml::de::ValueDeserializer::parse(text.trim()).and_then(toml::Table::deserialize),
            false => text.parse(),
        };
        parsed.map(Self).map_err(|error: toml::de::Error| {
            let line = error.span().map_or(1, |span| text[..span.start.min(text.len())].lines().count().max(1));
            let place = TextPlace { line: Some(line), ..TextPlace::default() };
            SetupError::Text { place, fault: TextFault::from_parser(error.message()).into() }
        })
    }

    /// The sections and keys of a setup.
    pub(super) fn from_value(setup: &impl Serialize) -> Self {
        Self(toml::Table::try_from(setup).expect("a setup has a form in TOML"))
    }

    /// The sections and keys of a JSON text: a setup, or a result that carries one as `setup`.
    ///
    /// # Errors
    /// [`SetupError::Text`] for a text that is no JSON object.
    #[cfg(feature = "units")]
    pub fn from_json(text: &str) -> Result<Self, SetupError> {
        let wrong = |why: String| SetupError::text("", format!("this is not a setup in JSON: {why}"));
        let mut value: serde_json::Value = serde_json::from_str(text).map_err(|error| match error.is_eof() {
            true => wrong(format!("the text ends too early, in line {}", error.line())),
            false => wrong(error.to_string()),
        })?;
        let setup = value.get_mut("setup").map(serde_json::Value::take).unwrap_or(value);
        let shape = "give an object with sections such as `surface` and `load`, and no value that is null";
        toml::Table::try_from(setup).map(Self).map_err(|_| wrong(shape.into()))
    }

    /// The sections and keys of a file: a scene, or a result in JSON or `.npz`. The files that a scene names are found beside it; the height file
    /// of an `.npz` result is the result itself, which holds the heights.
    ///
    /// # Errors
    /// [`FileError::Read`] for one that cannot be read, [`SetupError::Text`] for one that holds no setup.
    pub fn read(path: &Path) -> Result<Self, SetupError> {
        let path = &*first_archive(path);
        match read_text(path, "setup") {
            Ok(Some(text)) => Ok(Self::from_toml(&text)
                .map_err(|error| error.in_file(path))?
                .with_files_of_result(path)?
                .with_heights_of(path)?),
            Ok(None) => Self::read_scene(path),
            Err(FileError::Format { reason, .. }) => {
                Err(SetupError::text("", format!("it contains no setup: {reason}")).in_file(path))
            }
            Err(error) => Err(error.into()),
        }
    }

    fn read_scene(path: &Path) -> Result<Self, SetupError> {
        let text = String::from_utf8(read_text_bytes(path)?).map_err(|_| {
            let reason = "it is not text: give a scene (.toml or .json), or a result (.npz)".into();
            FileError::Format { path: path.into(), what: "setup", reason }
        })?;
        let is_json = text.trim_start().strip_prefix('{').is_some_and(|rest| rest.trim_start().starts_with(['"', '}']));
        let table = match is_json {
            #[cfg(feature = "units")]
            true => Self::from_json(&text),
            _ => Self::from_toml(&text),
        };
        Ok(table.map_err(|error| error.in_file(path))?.beside(path)?)
    }

    /// The setup whose surface, if it was made with a height file, is the one that a result holds.
    fn with_heights_of(mut self, result: &Path) -> Result<Self, FileError> {
        if self.find("surface.height").is_some() {
            self.remove("surface");
            self.remove("grid.refine");
            self.lay("surface.height", path_in_text(result)?.into());
            if has_field(result, "size")? {
                let size = read_fields(result, "size")?;
                self.lay("grid.size", size.iter().copied().collect::<Vec<f64>>().into());
            }
        }
        Ok(self)
    }

    /// The sections and keys as TOML, all numbers to the last bit.
    pub fn to_toml(&self) -> String {
        toml::to_string(&self.0).expect("a table has a form in TOML")
    }

    /// The sections and keys as one inline table of TOML on a single line, all numbers to the last bit.
    ///
    /// ```
    /// use asperity::setup::SetupTable;
    /// let table = SetupTable::from_toml("load.reduced-pressure = 0.1\ngrid.points = 64")?;
    /// assert_eq!(table.to_line(), "{ grid = { points = 64 }, load = { reduced-pressure = 0.1 } }");
    /// assert_eq!(SetupTable::from_toml(&table.to_line())?, table);
    /// # Ok::<(), asperity::error::SetupError>(())
    /// ```
    pub fn to_line(&self) -> String {
        toml::Value::Table(self.0.clone()).to_string()
    }

    /// Writes the sections and keys as a scene.
    ///
    /// # Errors
    /// The errors of [`write_beside`].
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        write_beside(path, |file| file.write_all(self.to_toml().as_bytes()))
    }

    /// Lays a value over what stands at a path of keys, such as `surface.indenter.radius`.
    pub fn lay(&mut self, path: &str, value: toml::Value) {
        let (sections, last) = path.rsplit_once('.').unwrap_or(("", path));
        let mut table = &mut self.0;
        for key in sections.split_terminator('.') {
            let entry = table.entry(key).or_insert_with(|| toml::Table::new().into());
            if !entry.is_table() {
                *entry = toml::Table::new().into();
            }
            table = entry.as_table_mut().expect("a table was just put there");
        }
        table.insert(last.into(), value);
    }

    /// Removes what stands at a path of keys.
    pub fn remove(&mut self, path: &str) {
        match path.rsplit_once('.') {
            None => self.0.remove(path),
            Some((above, last)) => {
                let table = above.split('.').try_fold(&mut self.0, |table, key| table.get_mut(key)?.as_table_mut());
                table.and_then(|table| table.remove(last))
            }
        };
    }

    /// The sections with what is in them, by their names.
    pub(super) fn sections(&self) -> impl Iterator<Item = (&String, &toml::Value)> {
        self.0.iter()
    }

    /// The value at a path of keys, to be changed.
    pub(super) fn find_mut(&mut self, path: &str) -> Option<&mut toml::Value> {
        let mut keys = path.split('.');
        let first = self.0.get_mut(keys.next()?);
        keys.try_fold(first?, |value, key| value.get_mut(key))
    }

    /// The value at a path of keys.
    pub(super) fn find(&self, path: &str) -> Option<&toml::Value> {
        let mut keys = path.split('.');
        let first = self.0.get(keys.next()?);
        keys.try_fold(first?, |value, key| value.get(key))
    }

    /// All texts among the values, those in lists as well.
    pub fn texts(&self) -> Vec<&str> {
        fn add<'a>(value: &'a toml::Value, texts: &mut Vec<&'a str>) {
            match value {
                toml::Value::String(text) => texts.push(text),
                toml::Value::Array(values) => values.iter().for_each(|value| add(value, texts)),
                toml::Value::Table(table) => table.values().for_each(|value| add(value, texts)),
                _ => {}
            }
        }
        let mut texts = Vec::new();
        self.0.values().for_each(|value| add(value, &mut texts));
        texts
    }

    /// Whether there is a load.
    pub fn has_load(&self) -> bool {
        self.find("load").and_then(toml::Value::as_table).is_some_and(|load| !load.is_empty())
    }

    /// The setup.
    ///
    /// # Errors
    /// [`SetupError::Text`] that names the section and the key, and for an unknown one the nearest that is known;
    /// [`SetupError::UnitWithoutModulus`] for a hardness, yield stress or work of adhesion with a unit on no modulus.
    pub fn setup(mut self) -> Result<Setup, SetupError> {
        let list = self.take_loads()?.unwrap_or_default();
        self.check_digests()?;
        self.check_surface()?;
        self.check_sections()?;
        self.choose_preparation()?;
        self.complete_solver()?;
        self.complete_units();
        let modulus = self.check_modulus();
        let loads = self.check_load().and_then(|()| self.read_tangential()).and_then(|()| self.read_path());
        // an unknown key, such as a misspelt load, is said first
        let setup: Setup = self.read_as()?;
        modulus.and(loads)?;
        Ok(Setup { loads: list, ..setup })
    }

    /// Checks that there is a surface.
    fn check_surface(&self) -> Result<(), SetupError> {
        let is_empty = |surface: &toml::Value| surface.as_table().is_some_and(toml::Table::is_empty);
        if self.0.get("surface").is_none_or(is_empty) { Err(ConflictRule::NoSurface.into()) } else { Ok(()) }
    }

    /// Inserts the usual method where none is given, and refuses settings of another method.
    fn complete_solver(&mut self) -> Result<(), SetupError> {
        let Some(toml::Value::Table(solver)) = self.0.get_mut("solver") else { return Ok(()) };
        let method = solver.entry("method").or_insert(Method::default().name().into()).clone();
        let is_setting = |key: &&String| Key::find(&format!("solver.{key}")).is_some() && *key != "method";
        match (solver.keys().find(is_setting), method.as_str()) {
            (Some(key), Some(method)) if method != GFMD => {
                let reason = format!(
                    "`{key}` is a setting of the method {GFMD}, but the method is {method}: give the method {GFMD}, or \
                     leave `{key}` out"
                );
                Err(SetupError::text("solver", reason))
            }
            _ => Ok(()),
        }
    }

    /// Checks that there is one load, and inserts one if there is none, so that the rest can be read.
    fn check_load(&mut self) -> Result<(), SetupError> {
        let load = self.0.entry("load").or_insert_with(|| toml::Table::new().into());
        let keys: Vec<&String> = load.as_table().into_iter().flat_map(toml::Table::keys).collect();
        let checked = match keys.as_slice() {
            [_] => return Ok(()),
            [] if load.is_table() => Err(ConflictRule::NoLoad.into()),
            [] => Err(wrong_load("expected a name and a number, such as { mean-pressure = 0.01 }".into())),
            [one, other, ..] => Err(wrong_load(format!("both `{one}` and `{other}` are given: give one of them"))),
        };
        *load = toml::Table::from_iter([("mean-pressure".to_owned(), toml::Value::Float(1.0))]).into();
        checked
    }

    /// The recipe of a surface and its cell; everything else is ignored.
    ///
    /// # Errors
    /// The errors of [`SetupTable::setup`].
    pub fn surface(mut self) -> Result<(Recipe, Cell), SetupError> {
        self.check_surface()?;
        self.choose_preparation()?;
        #[derive(Deserialize)]
        struct SurfaceSections {
            surface: Recipe,
            grid: Cell,
        }
        self.0.retain(|section, _| section == "surface" || section == "grid");
        let SurfaceSections { surface, grid } = self.read_as()?;
        Ok((surface, grid))
    }

    /// The recipe of the surface without its preparation, whatever its cell is.
    ///
    /// # Errors
    /// [`SetupError::Text`].
    pub(super) fn recipe(&self) -> Result<Recipe, SetupError> {
        #[derive(Deserialize)]
        struct SurfaceSection {
            surface: Recipe,
        }
        let mut table = self.clone();
        table.0.retain(|section, _| section == "surface");
        table.remove("surface.prepare");
        Ok(table.read_as::<SurfaceSection>()?.surface)
    }

    /// Reads it with a section for the grid, be it empty.
    pub(super) fn read_as<T: DeserializeOwned>(mut self) -> Result<T, SetupError> {
        self.0.entry("grid").or_insert_with(|| toml::Table::new().into());
        self.0.clone().try_into().map_err(|error: toml::de::Error| {
            let keys = keys_of(&error);
            let fault = TextFault::from_serde(error.message(), &keys);
            SetupError::Text { place: TextPlace::keys(self.keys_of_value(keys, &fault)), fault: fault.into() }
        })
    }

    /// The keys of the value that a fault is about, where `keys` lead to the section of the value alone.
    fn keys_of_value(&self, keys: String, fault: &TextFault) -> String {
        let is_named = |value: &toml::Value| match fault {
            TextFault::UnknownValue { value: name, .. } => value.as_str() == Some(name),
            TextFault::WrongType { found, .. } | TextFault::WrongValue { found, .. } => *found == found_in(value),
            _ => false,
        };
        let section = self.find(&keys).and_then(toml::Value::as_table);
        let mut found = section.into_iter().flatten().filter(|(_, value)| is_named(value));
        match (found.next(), found.next()) {
            (Some((key, _)), None) => format!("{keys}.{key}"),
            _ => keys,
        }
    }
}

pub(super) fn wrong_load(reason: String) -> SetupError {
    SetupError::text("load", reason)
}

impl Setup {
    /// The setup that a TOML text describes.
    ///
    /// # Errors
    /// [`SetupError::Text`].
    pub fn from_toml(text: &str) -> Result<Self, SetupError> {
        SetupTable::from_toml(text)?.setup()
    }

    /// The setup as TOML, all numbers to the last bit.
    pub fn to_toml(&self) -> String {
        match self.loads.as_slice() {
            [] => toml::to_string(self).expect("a setup has a form in TOML"),
            _ => self.to_table().to_toml(),
        }
    }

    /// The setup with its sections and keys apart.
    pub fn to_table(&self) -> SetupTable {
        SetupTable::from_value(self).with_loads(&self.loads)
    }

    /// Writes the setup as a scene, with the digests of its files. These keep the names that were given; where the scene is given by a path
    /// below the working folder, they are named as seen from there.
    ///
    /// # Errors
    /// The errors of [`write_beside`].
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        self.to_saved_table().write_scene(path)
    }
}

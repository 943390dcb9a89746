//! Setups as command lines: flags laid over a setup, and the line that repeats one.

use super::{FLAGS, Flag, Setup, Table, Value};

/// Lays flags with their words over a setup, in the order of [`FLAGS`].
pub fn lay(given: &[(&Flag, Vec<String>)], over: &mut Table) {
    if given.iter().any(|(flag, _)| flag.section() == "load") {
        over.remove("load");
    }
    for (flag, words) in given {
        if let (Value::Variant(_), Some((beside, _))) = (flag.value, flag.path.rsplit_once('.')) {
            over.remove(beside);
        }
        over.lay(flag.path, read(flag, words));
    }
}

/// A whole number, a number, or a text; whole numbers that are too long stay as they are written.
fn value(word: &str) -> toml::Value {
    match (word.parse::<i64>(), word.parse()) {
        (Ok(whole), _) if whole.to_string() == word => toml::Value::Integer(whole),
        (_, Ok(number)) if !word.bytes().all(|byte| byte.is_ascii_digit()) => toml::Value::Float(number),
        _ => toml::Value::String(word.into()),
    }
}

/// The command line that repeats a setup, to the last digit, without a recording.
pub fn command(setup: &Setup) -> String {
    let table = setup.to_table();
    let flags = FLAGS.iter().filter(|flag| flag.section() != "record");
    let written = |flag: &Flag| table.find(flag.path).map(|value| format!(" --{} {}", flag.name, word(value)));
    format!("asperity solve{}", flags.filter_map(written).collect::<String>())
}

/// A value as it is written on a command line.
fn word(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => text.clone(),
        toml::Value::Float(number) => format!("{number:e}"),
        toml::Value::Array(values) => values.iter().map(word).collect::<Vec<_>>().join(","),
        other => other.to_string(),
    }
}

/// The value that the words of a flag stand for.
fn read(flag: &Flag, words: &[String]) -> toml::Value {
    let is_list = matches!(flag.value, Value::List | Value::Choices(_));
    match words {
        [one] if !is_list => value(one),
        more => toml::Value::Array(more.iter().map(|word| value(word)).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Dynamics, Gfmd, Load, Masses};
    use crate::setup::{Cell, Method, Recipe};
    use crate::surface::{Indenter, Spectrum};

    /// The setup that a command line describes, its flags laid over nothing.
    fn parsed(command: &str) -> Setup {
        let words: Vec<&str> = command.split_whitespace().skip(2).collect();
        let mut table = Table::default();
        let given: Vec<_> = FLAGS
            .iter()
            .filter_map(|flag| {
                let at = words.iter().position(|word| word.strip_prefix("--") == Some(flag.name))?;
                Some((flag, words[at + 1].split(',').map(str::to_owned).collect()))
            })
            .collect();
        lay(&given, &mut table);
        table.setup().unwrap()
    }

    #[test]
    fn commands_repeat_their_setups_to_the_last_bit() {
        let indenters = [
            Indenter::Cylinder { radius: 0.1 + 0.2 },
            Indenter::PowerLaw { coefficient: 1.0 / 3.0, exponent: 4.0 },
            Indenter::Punch { half_width: 0.1, depth: 1e-300 },
        ];
        let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 1.0 / 7.0, short_cutoff: 0.01, rms_gradient: 1e-3 };
        let gfmd = Gfmd { masses: Masses::Stiffness, dynamics: Dynamics::Fire, time_step: 0.3, damping: 0.7 };
        for indenter in indenters {
            let surface = Recipe { indenter: Some(indenter), ..Recipe::rough(spectrum, u64::MAX >> 1) };
            let mut setup = Setup::new(surface, Cell::surface([64, 96], [1.0, 1.5]), Load::ReducedPressure(0.07));
            assert_eq!(parsed(&command(&setup)), setup);
            setup.solver = Method::Gfmd(gfmd);
            assert_eq!(parsed(&command(&setup)), setup);
        }
    }

    #[test]
    fn every_name_that_can_be_chosen_can_be_read() {
        let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 0.2, short_cutoff: 0.1, rms_gradient: 0.1 };
        let setup = Setup::new(Recipe::rough(spectrum, 1), Cell::line(64, 1.0), Load::MeanGap(1.0));
        let setup = Setup { solver: Method::Gfmd(Gfmd::default()), ..setup };
        let is_unknown = |flag: &Flag, name: &str| {
            let mut table = setup.to_table();
            table.lay(flag.path, read(flag, &[name.into()]));
            table.setup().is_err_and(|error| error.to_string().contains("unknown variant"))
        };
        let mut chosen = 0;
        for flag in FLAGS {
            let (Value::Choice(names) | Value::Variant(names) | Value::Choices(names)) = flag.value else { continue };
            assert!(
                is_unknown(flag, "nothing") && !names.iter().any(|(name, _)| is_unknown(flag, name)),
                "{}",
                flag.name
            );
            chosen += 1;
        }
        assert_eq!(chosen, 5);
    }
}

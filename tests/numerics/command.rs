//! Command lines that repeat setups, and the names that can be chosen on them.

use asperity::contact::{Dynamics, Gfmd, Load, Masses};
use asperity::setup::{Cell, FlagValue, Key, Method, Recipe, Setup, SetupTable, command, lay};
use asperity::surface::{Indenter, Spectrum};

/// The setup that a command line describes, its flags laid over nothing.
fn parsed(command: &str) -> Setup {
    let words: Vec<&str> = command.split_whitespace().skip(2).collect();
    let mut table = SetupTable::default();
    let given: Vec<_> = Key::with_flags()
        .filter_map(|key| {
            let at = words.iter().position(|word| word.strip_prefix("--") == Some(key.flag))?;
            Some((key, words[at + 1].split(',').map(str::to_owned).collect()))
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
    let is_unknown = |key: &Key, name: &str| {
        let mut table = setup.to_table();
        lay(&[(key, vec![name.into()])], &mut table);
        let says = |error: String| error.contains("unknown value") || error.contains("is not a preparation");
        table.setup().is_err_and(|error| says(error.to_string()))
    };
    let mut chosen = 0;
    for key in Key::with_flags() {
        let (FlagValue::Choice(names) | FlagValue::Variant(names) | FlagValue::Choices(names)) = key.value else {
            continue;
        };
        assert!(is_unknown(key, "nothing") && !names().iter().any(|(name, _)| is_unknown(key, name)), "{}", key.flag);
        chosen += 1;
    }
    assert_eq!(chosen, 23);
}

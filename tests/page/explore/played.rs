//! The lessons of the page, played to their ends: what they tell is what the program gives.

use super::Page;
use asperity::contact::{Contact, ContactModulus, Feels, Load, Multilevel, Quantity, Solver};
use asperity::flow::{FlowAxis, Leakage, PercolationLoad};
use asperity::surface::{Lay, RandomRoughness, Spectrum};
use asperity::{Grid, Problem, Stop};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::sync::LazyLock;
use std::time::Instant;

/// A step that was played: as it is written, the numbers of its run and of its solution, and the points of its sweep.
struct Played {
    step: Value,
    numbers: Value,
    solution: Option<Value>,
    sweep: Vec<Value>,
}

impl Played {
    fn number(&self, of: &str) -> f64 {
        self.numbers[of].as_f64().unwrap_or_else(|| panic!("{of} is {}", self.numbers[of]))
    }
}

/// All steps of all lessons, by the name of the lesson, each of them played once.
static LESSONS: LazyLock<BTreeMap<String, Vec<Played>>> = LazyLock::new(|| {
    let page = Page::open();
    let begun = Instant::now();
    let lessons = page.get("/api/lessons").json();
    let played = lessons.as_array().unwrap().iter().map(|lesson| {
        let steps = lesson["steps"].as_array().unwrap().iter().map(|step| played(&page, step));
        (lesson["name"].as_str().unwrap().to_owned(), steps.collect())
    });
    let played = played.collect();
    println!("All lessons take {:.1} s.", begun.elapsed().as_secs_f64());
    played
});

fn played(page: &Page, step: &Value) -> Played {
    let mut run = page.solve(&step["knobs"]);
    if step.to_string().contains("conductance") {
        run["numbers"]["conductance"] =
            page.get(&format!("/api/run/{}/conductance", run["id"].as_str().unwrap())).json();
    }
    let mut sweep = Vec::new();
    if step["sweep"] == true {
        page.order("/api/sweep", &step["knobs"]);
        let state = page.wait(|state| state["busy"] == false && state["sweep"]["ended"] == true);
        sweep = state["sweep"]["points"].as_array().unwrap().clone();
    }
    let solution = (!step["solution"].is_null()).then(|| page.solve(&step["solution"])["numbers"].clone());
    Played { step: step.clone(), numbers: run["numbers"].clone(), solution, sweep }
}

/// The number `of` in a step, counted from 1 on.
fn number(lesson: &str, step: usize, of: &str) -> f64 {
    LESSONS[lesson][step - 1].number(of)
}

/// Texts in one language: those of a step with its question and the answers, joined.
fn texts(step: &Value, language: &str) -> String {
    match step {
        Value::Object(map) if map.contains_key("en") => map.get(language).and_then(Value::as_str).unwrap_or("").into(),
        Value::Object(map) => {
            let said =
                |(key, value): (&String, &Value)| (key != "knobs" && key != "turn").then(|| texts(value, language));
            map.iter().filter_map(said).collect::<Vec<_>>().join(" ")
        }
        Value::Array(all) => all.iter().map(|it| texts(it, language)).collect::<Vec<_>>().join(" "),
        _ => String::new(),
    }
}

#[test]
fn every_lesson_is_played_to_its_end() {
    assert_eq!(LESSONS.len(), 13);
    for (name, steps) in LESSONS.iter() {
        let asked = steps.iter().filter(|played| played.step["ask"].is_object()).count();
        assert!(steps.len() >= 4 && asked + 1 >= steps.len(), "{name} asks {asked} times in {} steps", steps.len());
        for (at, played) in steps.iter().enumerate() {
            assert_eq!(played.numbers["status"], "converged", "{name}, step {}", at + 1);
            let asked = played.step["ask"]["of"].as_str();
            let turned = |knob: &str| played.step["knobs"][knob].as_f64() > Some(0.0);
            let creeps = turned("creep") && turned("time") && !turned("speed");
            let kind = match (turned("adhesion"), turned("yield-stress"), creeps) {
                (true, ..) => Feels::ATTRACTION,
                (_, true, _) => Feels::EIGENSTRAIN,
                (.., true) => Feels::MEMORY,
                _ => Feels::PRESSURE,
            };
            let shown = Quantity::traced().filter(|it| it.row().validity.holds(kind)).map(Quantity::name);
            let is_apart = played.numbers["relative_area"] == 0.0;
            // surfaces that have parted have no gap of their own, and nothing is read of a contact
            let absent = ["kappa", "mean_gap", "approach", "pressure_in_contact", "contact_pressure"];
            let of_contact = |of: &&str| is_apart && absent.iter().any(|start| of.starts_with(start));
            for of in shown.filter(|of| !of_contact(of)).chain(asked).chain(["iterations", "transforms"]) {
                assert!(played.number(of).is_finite(), "{name}, step {}: {of}", at + 1);
            }
            assert_eq!(played.step["sweep"] == true, !played.sweep.is_empty(), "{name}, step {}", at + 1);
        }
    }
}

#[test]
fn every_text_is_in_both_languages() {
    fn check(value: &Value, place: &str) {
        let each = |map: &Map<String, Value>| map.iter().for_each(|(key, it)| check(it, &format!("{place}, {key}")));
        match value {
            Value::Object(map) if map.contains_key("en") || map.contains_key("de") => {
                let is_name = map["en"] == "GFMD";
                assert!(map.len() == 2 && (map["en"] != map["de"] || is_name), "{place}: {value}");
            }
            Value::Object(map) => each(map),
            Value::Array(all) => all.iter().for_each(|it| check(it, place)),
            _ => {}
        }
    }
    for lesson in Page::open().get("/api/lessons").json().as_array().unwrap() {
        check(&lesson["title"], "a title");
        check(&lesson["end"], "an end");
        assert!(lesson["end"]["seen"].is_object(), "{} ends without a word", lesson["title"]);
    }
    for (name, steps) in LESSONS.iter() {
        for played in steps {
            for text in ["text", "ask"] {
                assert!(!played.step[text].is_string(), "{name} has a text in one language");
                check(&played.step[text], name);
            }
        }
    }
}

/// Words of a text that point, and the names of what they point at.
fn points(text: &str) -> Vec<(&str, &str)> {
    let parts = text.split("](").collect::<Vec<_>>();
    parts.windows(2).map(|pair| (pair[0].rsplit('[').next().unwrap(), pair[1].split(')').next().unwrap())).collect()
}

/// The first number of some words, with the half of its last digit.
fn number_in(words: &str) -> Option<(f64, f64)> {
    let plain = words.replace(',', ".");
    let begin = plain.find(|c: char| c.is_ascii_digit())?;
    let digits: String = plain[begin..].chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
    let decimals = digits.split_once('.').map_or(0, |(_, behind)| behind.len() as i32);
    let share = if plain.contains('%') { 0.01 } else { 1.0 };
    Some((digits.parse::<f64>().ok()? * share, 0.5 * 10f64.powi(-decimals) * share))
}

/// Where a number stands in words that point at a number of the table, it is that number; the work of a solver may differ by some steps
/// where processors round otherwise, and at a goal the number is about that of the solution.
#[test]
fn words_that_point_at_a_number_tell_it() {
    let mut checked = 0;
    for (lesson, steps) in LESSONS.iter() {
        for (at, played) in steps.iter().enumerate() {
            let numbers = played.solution.as_ref().unwrap_or(&played.numbers);
            for language in ["en", "de"] {
                for (words, name) in points(played.step["text"][language].as_str().unwrap()) {
                    let (Some(of), Some((told, half))) = (name.strip_prefix("number."), number_in(words)) else {
                        continue;
                    };
                    let is_work = ["iterations", "transforms"].contains(&of);
                    let within = if is_work || played.solution.is_some() { 0.05 * told } else { 1.01 * half };
                    let its = numbers[of].as_f64().unwrap_or_else(|| panic!("{lesson}, step {}: {of}", at + 1));
                    near(its, told, within, &format!("{lesson}, step {}, {language}: {of}", at + 1));
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 60, "{checked} numbers");
}

/// Both languages point at the same things, in their texts and questions.
#[test]
fn both_languages_point_at_the_same_things() {
    for (lesson, steps) in LESSONS.iter() {
        for (at, played) in steps.iter().enumerate() {
            for words in [&played.step["text"], &played.step["ask"]["question"]] {
                let names = |language: &str| {
                    let mut names: Vec<_> =
                        points(words[language].as_str().unwrap_or("")).into_iter().map(|(_, name)| name).collect();
                    names.sort_unstable();
                    names
                };
                assert_eq!(names("en"), names("de"), "{lesson}, step {}", at + 1);
            }
        }
    }
}

/// What a question asks to be made is not there at first, and is there in the solution that the page shows.
#[test]
fn solutions_reach_their_goals() {
    for (lesson, steps) in LESSONS.iter() {
        for played in steps.iter().filter(|it| it.step["ask"]["kind"] == "act") {
            let reached = |numbers: &Value| {
                let is_within = |(of, range): (&String, &Value)| {
                    let [least, most] = [0, 1].map(|end| range[end].as_f64().unwrap());
                    (least..=most).contains(&numbers[of].as_f64().unwrap())
                };
                played.step["ask"]["goal"].as_object().unwrap().iter().all(is_within)
            };
            let solution = played.solution.as_ref().unwrap_or_else(|| panic!("{lesson} has a goal without a solution"));
            assert!(reached(solution) && !reached(&played.numbers), "{lesson}: {}", played.step["ask"]["goal"]);
        }
    }
}

/// Numbers that a text tells, as it tells them: lesson, step, observable.
const TOLD: [(&str, usize, &str, &str); 49] = [
    ("hertz-and-rough", 2, "kappa_r", "1.46"),
    ("hertz-and-rough", 4, "patches", "31"),
    ("kappa-r", 1, "kappa", "2.56"),
    ("kappa-r", 1, "kappa_r", "1.65"),
    ("kappa-r", 2, "kappa", "3.07"),
    ("kappa-r", 2, "kappa_r", "1.63"),
    ("kappa-r", 3, "kappa", "2.39"),
    ("kappa-r", 3, "kappa_r", "1.69"),
    ("kappa-r", 4, "kappa", "2.03"),
    ("kappa-r", 4, "kappa_r", "1.71"),
    ("counting", 1, "relative_area_counted", "0.0605"),
    ("counting", 1, "relative_area", "0.0555"),
    ("counting", 1, "patches", "14"),
    ("counting", 2, "relative_area_counted", "0.0579"),
    ("counting", 2, "relative_area", "0.0563"),
    ("counting", 3, "relative_area_counted", "0.0565"),
    ("counting", 3, "relative_area", "0.0563"),
    ("counting", 4, "relative_area_counted", "0.0234"),
    ("counting", 4, "relative_area", "0.0197"),
    ("counting", 4, "kappa_r_counted", "2.67"),
    ("counting", 5, "relative_area_counted", "0.0203"),
    ("counting", 5, "relative_area", "0.0201"),
    ("counting", 5, "kappa_r", "1.72"),
    ("coating", 3, "relative_area", "0.051"),
    ("coating", 4, "kappa_r", "0.13"),
    ("coating", 5, "patches", "8"),
    ("yield", 3, "relative_area", "0.146"),
    ("yield", 4, "patches", "23"),
    ("yield", 5, "relative_area", "0.134"),
    ("yield", 6, "relative_area", "0.260"),
    ("dent", 2, "relative_area", "0.149"),
    ("dent", 2, "contact_pressure_over_yield", "1.93"),
    ("dent", 4, "contact_pressure_over_yield", "2.52"),
    ("dent", 6, "contact_pressure_over_yield", "2.10"),
    ("dent", 6, "relative_area", "0.239"),
    ("crawl", 1, "relative_area", "0.1522"),
    ("crawl", 3, "relative_area", "0.1522"),
    ("crawl", 4, "relative_area", "0.1522"),
    ("grip", 2, "relative_area", "0.245"),
    ("grip", 5, "friction", "0.0737"),
    ("grip", 6, "friction", "0.0500"),
    ("grip", 7, "friction", "0.0183"),
    ("grip", 7, "relative_area", "0.686"),
    ("gecko", 1, "relative_area", "0.330"),
    ("gecko", 2, "relative_area", "0.239"),
    ("gecko", 4, "relative_area", "0.088"),
    ("gecko", 7, "relative_area", "0.043"),
    ("seal", 1, "relative_area", "0.110"),
    ("seal", 3, "relative_area", "0.378"),
];

#[test]
fn what_lessons_tell_is_what_the_program_gives() {
    for (lesson, step, of, told) in TOLD {
        let digits = told.split_once('.').map_or(0, |(_, digits)| digits.len());
        assert_eq!(format!("{:.digits$}", number(lesson, step, of)), told, "{lesson}, step {step}: {of}");
        let step = if lesson == "crawl" { 4 } else { step };
        let texts = ["en", "de"].map(|language| texts(&LESSONS[lesson][step - 1].step, language));
        assert!(texts[0].contains(told), "{lesson}, step {step}: {told} is not in {}", texts[0]);
        assert!(texts[1].contains(&told.replace('.', ",")), "{lesson}, step {step}: {told} is not in {}", texts[1]);
    }
}

fn near(value: f64, told: f64, within: f64, what: &str) {
    assert!((value - told).abs() <= within, "{what} is {value}, not {told} within {within}");
}

#[test]
fn hertz_and_rough_contact_grow_as_told() {
    let ratio = |of: &str, a: usize, b: usize| number("hertz-and-rough", a, of) / number("hertz-and-rough", b, of);
    near(ratio("relative_area", 2, 1), 3.15, 5e-3, "the width of the cylinder's contact");
    near(ratio("kappa", 2, 1), 1.0 / 3.0, 0.02, "kappa of the cylinder");
    near(number("hertz-and-rough", 1, "kappa_r"), 1.47, 5e-3, "kappa_r of the cylinder");
    near(number("hertz-and-rough", 3, "patches"), 9.0, 0.0, "patches");
    near(ratio("relative_area", 4, 3), 7.0, 0.1, "the rough area");
    near(ratio("kappa", 4, 3), 0.70, 5e-3, "kappa of the rough line");
    near(ratio("kappa_r", 4, 3), 1.07, 5e-3, "kappa_r of the rough line");
    let sweep = &LESSONS["hertz-and-rough"][4].sweep;
    let at = |load: f64, of: &str| {
        let is_beyond = |point: &&Value| point["reduced_pressure"].as_f64().unwrap() > load;
        sweep.iter().find(is_beyond).unwrap()[of].as_f64().unwrap()
    };
    near(at(0.26, "relative_area"), 0.485, 5e-3, "the area a little below p* = 0.27");
    near(at(0.26, "patches"), 41.0, 1.0, "patches of half the area");
    near(at(0.56, "patches"), 30.0, 0.0, "patches at p* = 0.56");
    let flatter = number("kappa-r", 1, "kappa_r") / number("kappa-r", 1, "kappa");
    near(flatter, 0.64, 5e-3, "the gradient of what touches");
}

#[test]
fn kappa_r_keeps_its_level_in_the_sweep() {
    let sweep = &LESSONS["kappa-r"][4].sweep;
    let at = |load: f64, of: &str| {
        let is_at = |point: &&Value| (point["reduced_pressure"].as_f64().unwrap() / load - 1.0).abs() < 1e-6;
        sweep.iter().find(is_at).unwrap()[of].as_f64().unwrap()
    };
    for point in sweep.iter().filter(|it| (0.00099..=0.1001).contains(&it["reduced_pressure"].as_f64().unwrap())) {
        near(point["kappa_r"].as_f64().unwrap(), 1.7, 0.1, "kappa_r");
    }
    near(at(1e-3, "kappa"), 3.4, 0.05, "kappa at the small load");
    near(at(0.1, "kappa"), 2.0, 0.05, "kappa at the large load");
    for of in ["kappa", "kappa_r"] {
        near(at(1.0, of), 0.96, 5e-3, of);
    }
}

#[test]
fn counting_is_off_as_told() {
    let (counted, right) = ("relative_area_counted", "relative_area");
    let off = |step: usize, fine: usize| number("counting", step, counted) / number("counting", fine, right) - 1.0;
    near(off(1, 3), 0.08, 5e-3, "counting on the coarse grid");
    near(off(3, 3), 0.004, 5e-4, "counting on the fine grid");
    near(off(4, 5), 0.17, 5e-3, "counting at the small load");
    near(number("counting", 2, right) / number("counting", 3, right), 1.0, 1e-3, "the resolved area");
    let excess = (number("counting", 1, counted) - number("counting", 1, right)) * 1024.0 / 14.0;
    near(excess, 0.38, 0.02, "spacings too much for each patch");
}

#[test]
fn coatings_are_stiffer_as_told() {
    let half_space = |of: &str| number("hertz-and-rough", 2, of);
    let (area, highest) = ("relative_area", "max_pressure_over_modulus");
    near(number("coating", 1, area) / half_space(area), 0.998, 5e-4, "the area on a thick layer");
    near(number("coating", 2, area), 0.098, 5e-4, "the area on the layer");
    near(number("coating", 2, highest) / half_space(highest), 1.28, 5e-3, "the largest pressure on the layer");
    near(number("coating", 4, area) / number("coating", 3, area), 2.0, 0.05, "the width on a coating");
    near(number("coating", 5, area), 0.068, 5e-4, "the rough area on a coating");
    let page = Page::open();
    near(
        turned_in("coating", &page, 6, &json!({"layer": 0.03}), area),
        0.109,
        5e-4,
        "the rough area on a thicker layer",
    );
    near(number("yield", 4, area), 0.119, 5e-4, "the rough area on a half-space");
}

#[test]
fn metals_yield_as_told() {
    let (area, highest) = ("relative_area", "max_pressure_over_modulus");
    near(number("yield", 1, highest), 3.04e-4, 5e-7, "the largest elastic pressure");
    near(number("yield", 2, highest), number("yield", 1, highest), 1e-12, "the pressure below the hardness");
    near(number("yield", 3, highest), 2e-4, 1e-12, "the pressure at the hardness");
    near(number("yield", 3, area) / number("yield", 1, area), 1.21, 5e-3, "the area of the softer metal");
    near(number("yield", 4, highest), 1.28e-3, 5e-6, "the largest pressure of the rough line");
    near(number("yield", 5, area) / number("yield", 4, area), 1.12, 5e-3, "the area of the rough metal");
    near(5e-5 / number("yield", 5, area) / 5e-4, 0.75, 5e-3, "the mean pressure in contact over the hardness");
}

#[test]
fn dents_begin_below_as_told() {
    let page = Page::open();
    let dent = |step: usize, of: &str| number("dent", step, of);
    let (area, imprint, depth) = ("relative_area", "imprint_depth", "deepest_yield");
    let elastic = turned_in("dent", &page, 1, &json!({"yield-stress": 0}), "max_pressure_over_modulus");
    near(elastic, 3.04e-4, 5e-7, "the largest elastic pressure");
    let elastic = turned_in("dent", &page, 1, &json!({"yield-stress": 0}), area);
    near(elastic, 0.121, 5e-4, "the elastic area");
    near(dent(2, area) / elastic, 1.25, 0.02, "the area of the softer metal");
    near(dent(2, depth), 25.7e-6, 5e-8, "how deep it yields");
    assert!(dent(1, depth) < dent(2, depth) && dent(1, imprint) < dent(2, imprint));
    near(dent(3, imprint), 2.07e-9, 5e-12, "the imprint");
    near(dent(3, imprint) / dent(2, imprint), 1.0, 1e-9, "the imprint without the load");
    near(dent(3, area), 0.0, 0.0, "the area without the load");
    near(dent(5, imprint), 6.01e-9, 5e-12, "the imprint of the metal that hardens");
    near(dent(4, imprint), 8.36e-9, 5e-12, "the imprint of the one that hardly does");
    near(dent(5, imprint) / dent(4, imprint), 0.72, 0.01, "about a quarter less");
    assert!(dent(5, "max_plastic_strain") < 1e-3 && 0.1 * dent(5, "max_plastic_strain") < 5e-5, "less than Y");
    let capped = json!({"yield-stress": 0, "hardness": 2.8e-4});
    near(turned_in("dent", &page, 6, &capped, area), 0.203, 5e-4, "the area by a hardness");
    let found = turned_in("dent", &page, 4, &json!({"yield-stress": 6e-5}), area);
    assert!((0.19..=0.21).contains(&found), "the challenge can be done: {found}");
}

/// The number `of` of a step of the lesson on rubber with other knobs.
fn turned(page: &Page, step: usize, changes: &Value, of: &str) -> f64 {
    turned_in("grip", page, step, changes, of)
}

/// The number `of` of a step of a lesson with other knobs.
fn turned_in(lesson: &str, page: &Page, step: usize, changes: &Value, of: &str) -> f64 {
    let mut knobs = LESSONS[lesson][step - 1].step["knobs"].clone();
    changes.as_object().unwrap().iter().for_each(|(name, value)| knobs[name] = value.clone());
    page.solve(&knobs)["numbers"][of].as_f64().unwrap()
}

#[test]
fn rubber_grips_as_told() {
    let page = Page::open();
    let (friction, area) = ("friction", "relative_area");
    let grip = |step: usize, of: &str| number("grip", step, of);
    let at = |step: usize, speed: f64, of: &str| turned(&page, step, &json!({"speed": speed}), of);
    near(grip(1, area), 1.0, 0.0, "the area of the slow wave");
    near(grip(1, friction), 1.26e-4, 5e-7, "the friction of the slow wave");
    near(grip(2, friction), 3.13e-5, 5e-8, "the friction of the fast wave");
    near(turned(&page, 2, &json!({"creep": 0}), area), 0.245, 5e-4, "the area of the elastic solid");
    near(grip(3, friction), 3.65e-3, 5e-6, "the friction of the wave between");
    near(grip(3, friction) / grip(1, friction), 29.0, 0.5, "the wave between over the slow wave");
    // one wave in full contact: the largest friction is where 2 pi V = 1 + f
    let best = at(4, 10.0 / std::f64::consts::TAU, friction);
    near(best, 1.25e-3, 5e-6, "the largest friction of one wave");
    for (speed, share) in [(0.159, 0.2), (15.9, 0.2), (1.5, 1.0), (1.7, 1.0)] {
        let its = at(4, speed, friction) / best;
        near(its, share, 5e-3, "the share at another speed");
        assert!(its < 1.0, "{its} at {speed}");
    }
    for speed in [1e-4, 100.0] {
        near(at(4, speed, area), 1.0, 0.0, "the area under the large load");
    }
    let half = 2.0 + 3f64.sqrt();
    near(half * half, 14.0, 0.1, "the width of the maximum of one wave");
    near(at(4, 1.5915 * half, friction) / best, 0.5, 1e-3, "the friction at its end");
    let [slow, fast] = [0.0025, 0.126].map(|speed| at(5, speed, friction) / grip(5, friction));
    assert!((0.5..0.55).contains(&slow) && (0.5..0.52).contains(&fast), "{slow} {fast}");
    near(0.126 / 0.0025, 50.0, 0.5, "the width of the maximum of the rough line");
    near(at(5, 0.02, "rms_gradient"), 0.1, 1e-9, "the slope");
    let [less, more] = [0.01, 0.022].map(|speed| at(5, speed, friction));
    assert!(less < grip(5, friction) && more < 1.01 * grip(5, friction), "{less} {more}");
    near(turned(&page, 5, &json!({"roughness": 0.01}), friction) / grip(5, friction), 0.1, 1e-6, "gentle slopes");
    near(grip(6, area), 0.65, 5e-3, "the area under the larger load");
    near(grip(6, friction) / grip(5, friction), 2.0 / 3.0, 0.02, "friction under the larger load");
    near(turned(&page, 6, &json!({"load": 0.01}), friction), 0.0578, 5e-5, "friction under a small load");
    let [full, fuller] = [1.0, 2.0].map(|load| load * turned(&page, 6, &json!({"load": load}), friction));
    near(fuller / full, 1.0, 1e-6, "the friction force in full contact");
    near(grip(5, area), 0.2197, 5e-5, "the area at the best speed");
    near(grip(7, area) / grip(5, area), 3.1, 0.05, "the area of slow sliding");
    near(grip(7, friction) / grip(5, friction), 0.25, 5e-3, "friction of slow sliding");
    let areas = [1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0].map(|speed| at(7, speed, area));
    assert!(areas.is_sorted_by(|a, b| a > b), "{areas:?}");
    near(areas[0], 0.724, 5e-4, "the area of the slowest sliding");
    near(areas[6], 0.123, 5e-4, "the area of the fastest sliding");
    let [area, friction] = [area, friction].map(|of| at(7, 0.0316, of));
    assert!(area < 0.2 && friction > 0.065, "the challenge can be done: {area} {friction}");
}

/// Work is told to the step, but may differ by some where processors round otherwise.
/// Pulls, as `p*`, between which a step of the lesson on geckos lets go, with other knobs.
fn lets_go(page: &Page, step: usize, changes: Value, [holds, parts]: [f64; 2]) {
    let area = |pull: f64| {
        let mut changes = changes.clone();
        changes["pull"] = json!(pull);
        turned_in("gecko", page, step, &changes, "relative_area")
    };
    assert!(area(holds) > 0.0 && area(parts) == 0.0, "step {step}, {changes}: not between {holds} and {parts}");
}

#[test]
fn geckos_stick_as_told() {
    let page = Page::open();
    let area = "relative_area";
    let its = |step: usize, of: &str| number("gecko", step, of);
    let plain = turned_in("gecko", &page, 1, &json!({"adhesion": 0}), area);
    near(plain, 0.0239, 5e-5, "the area without adhesion");
    near(its(1, area) / plain, 14.0, 0.5, "the area with adhesion over that");
    near(its(2, "reduced_pressure"), -0.05, 1e-9, "the pull");
    lets_go(&page, 2, json!({}), [0.0824, 0.0826]);
    near(its(3, area), its(1, area), 0.0, "the wave under the hand");
    let height = its(3, "mean_gap") / its(3, "mean_gap_over_rms_height");
    let under_the_hand = |gap: f64, goes_on: bool| {
        let knobs = &LESSONS["gecko"][2].step["knobs"];
        let order = json!({"knobs": knobs, "mean-gap": gap * height, "is-deep": false, "goes-on": goes_on});
        page.post("/api/hold", &order.to_string()).json()["numbers"][area].as_f64().unwrap()
    };
    let up = [(2.0, false), (2.04, true), (2.06, true)].map(|(gap, goes_on)| under_the_hand(gap, goes_on) > 0.0);
    let down = [1.86, 1.83].map(|gap| under_the_hand(gap, true) > 0.0);
    assert_eq!((up, down), ([true, true, false], [false, true]), "where the wave lets go and snaps in");
    lets_go(&page, 4, json!({}), [0.0595, 0.0597]);
    // the same pressure on other slopes
    let pull =
        |step: usize| LESSONS["gecko"][step - 1].step["knobs"]["pull"].as_f64().unwrap() * its(step, "rms_gradient");
    near(pull(5) / pull(2), 1.0, 1e-3, "the pull on the rough wave");
    near(its(5, area), 0.0, 0.0, "the area of the rough wave that lets go");
    near(turned_in("gecko", &page, 5, &json!({"pull": 0}), area), 0.006, 5e-4, "the area of the rough wave");
    lets_go(&page, 5, json!({}), [0.000235, 0.000237]);
    let slopes = [2, 5].map(|step| its(step, "rms_gradient"));
    near(
        0.0825 * slopes[0] / (0.000236 * slopes[1]),
        16.0,
        0.6,
        "the pull-off of the smooth wave over that of the rough one",
    );
    lets_go(&page, 6, json!({"adhesion": 3e-6}), [0.002795, 0.002805]);
    near(its(7, area) / 0.006, 7.0, 0.3, "the area on the softer solid over that on the stiff one");
    lets_go(&page, 7, json!({}), [0.00855, 0.00865]);
    near(0.0086 / 0.000236, 36.0, 0.5, "the pull-off on the softer solid over that on the stiff one");
}

#[test]
fn solvers_work_as_told() {
    let said: String = LESSONS["crawl"].iter().map(|played| texts(&played.step, "en")).collect();
    for (step, of, told) in [
        (1, "iterations", 929.0),
        (1, "transforms", 2218.0),
        (2, "iterations", 228.0),
        (2, "transforms", 1138.0),
        (3, "iterations", 163.0),
        (3, "transforms", 438.0),
        (4, "transforms", 90.0),
        (5, "transforms", 75.0),
    ] {
        near(number("crawl", step, of) / told, 1.0, 0.05, &format!("{of} in step {step}, over what is told,"));
        assert!(said.contains(&told.to_string()), "{told} is not in {said}");
    }
    let page = Page::open();
    let turned = |step: usize, points: usize, of: &str| turned_in("crawl", &page, step, &json!({"points": points}), of);
    near(turned(1, 1024, "iterations"), 461.0, 23.0, "steps on fewer points");
    near(turned(3, 16384, "iterations"), 242.0, 12.0, "steps of conjugate gradients on more points");
    near(turned(3, 16384, "transforms"), 658.0, 33.0, "their transforms");
}

#[test]
fn honed_walls_carry_as_told() {
    let (area, highest, gap) = ("relative_area", "max_pressure_over_modulus", "mean_gap_over_rms_height");
    let its = |step: usize, of: &str| number("honing", step, of);
    let page = Page::open();
    let plain = |changes: Value, of: &str| turned_in("honing", &page, 1, &changes, of);
    near(its(2, area) / its(1, area), 2.3, 0.05, "the honed area over the other one");
    near(its(1, "kappa"), 2.20, 6e-3, "kappa before honing");
    near(its(2, "kappa"), 5.04, 6e-3, "kappa of the honed wall");
    near(its(1, "kappa_r"), 1.83, 6e-3, "kappa_r before honing");
    near(its(2, "kappa_r"), 1.61, 6e-3, "kappa_r of the honed wall");
    near(its(1, highest), 1.57e-3, 5e-6, "the largest pressure before honing");
    near(its(3, highest), 7.66e-4, 5e-7, "the largest pressure on the honed wall");
    near(its(2, gap), 0.648, 6e-4, "the gap of the honed wall");
    near(its(4, gap), 0.350, 6e-4, "its gap under the large load");
    near(its(4, gap) / its(2, gap), 0.54, 5e-3, "what it keeps");
    near(plain(json!({"load": 0.2}), gap) / its(1, gap), 0.35, 5e-3, "what the other one keeps");
    near(its(5, highest), 6.1e-3, 5e-5, "the largest pressure of sharp peaks");
    near(its(5, highest) / its(1, highest), 3.9, 0.05, "that over the other one");
    near(turned_in("honing", &page, 5, &json!({"skewness": -0.75}), area), 0.15, 0.01, "the challenge");
}

#[test]
fn joints_fret_as_told() {
    let its = |step: usize, of: &str| number("fretting", step, of);
    near(its(2, "stick_share"), 0.1f64.powf(2.0 / 3.0), 0.01, "Mindlin's share");
    let lost = |step: usize| its(step, "dissipated") / its(3, "dissipated");
    near(lost(4), 0.1, 5e-3, "the energy of half the pull");
    near(lost(5), 1.0 / 3.0, 0.03, "the energy under the tighter bolt");
    near(its(5, "mean_traction") / its(3, "mean_traction"), 1.0, 1e-6, "its pull");
    let page = Page::open();
    near(turned_in("fretting", &page, 6, &json!({"sideways": 0.25}), "stick_share"), 0.755, 0.025, "the challenge");
    // what sticks is what would touch under half of the load
    let lighter = turned_in("fretting", &page, 6, &json!({"sideways": 0, "load": 0.025}), "relative_area_counted");
    near(its(6, "stick_share") * its(6, "relative_area_counted") / lighter, 1.0, 0.01, "the share that sticks");
}

#[test]
fn contacts_conduct_as_told() {
    let its = |step: usize, of: &str| number("conductance", step, of);
    let conducts = |step: usize| its(step, "conductance");
    near(its(1, "relative_area"), 0.003, 5e-4, "the area of the ball");
    near(conducts(1), 0.138, 5e-4, "its conductance");
    // Holm's spot, and its neighbours
    let holm = 4.0 * (its(1, "relative_area") / std::f64::consts::PI).sqrt();
    assert!((1.0..1.15).contains(&(conducts(1) / holm)), "{} over that of Holm", conducts(1) / holm);
    near(its(2, "relative_area") / its(1, "relative_area"), 4.0, 0.05, "the area under the larger load");
    near(conducts(2) / conducts(1), 2.2, 0.05, "the conductance under the larger load");
    near(its(3, "relative_area"), 0.066, 5e-4, "the rough area");
    near(conducts(4) / conducts(3), 1.87, 5e-3, "the conductance under twice the load");
    near(its(5, "relative_area"), 0.055, 5e-4, "the area with finer waves");
    let page = Page::open();
    let turned = |step: usize, changes: &Value| {
        let mut knobs = LESSONS["conductance"][step - 1].step["knobs"].clone();
        changes.as_object().unwrap().iter().for_each(|(name, value)| knobs[name] = value.clone());
        let run = page.solve(&knobs);
        let found = page.get(&format!("/api/run/{}/conductance", run["id"].as_str().unwrap())).json();
        [run["numbers"]["relative_area"].as_f64().unwrap(), found.as_f64().unwrap()]
    };
    let ball = turned(1, &json!({"load": 0.01}));
    near(ball[0], 0.066, 5e-4, "the area of the ball that is pressed harder");
    near(ball[1], 0.90, 5e-3, "its conductance");
    near(conducts(3) / ball[1], 10.0, 0.3, "the rough conductance over that");
    let smoother = turned(5, &json!({"roughness": 0.001, "cutoff": 8, "load": 0.05}));
    near(smoother[0], 0.111, 5e-4, "the area of the smoother surface");
    near(smoother[1], 5.27, 5e-3, "its conductance");
    near(conducts(5) / smoother[1], 0.93, 5e-3, "the conductance with finer waves over that");
    let more = turned(5, &json!({"rolloff": 12}));
    assert!(more[0] < 0.07 && more[1] > 10.0, "the challenge: {more:?}");
}

/// The surface of the lesson on seals, under a load, solved without the page.
fn pressed_seal(peklenik: f64, reduced_pressure: f64) -> Contact {
    let spectrum = Spectrum { hurst: 0.8, rolloff_wavelength: 20e-6, short_cutoff: 5e-6, rms_gradient: 1e-3 };
    let roughness = RandomRoughness { lay: Lay { peklenik, angle: 0.0 }, ..spectrum.into() };
    let surface = roughness.surface(Grid::surface([256; 2], [160e-6; 2]).unwrap(), 1).unwrap();
    let problem = Problem::new(surface, ContactModulus(1e9), Load::ReducedPressure(reduced_pressure)).unwrap();
    Multilevel.solve(&problem, &Stop::default(), &mut ()).unwrap().converged().unwrap()
}

#[test]
fn seals_leak_as_told() {
    let loads = [0.05, 0.1, 0.2, 0.25];
    let contacts = loads.map(|load| pressed_seal(1.0, load));
    for (contact, step) in contacts.iter().zip(1..) {
        let its = number("seal", step, "relative_area");
        near(contact.resolved().relative_area, its, 1e-6, "the area without the page");
    }
    let [first, second, third, fourth] =
        contacts.each_ref().map(|it| Leakage::from_contact(it, FlowAxis::X, 1e-4).unwrap().sigma());
    let gaps = contacts.each_ref().map(|it| it.mean_gap());
    near(first.cbrt() / gaps[0], 0.75, 0.02, "the gap of smooth plates over the mean gap");
    near(first / second, 7.0, 0.4, "the leak over that under twice the load");
    near(first / third, 660.0, 5.0, "the leak over that under four times the load");
    near(fourth / first, 1e-6, 5e-8, "what is left of the leak");
    near(gaps[1] / gaps[0], 2.0 / 3.0, 0.02, "the mean gap under twice the load");
    near(gaps[3] / gaps[0], 0.25, 0.02, "the mean gap in the end");
    // the pressure falls at one place: few nodes have one that is not nearly that of either side
    let pressure = Leakage::from_contact(&contacts[3], FlowAxis::X, 1e-4).unwrap().pressure;
    let between = pressure.iter().filter(|it| (0.1..0.9).contains(*it)).count() as f64;
    let open = pressure.iter().filter(|it| it.is_finite()).count() as f64;
    assert!(between / open < 0.1, "{between} of {open} nodes have a pressure between 0.1 and 0.9");

    let seals = |contact: &Contact, axis| {
        let found =
            PercolationLoad::new(&contact.problem, &Multilevel, &Stop::default(), axis, 1e-3, |_| ()).unwrap().sealed;
        [found.reduced_pressure, found.relative_area]
    };
    let [load, area] = seals(&contacts[0], FlowAxis::X);
    near(load, 0.256, 5e-4, "the load that seals");
    near(area, 0.461, 5e-4, "the area that seals");
    let grooves = pressed_seal(4.0, 0.2);
    let its = number("seal", 6, "relative_area");
    near(grooves.resolved().relative_area, its, 1e-6, "the area of grooves without the page");
    let [across, along] = [seals(&grooves, FlowAxis::Y), seals(&grooves, FlowAxis::X)];
    near(across[0], 0.159, 5e-4, "the load that seals across the grooves");
    near(across[1], 0.331, 5e-4, "the area that seals across the grooves");
    near(along[0], 0.253, 5e-4, "the load that seals along the grooves");
}

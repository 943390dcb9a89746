//! Lessons of a teacher: what can be written, and what is refused.

use asperity::explore::{Lesson, Question, SweepCurve, TopMap, Words};
use serde_json::{Value, json};
use std::path::Path;

/// A lesson in a folder of its own.
fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("lesson.toml"), text).unwrap();
    folder
}

/// The one lesson that a text holds.
fn lesson(text: &str) -> Lesson {
    let lessons = Lesson::folder(folder(text).path()).unwrap();
    <[Lesson; 1]>::try_from(lessons).unwrap()[0].clone()
}

fn json_of(value: &impl serde::Serialize) -> Value {
    serde_json::to_value(value).unwrap()
}

const STEP: &str = "title = \"T\"\n\n[[step]]\ntext = \"Look.\"\n";

#[test]
fn a_teacher_writes_lessons() {
    let lesson = lesson(
        r#"
        title = "Mine"
        knobs = { domain = "surface", points = 64, cutoff = 16 }
        [[step]]
        text = "First."
        ask = { kind = "number", question = "How much?", of = "kappa_r" }
        [[step]]
        text = "Then."
        knobs.load = 0.5
        sweep = true
        ask = { kind = "draw", question = "Draw it.", curve = "kappa-r" }
    "#,
    );
    assert_eq!((lesson.name.as_str(), &lesson.title, lesson.steps.len()), ("lesson", &"Mine".into(), 2));
    let [first, second] = [0, 1].map(|i| json_of(&lesson.steps[i].knobs));
    assert_eq!((first["points"].as_u64(), first["load"].as_f64()), (Some(64), Some(0.05)));
    assert_eq!((second["points"].as_u64(), second["load"].as_f64()), (Some(64), Some(0.5)));
    let asked = Question::Draw { question: "Draw it.".into(), curve: SweepCurve::KappaR };
    assert_eq!((lesson.steps[1].sweep, &lesson.steps[1].ask), (true, &Some(asked)));
}

/// Lessons that were written when the resolved values had names of their own.
#[test]
fn lessons_with_the_earlier_names_of_resolved_values_still_read() {
    let lesson = lesson(
        r#"
        title = "Old"
        [[step]]
        text = "First."
        ask = { kind = "number", question = "How much?", of = "kappa_r_resolved" }
        [[step]]
        text = "Then."
        ask = { kind = "act", question = "Press.", goal = { relative_area_resolved = [0.2, 0.3] } }
    "#,
    );
    let [first, second] = [0, 1].map(|i| json_of(&lesson.steps[i].ask));
    assert_eq!((&first["of"], &second["goal"]), (&json!("kappa_r"), &json!({"relative_area": [0.2, 0.3]})));
}

#[test]
fn texts_are_in_one_language_or_in_some() {
    let lesson = lesson(
        "title = { en = \"T\", de = \"U\" }\n[[step]]\ntext = { fr = \"Voyez.\" }\n\
         ask = { kind = \"choose\", question = \"?\", choices = [\"a\", { text = { en = \"b\", de = \"c\" }, because = { en = \"d\" } }], right = 1 }\n",
    );
    assert_eq!(json_of(&lesson.title), json!({"en": "T", "de": "U"}));
    let step = json_of(&lesson.steps[0]);
    assert_eq!(
        (&step["text"], &step["ask"]["choices"]),
        (
            &json!({"fr": "Voyez."}),
            &json!([{"text": "a", "because": null}, {"text": {"en": "b", "de": "c"}, "because": {"en": "d"}}])
        )
    );
    assert!(matches!(lesson.title, Words::Each(texts) if texts["de"] == "U"));
}

/// A class may turn to every choice of values, and the values of a step take the place of those of the lesson.
#[test]
fn what_may_be_turned_makes_all_states() {
    let lesson = lesson(
        "title = \"T\"\nturn = { load = [0.1, 0.2], hurst = [0.5, 0.8] }\n\
         [[step]]\nknobs.load = 0.3\ntext = \"A.\"\n\
         [[step]]\nknobs.load = 0.2\ntext = \"B.\"\nturn = { hurst = [0.8], solver = [{ method = \"polonsky-keer\" }] }\n",
    );
    let states = |step: usize| -> Vec<(Value, Value, Value)> {
        let states = lesson.steps[step].states();
        let of = |knobs: Value| (knobs["load"].clone(), knobs["hurst"].clone(), knobs["solver"]["method"].clone());
        states.iter().map(|knobs| of(json_of(knobs))).collect()
    };
    let (first, second) = (states(0), states(1));
    assert_eq!((first.len(), second.len()), (6, 4), "{first:?} {second:?}");
    assert_eq!(first[0], (json!(0.3), json!(0.8), json!("multilevel")), "its own state comes first");
    for load in [0.1, 0.2, 0.3] {
        for hurst in [0.5, 0.8] {
            assert!(first.contains(&(json!(load), json!(hurst), json!("multilevel"))), "{load} {hurst}");
        }
        let gradients = (json!(load), json!(0.8), json!("polonsky-keer"));
        assert_eq!(second.contains(&gradients), load < 0.3, "{load}");
    }
    for lesson in Lesson::all() {
        for step in &lesson.steps {
            let states = step.states();
            assert!(states[0] == step.knobs && states.len() <= 64, "{}: {}", lesson.name, states.len());
        }
    }
}

#[test]
fn the_example_of_the_readme_is_a_lesson() {
    let readme = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/lessons/README.md"));
    let example = readme.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let lesson = lesson(example);
    assert_eq!(lesson.steps.len(), 5);
    assert_eq!(lesson.steps[0].states().len(), 3);
    let kinds: Vec<_> = lesson.steps.iter().map(|step| json_of(step)["ask"]["kind"].clone()).collect();
    assert_eq!(kinds, [Value::Null, json!("choose"), json!("number"), json!("draw"), json!("act")]);
    for key in json_of(&lesson.steps[0].knobs).as_object().unwrap().keys() {
        let is_known = readme.contains(&format!("`{key}`")) || ["theme", "heights"].contains(&key.as_str());
        assert!(is_known, "the knob {key} is not explained");
    }
}

/// A map for all steps, another one for one of them, and none for a line. Comments may hold any address.
#[test]
fn steps_show_maps_and_solutions() {
    let lesson = lesson(
        "# as in [a book](https://example.org)\ntitle = \"T\"\nshow = \"gap\"\nknobs = { domain = \"surface\", points = 64, cutoff = 16 }\n\
         [[step]]\ntext = \"[A](map.gap).\"\n\
         [[step]]\ntext = \"B.\"\nshow = \"solid\"\nsolution.load = 0.2\nask = { kind = \"act\", question = \"?\", goal = { patches = [1, 9] } }\n\
         [[step]]\ntext = \"C.\"\nknobs.domain = \"line\"\n",
    );
    let shown: Vec<_> = lesson.steps.iter().map(|step| step.show).collect();
    assert_eq!(shown, [Some(TopMap::Gap), Some(TopMap::Solid), None]);
    let solved = lesson.steps[1].solution.clone().unwrap();
    assert_eq!(json_of(&solved)["load"], json!(0.2));
    assert!(lesson.steps[1].states().contains(&solved) && lesson.steps[0].solution.is_none());
}

#[test]
fn lessons_that_cannot_be_say_where() {
    let refused = |text: &str| Lesson::folder(folder(text).path()).unwrap_err().to_string();
    let ask = |question: &str| format!("{STEP}ask = {question}\n");
    let loads = |count: usize| (0..count).map(|i| format!("0.0{}", i + 10)).collect::<Vec<_>>().join(", ");
    for (text, line, words) in [
        ("title = ".to_owned(), 1, ""),
        ("title = \"T\"\nstep = []\n".into(), 1, "the lesson has no steps"),
        (STEP.replace("\"T\"", "\" \""), 1, "title: a text is empty"),
        (STEP.replace("\"T\"", "3"), 1, "give a text, or texts by language"),
        (STEP.replace("\"Look.\"", "{ english = \"Look.\" }"), 3, "\"english\" is not a language: give two letters"),
        (STEP.replace("\"Look.\"", "{}"), 3, "a text is empty"),
        (format!("{STEP}colour = 3\n"), 5, "unknown field `colour`"),
        (format!("{STEP}\n[[step]]\nknobs.load = 0.1\n"), 6, "missing field `text`"),
        (format!("{STEP}knobs.load = \"much\"\n"), 5, "`load` cannot be \"much\": give a number"),
        (
            format!("{STEP}knobs.points = 512\nknobs.roughness = -1\n"),
            6,
            "`roughness` cannot be -1: give a number from 0 to 1",
        ),
        (format!("{STEP}knobs.seed = -3\n"), 5, "`seed` cannot be -3: give a whole number from 0 to 4294967295"),
        (format!("{STEP}knobs.loads = 0.1\n"), 5, "there is no `loads` here: choose one of `domain`, "),
        (format!("{STEP}knobs.load = 1e9\n"), 5, "`load` cannot be 1000000000: give a number from 1e-5 to 1000"),
        (
            format!("{STEP}knobs.points = 1048576\n"),
            5,
            "`points` cannot be 1048576: give a whole number from 4 to 262144",
        ),
        (format!("{STEP}turn.load = [0.1, 1e9]\n"), 5, "turn: `load` cannot be 1000000000: give"),
        (format!("{STEP}turn.loads = [0.1]\n"), 5, "turn: there is no `loads` here"),
        (format!("{STEP}turn.load = 0.1\n"), 5, "invalid type"),
        (
            format!("{STEP}turn = {{ load = [{0}], hurst = [{0}] }}\n", loads(8)),
            5,
            "turn: the values give more than 64 states",
        ),
        (ask("{ kind = \"guess\", question = \"?\" }"), 5, "unknown variant `guess`"),
        (
            ask("{ kind = \"choose\", question = \"?\", choices = [\"a\"], right = 1 }"),
            5,
            "1 choices are given: give two",
        ),
        (
            ask("{ kind = \"choose\", question = \"?\", choices = [\"a\", \"b\"], right = 3 }"),
            5,
            "choice 3 is marked as right",
        ),
        (ask("{ kind = \"choose\", question = \"\", choices = [\"a\", \"b\"], right = 1 }"), 5, "a text is empty"),
        (ask("{ kind = \"number\", question = \"?\", of = \"kappa_q\" }"), 5, "\"kappa_q\" is not a number of a run"),
        (
            ask("{ kind = \"draw\", question = \"?\", curve = \"kappa\" }"),
            5,
            "needs a sweep of the load: give sweep = true",
        ),
        (
            ask(
                "{ kind = \"choose\", question = \"?\", choices = [\"a\", { text = \"b\", because = \"\" }], right = 1 }",
            ),
            5,
            "a text is empty",
        ),
        (ask("{ kind = \"act\", question = \"?\", goal = {} }"), 5, "the goal is empty"),
        (ask("{ kind = \"act\", question = \"?\", goal = { area = [0, 1] } }"), 5, "\"area\" is not a number of a run"),
        (
            ask("{ kind = \"act\", question = \"?\", goal = { relative_area = [1, 0] } }"),
            5,
            "the goal of relative_area is from 1 to 0: give the smaller value first",
        ),
        (
            format!(
                "{STEP}sweep = true\nask = {{ kind = \"act\", question = \"?\", goal = {{ patches = [1, 1] }} }}\n"
            ),
            6,
            "a step with a goal cannot sweep the load",
        ),
        (format!("{STEP}[end]\nseen = \"\"\n"), 5, "end: a text is empty"),
        (
            STEP.replace("Look.", "Look at [it](number.kapa)."),
            4,
            "there is no \"number.kapa\" to point at: choose one of `section`, ",
        ),
        (
            format!("{STEP}[end]\nseen = \"[All](chart.kappa) of [it](control.weight).\"\n"),
            6,
            "`chart.kappa`, `map.pressure`, ",
        ),
        (
            STEP.replace("Look.", "Look at [it](nowhere)."),
            4,
            "or `number.` with the name of a number or `control.` with that of a knob",
        ),
        (format!("{STEP}show = \"gaps\"\n"), 5, "unknown variant `gaps`, expected one of `pressure`, `gap`, "),
        (format!("{STEP}show = \"gap\"\n"), 5, "a line has no map"),
        (format!("{STEP}solution.load = 0.1\n"), 5, "a solution is for a question of the kind \"act\""),
        (
            format!(
                "{STEP}solution.load = 1e9\nask = {{ kind = \"act\", question = \"?\", goal = {{ patches = [1, 1] }} }}\n"
            ),
            5,
            "`load` cannot be 1000000000: give a number from 1e-5 to 1000",
        ),
    ] {
        let said = refused(&text);
        assert!(said.contains(&format!("lesson.toml, line {line}: ")) && said.contains(words), "{text}: {said}");
        assert!(!said.contains('\n'), "{said}");
    }
    let none = tempfile::tempdir().unwrap();
    assert!(Lesson::folder(none.path()).unwrap_err().to_string().starts_with("no lessons are in "));
    assert!(Lesson::folder(Path::new("nowhere")).unwrap_err().to_string().starts_with("cannot read nowhere"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("/dev/zero", none.path().join("endless.toml")).unwrap();
        let endless = Lesson::folder(none.path()).unwrap_err().to_string();
        assert!(endless.contains("it is a directory or a device: give a file"), "{endless}");
    }
    let long = refused(&format!("{STEP}# {}", "x".repeat(1 << 18)));
    assert!(long.contains("more than a lesson may have: give at most 262144"), "{long}");
}

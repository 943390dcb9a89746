//! Lessons: those of the page, and those of a teacher.

use super::Page;
use asperity::explore::{Curve, Lesson, Question};
use std::path::Path;

/// A lesson in a folder of its own.
fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("lesson.toml"), text).unwrap();
    folder
}

const STEP: &str = "title = \"T\"\n\n[[step]]\ntext = \"Look.\"\n";

#[test]
fn the_page_has_lessons_that_ask() {
    let page = Page::open();
    let lessons = page.ask("GET", "/api/lessons", "", "").json();
    let lessons = lessons.as_array().unwrap();
    assert_eq!(lessons.len(), Lesson::all().len());
    for lesson in lessons {
        let steps = lesson["steps"].as_array().unwrap();
        assert!(steps.iter().any(|step| step["ask"]["question"].is_string()), "{} asks nothing", lesson["title"]);
        for step in steps {
            let answer =
                page.ask("POST", "/api/solve", "Content-Type: application/json\r\n", &step["knobs"].to_string());
            assert_eq!(answer.status, 200, "{}", answer.text());
        }
    }
    assert_eq!(page.ask("POST", "/api/lessons", "Content-Type: application/json\r\n", "{}").status, 405);
}

#[test]
fn a_teacher_writes_lessons() {
    let text = r#"
        title = "Mine"
        knobs = { domain = "surface", points = 64, cutoff = 16 }
        [[step]]
        text = "First."
        ask = { kind = "number", question = "How much?", of = "kappa_r_resolved" }
        [[step]]
        text = "Then."
        knobs.load = 0.5
        sweep = true
        ask = { kind = "draw", question = "Draw it.", curve = "kappa-r" }
    "#;
    let lessons = Lesson::folder(folder(text).path()).unwrap();
    let [lesson] = lessons.as_slice() else { panic!("{lessons:?}") };
    assert_eq!((lesson.title.as_str(), lesson.steps.len()), ("Mine", 2));
    let [first, second] = [0, 1].map(|i| serde_json::to_value(&lesson.steps[i].knobs).unwrap());
    assert_eq!((first["points"].as_u64(), first["load"].as_f64()), (Some(64), Some(0.05)));
    assert_eq!((second["points"].as_u64(), second["load"].as_f64()), (Some(64), Some(0.5)));
    let asked = Question::Draw { question: "Draw it.".into(), curve: Curve::KappaR };
    assert_eq!((lesson.steps[1].sweep, &lesson.steps[1].ask), (true, &Some(asked)));
}

#[test]
fn lessons_that_cannot_be_say_where() {
    let refused = |text: &str| Lesson::folder(folder(text).path()).unwrap_err().to_string();
    let ask = |question: &str| format!("{STEP}ask = {question}\n");
    for (text, line, words) in [
        ("title = ".to_owned(), 1, ""),
        ("title = \"T\"\nstep = []\n".into(), 1, "the lesson has no steps"),
        (format!("{STEP}colour = 3\n"), 5, "unknown field `colour`"),
        (format!("{STEP}\n[[step]]\nknobs.load = 0.1\n"), 6, "missing field `text`"),
        (format!("{STEP}knobs.load = \"much\"\n"), 3, "knobs: invalid type"),
        (format!("{STEP}knobs.loads = 0.1\n"), 3, "knobs: unknown field `loads`"),
        (format!("{STEP}knobs.load = 1e9\n"), 3, "the load p* is 1000000000.0: give"),
        (format!("{STEP}knobs.points = 1048576\n"), 3, "1048576 points are too many here"),
        (ask("{ kind = \"guess\", question = \"?\" }"), 5, "unknown variant `guess`"),
        (
            ask("{ kind = \"choose\", question = \"?\", choices = [\"a\"], right = 1 }"),
            3,
            "1 choices are given: give two",
        ),
        (
            ask("{ kind = \"choose\", question = \"?\", choices = [\"a\", \"b\"], right = 3 }"),
            3,
            "choice 3 is to be right",
        ),
        (ask("{ kind = \"number\", question = \"?\", of = \"kappa_q\" }"), 3, "\"kappa_q\" is no number of a run"),
        (
            ask("{ kind = \"draw\", question = \"?\", curve = \"kappa\" }"),
            3,
            "the load is not swept: give sweep = true",
        ),
    ] {
        let said = refused(&text);
        assert!(said.contains(&format!("lesson.toml, line {line}: ")) && said.contains(words), "{text}: {said}");
        assert!(!said.contains('\n'), "{said}");
    }
    let none = tempfile::tempdir().unwrap();
    assert!(Lesson::folder(none.path()).unwrap_err().to_string().starts_with("no lessons are in "));
    assert!(Lesson::folder(Path::new("nowhere")).unwrap_err().to_string().starts_with("cannot read nowhere"));
    let long = refused(&format!("{STEP}# {}", "x".repeat(1 << 18)));
    assert!(long.contains("more than a lesson may have: give at most 262144"), "{long}");
}

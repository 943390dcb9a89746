//! What all commands share: completions and a manual, how much is said, and how many threads are taken.

use super::*;

/// The names of all commands, as the help has them.
fn commands(folder: &Folder) -> Vec<String> {
    let help = folder.run("--help");
    let lines = text(&help.stdout).split_once("Commands:\n").unwrap().1.lines();
    let names = lines.take_while(|line| line.starts_with("  ")).filter(|line| !line.starts_with("   "));
    names.map(|line| line.split_whitespace().next().unwrap().to_owned()).filter(|name| name != "help").collect()
}

#[test]
fn every_shell_completes_every_command() {
    let folder = Folder::new();
    let commands = commands(&folder);
    assert!(commands.len() >= 8 && commands.iter().any(|name| name == "solve"), "{commands:?}");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let output = folder.run(&format!("completions {shell}"));
        let script = text(&output.stdout);
        assert!(output.status.success() && output.stderr.is_empty(), "{shell}");
        for name in &commands {
            assert!(script.contains(name.as_str()), "{shell} does not complete {name}");
        }
        assert!(script.contains("reduced-pressure"), "{shell}");
    }
    let other = folder.run("completions tcsh");
    assert_eq!(other.status.code(), Some(2));
}

#[test]
fn bash_understands_its_completions() {
    let folder = Folder::new();
    let script = folder.run("completions bash").stdout;
    std::fs::write(folder.join("it.bash"), script).unwrap();
    let asked =
        "source it.bash; COMP_WORDS=(asperity so); COMP_CWORD=1; _asperity asperity so asperity; echo ${COMPREPLY[@]}";
    let mut bash = Command::new("bash");
    let output = folder.finish(bash.args(["-c", asked]));
    assert_eq!(text(&output.stdout).trim(), "solve", "{}", text(&output.stderr));
}

#[test]
fn the_manual_has_a_page_for_every_command() {
    let folder = Folder::new();
    let whole = folder.run("man");
    let whole = text(&whole.stdout);
    let output = folder.run("man --out man1");
    assert!(output.status.success() && text(&output.stderr).starts_with("wrote man1"), "{}", text(&output.stderr));
    for name in commands(&folder) {
        let page = std::fs::read_to_string(folder.join(&format!("man1/asperity-{name}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS") && page.contains("Examples:"), "{name}");
        assert!(whole.contains(&page), "{name}");
    }
    let again = folder.run("man --out man1");
    assert_eq!(again.status.code(), Some(2));
    assert!(text(&again.stderr).contains("it is not empty: give a new folder"), "{}", text(&again.stderr));
}

#[test]
fn the_version_says_commit_and_features() {
    let folder = Folder::new();
    let short = folder.run("-V");
    assert_eq!(text(&short.stdout), concat!("asperity ", env!("CARGO_PKG_VERSION"), "\n"));
    let long = folder.run("--version");
    let lines: Vec<&str> = text(&long.stdout).lines().collect();
    assert_eq!(lines[0], concat!("asperity ", env!("CARGO_PKG_VERSION")));
    let commit = lines[1].strip_prefix("commit: ").unwrap();
    let is_commit = commit.len() >= 10 && commit.bytes().take(10).all(|byte| byte.is_ascii_hexdigit());
    assert!(is_commit || commit.starts_with("unknown, "), "{commit}");
    let features: Vec<&str> = lines[2].strip_prefix("features: ").unwrap().split(", ").collect();
    for (name, is_built) in [("cli", true), ("record", cfg!(feature = "record")), ("serve", cfg!(feature = "serve"))] {
        assert_eq!(features.contains(&name), is_built, "{features:?}");
    }
}

#[test]
fn quiet_leaves_results_warnings_and_errors() {
    let folder = Folder::new();
    let solve = format!("solve {CYLINDER} --out it.npz");
    let [said, quiet] = ["--reduced-pressure 0.01", "--reduced-pressure 0.01 --quiet"]
        .map(|rest| folder.run(&format!("{solve} {rest}")));
    assert!(text(&said.stderr).contains("wrote it.npz"));
    assert_eq!(
        text(&quiet.stderr).replace("warning: ", "").len() + "warning: ".len() * warned(&quiet),
        quiet.stderr.len()
    );
    assert!(
        !text(&quiet.stderr).contains("wrote") && text(&quiet.stdout).starts_with("Cylinder"),
        "{}",
        text(&quiet.stdout)
    );
    assert_eq!(warned(&said), warned(&quiet));
    let heavy = folder.run(&format!("-q {solve} --reduced-pressure 50"));
    assert!(text(&heavy.stderr).contains("far above 1"), "{}", text(&heavy.stderr));
    let wrong = folder.run(&format!("--quiet {solve} --reduced-pressure -1"));
    assert!(wrong.status.code() == Some(2) && text(&wrong.stderr).starts_with("error: "));
}

/// How many warnings are said.
fn warned(output: &Output) -> usize {
    super::warnings::warnings(output).len()
}

#[test]
fn the_numbers_are_the_same_with_any_threads() {
    let folder = Folder::new();
    let solve = |threads: &str| {
        let output = folder.run(&format!("solve {ROUGH_SURFACE} --reduced-pressure 0.02 --json {threads}"));
        let mut found: Value = serde_json::from_slice(&output.stdout).unwrap();
        found["seconds"] = Value::Null;
        found
    };
    let usual = solve("");
    assert!(usual["kappa_r"].as_f64().is_some_and(|kappa| kappa > 1.0));
    assert_eq!(solve("--threads 1"), usual);
    assert_eq!(solve("--threads 3"), usual);
    for threads in ["0", "-1", "1025", "99999999999999999999", "two"] {
        for line in [format!("--threads={threads} demo"), format!("solve {CYLINDER} --threads={threads}")] {
            let output = folder.run(&line);
            assert_eq!(output.status.code(), Some(2), "{threads}");
            let said = text(&output.stderr);
            assert!(said.contains("give a whole number from 1 to 1024") && said.contains(threads), "{said}");
        }
    }
}

/// What a command draws at a terminal; none where there is no `script` to make one.
fn at_a_terminal(folder: &Folder, line: &str, no_colour: bool) -> Option<String> {
    let inner = format!("{} {line}", env!("CARGO_BIN_EXE_asperity"));
    let mut script = std::process::Command::new("script");
    script.args(["-qec", &inner, "/dev/null"]).current_dir(folder.join("")).env("TERM", "xterm-256color");
    script.env_remove("NO_COLOR").stdin(std::process::Stdio::null());
    if no_colour {
        script.env("NO_COLOR", "1");
    }
    let output = script.output().ok()?;
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Whether letters are coloured, bold or underlined.
fn is_coloured(drawn: &str) -> bool {
    drawn.split("\u{1b}[").skip(1).any(|rest| {
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == ';')).unwrap_or(0);
        rest[end..].starts_with('m')
    })
}

#[test]
fn pipes_get_neither_colours_nor_bars_and_no_color_is_heeded() {
    let folder = Folder::new();
    let solve = "solve --hurst 0.8 --rolloff 0.25 --short-cutoff 0.001 --rms-gradient 0.1 --points 16384 --size 1 --reduced-pressure 0.01 \
                 --solver gfmd";
    for line in ["--help", "solve --nonsense", solve] {
        let output = folder.run(line);
        assert!(!output.stdout.contains(&0x1b) && !output.stderr.contains(&0x1b), "{line}");
    }
    let (Some(help), Some(plain)) = (at_a_terminal(&folder, "--help", false), at_a_terminal(&folder, "--help", true))
    else {
        eprintln!("skipped: there is no `script` to make a terminal");
        return;
    };
    assert!(is_coloured(&help) && !is_coloured(&plain), "{help:?} {plain:?}");
    let bars = |flags: &str| at_a_terminal(&folder, &format!("{solve} {flags}"), true).unwrap();
    let (shown, quiet) = (bars(""), bars("--quiet"));
    assert!(shown.contains("gfmd [") && !is_coloured(&shown), "{shown:?}");
    assert!(!quiet.contains('\u{1b}') && quiet.contains("kappa_r"), "{quiet:?}");
}

/// A reader such as `head` that goes once it has its lines is no error.
#[cfg(unix)]
#[test]
fn a_reader_may_go_before_the_end() {
    for words in [&["man"][..], &["completions", "bash"], &["licences"]] {
        let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"));
        let program = program.args(words).stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        let mut child = program.spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), ""), "{words:?}");
    }
}

/// A hollow at a negative place is given like any other bump.
#[test]
fn the_first_number_of_bumps_may_be_negative() {
    let output = Folder::new().run("surface --bumps -0.1,0.01,0.05,0.2,0.02,0.05 --points 64 --size 1");
    assert!(output.status.success() && text(&output.stdout).contains("2 bumps"), "{}", text(&output.stderr));
}

/// A file that two outputs share would keep one of them, and one that is read would be lost.
#[test]
fn no_output_takes_the_place_of_another_or_of_what_is_read() {
    let folder = Folder::new();
    assert!(folder.run(&format!("surface {ROUGH_LINE} --out h.npy")).status.success());
    assert!(folder.run(&format!("solve {ROUGH_LINE} --reduced-pressure 0.01 --save-setup in.toml")).status.success());
    assert!(folder.run("solve in.toml --out p.npz").status.success());
    let kept = ["h.npy", "in.toml", "p.npz"].map(|name| std::fs::read(folder.join(name)).unwrap());
    for (arguments, lost) in [
        (format!("solve {ROUGH_LINE} --reduced-pressure 0.01 --out a.npz --stress ./a.npz"), "./a.npz"),
        ("solve in.toml --save-setup in.toml".into(), "in.toml"),
        ("surface --height h.npy --size 1 --out h.npy".into(), "h.npy"),
        ("certify --setup in.toml --pressure p.npz --out ./p.npz".into(), "./p.npz"),
    ] {
        let output = folder.run(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {}", text(&output.stderr));
        assert!(text(&output.stderr).starts_with(&format!("error: cannot write {lost}: ")), "{}", text(&output.stderr));
    }
    assert_eq!(["h.npy", "in.toml", "p.npz"].map(|name| std::fs::read(folder.join(name)).unwrap()), kept);
    assert!(!folder.join("a.npz").exists());
}

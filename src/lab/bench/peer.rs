//! Other codes, which a Python interpreter runs.

use crate::contact::Problem;
use crate::error::reason;
use crate::formats::{read_field, write_heights};
use crate::surface::Surface;
use serde::Deserialize;
use serde_json::{Value, json};
use std::fs::File;
use std::io;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use strum::IntoStaticStr;

/// Solves a contact with another code.
const SCRIPT: &str = include_str!("../../../assets/bench/peers.py");

/// The variables that limit the threads of other codes.
const THREADS: [&str; 3] = ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"];

/// Time between two looks at whether a code has finished; the seconds of the solve are those that the code tells.
const PAUSE: Duration = Duration::from_millis(5);

/// Another code for rough contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub(super) enum Peer {
    /// <https://tamaas.readthedocs.io>: conjugate gradients of Polonsky and Keer, in double precision.
    Tamaas,
    /// <https://contactengineering.github.io/ContactMechanics>: conjugate gradients of Polonsky and Keer.
    ContactMechanics,
    /// ASPHER: nested grids, and a candidate set at free boundaries, in double precision.
    Aspher,
    /// ASPHER, first in single precision.
    AspherMixed,
    /// <https://contactengineering.github.io/Adhesion>: contacts with an attraction.
    Adhesion,
}

/// The solution of another code.
pub(super) struct PeerSolution {
    /// The version of the code.
    pub version: String,
    pub seconds: f64,
    pub pressure: Vec<f64>,
}

/// The answer of the script.
#[derive(Deserialize)]
#[serde(untagged)]
enum PeerAnswer {
    Solved { version: String, seconds: f64 },
    Skipped { skipped: String },
}

/// The interpreter that runs other codes, and its limits.
#[derive(Debug, Clone, PartialEq)]
pub struct Python {
    /// The program.
    pub program: PathBuf,
    /// Largest time of a solve, with the start of the interpreter.
    pub limit: Duration,
}

impl Peer {
    /// The codes that solve single contacts without adhesion.
    pub(crate) const OF_CONTACTS: [Self; 4] = [Self::Tamaas, Self::ContactMechanics, Self::Aspher, Self::AspherMixed];

    /// Solves a contact of a cell of length 1 and modulus 1 on a number of threads, to a tolerance in the sense of the code.
    ///
    /// # Errors
    /// Why there is no solution: the code is not installed, cannot solve this contact, or takes too long.
    pub(crate) fn solve(
        self,
        python: &Python,
        problem: &Problem,
        tolerance: f64,
        threads: usize,
    ) -> Result<PeerSolution, String> {
        let task = json!({
            "kind": "contact",
            "pressure": problem.expected_mean_pressure(),
            "free": !problem.surface().grid().is_periodic(),
            "tolerance": tolerance,
        });
        self.run(python, problem.surface(), task, threads)
    }

    /// Does a task with a surface on a number of threads. The task gets the files of heights and pressure.
    ///
    /// # Errors
    /// Why there is no solution: the code is not installed, cannot do this, or takes too long.
    pub(crate) fn run(
        self,
        python: &Python,
        surface: &Surface,
        task: Value,
        threads: usize,
    ) -> Result<PeerSolution, String> {
        self.try_run(python, surface, task, threads).unwrap_or_else(|error| Err(error.to_string()))
    }

    fn try_run(
        self,
        python: &Python,
        surface: &Surface,
        mut task: Value,
        threads: usize,
    ) -> io::Result<Result<PeerSolution, String>> {
        let folder = tempfile::tempdir()?;
        let [height, out, answer] = ["height.npy", "pressure.npy", "answer"].map(|name| folder.path().join(name));
        write_heights(&height, surface.height().view().into_dyn()).map_err(io::Error::other)?;
        task["height"] = json!(height);
        task["out"] = json!(out);
        let count = threads.to_string();
        let mut process = Command::new(&python.program)
            .args(["-c", SCRIPT, self.into(), &task.to_string()])
            .envs(THREADS.map(|name| (name, &count)))
            .stdin(Stdio::null())
            .stdout(File::create(&answer)?)
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| {
                io::Error::other(format!("{} cannot be run: {}", python.program.display(), reason(&error)))
            })?;
        let clock = Instant::now();
        while process.try_wait()?.is_none() {
            if clock.elapsed() > python.limit {
                process.kill()?;
                process.wait()?;
                return Ok(Err(format!("stopped after {} s", python.limit.as_secs())));
            }
            sleep(PAUSE);
        }
        let told = std::fs::read_to_string(&answer)?;
        match serde_json::from_str(told.lines().last().unwrap_or_default()) {
            Ok(PeerAnswer::Solved { version, seconds }) => {
                let pressure = read_field(&out, "pressure").map_err(io::Error::other)?;
                Ok(Ok(PeerSolution { version, seconds, pressure: pressure.into_iter().collect() }))
            }
            Ok(PeerAnswer::Skipped { skipped }) => Ok(Err(skipped)),
            Err(_) => Ok(Err("it ended without an answer".into())),
        }
    }
}

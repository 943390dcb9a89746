//! Experiments on the solvers themselves: accuracy, speed and stability.
//!
//! | module        | question                                                                                              |
//! |---------------|-------------------------------------------------------------------------------------------------------|
//! | [`accuracy`]  | How far has a solver come after which time, and what is that worth beside the errors of grid and theory? |
//! | [`mod@bench`] | How long does a solve take, how many transforms, how much memory?                                      |
//! | [`stability`] | Does every stiff or extreme contact end in a solution that an independent check confirms, or in a clear refusal? |
//!
//! Results are data, which display as tables; nothing is printed. Runs may take minutes: an [`ObserverMaker`] makes an observer of each
//! of them, such as a progress bar.
//!
//! ```
//! use asperity::lab::stability::{Tally, judge, trials};
//! use std::time::Duration;
//! let trials = trials(true)?;
//! let spikes = trials.iter().filter(|trial| trial.name.starts_with("spike-51x28"));
//! let runs = spikes.flat_map(|trial| trial.rivals.iter().map(move |rival| (trial, rival)));
//! let budget = Duration::from_secs(10);
//! let reports: Vec<_> = runs.map(|(trial, rival)| judge(trial, rival, budget, |_| Box::new(()))).collect();
//! let tally = Tally::new(&reports, None, None);
//! assert!(reports.len() == 6 && tally.is_stable(), "{tally}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod accuracy;
pub mod bench;
mod rival;
pub mod stability;
mod table;
mod watch;

pub use rival::Rival;
pub use watch::ObserverMaker;

//! The tables and figures of van Dokkum et al. (2018) made again, each of the paper's numbers beside the one found here.
//!
//! The paper: van Dokkum, Khajeh Salehani, Irani & Nicola, Tribol. Lett. 66:115 (2018).
//!
//! ```text
//! Paper { lines, surfaces, ... } --> Sweep --> points (CSV) --> Reproduction { figure, verdicts, ramp }
//!                                                                  |            |         |
//!                                                              SVG, PNG    Comparison  recording
//! ```
//!
//! ```no_run
//! use asperity::paper::{Effort, Item, Paper};
//!
//! let comparison = Paper::new("paper", Effort::Quick).run(&[Item::Fig2, Item::Fig3], &|_| ())?;
//! assert!(comparison.verdicts.iter().any(|verdict| verdict.verdict == "agrees"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![doc = include_str!("../../assets/doc/paper.md")]

mod beyond;
mod breadths;
mod comparison;
mod fig1;
mod fig2;
mod fig3;
mod fig4;
mod fig5;
mod fit;
mod gw;
mod hurst;
mod item;
mod limits;
mod means;
mod measure;
mod nayak;
mod nayak_trend;
mod persson;
mod plan;
#[cfg(feature = "record")]
mod recording;
#[cfg_attr(not(feature = "record"), expect(dead_code, reason = "only recordings show curves over loads"))]
mod reproduction;
mod rough;
mod run;
mod smooth;
mod table1;
mod verdict;

pub use breadths::Breadths;
pub use comparison::Comparison;
pub use fit::{Fit, Weights};
pub use item::Item;
pub use plan::{Effort, Paper};
pub use rough::Rough;
pub use run::{Event, EventHandler};
pub use verdict::{Evidence, Verdict};

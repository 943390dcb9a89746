//! The explorer in a browser: what a person sees, what leaves the page, and what pages of others can do.
//!
//! Without Chromium the tests pass and say that they are skipped; the last line `browser tests: 4 ran, 0 skipped` counts them.
//! `CHROME` or `CHROMIUM` names a Chromium that is not on the path.

mod appearance;
mod blind;
mod chance;
mod choices;
mod chromium;
mod downloads;
mod everyone;
mod explorer;
mod globals;
mod grips;
mod heights;
mod keyboard;
mod lessons;
mod links;
mod measures;
mod moments;
mod newcomers;
mod page;
mod person;
mod processes;
mod races;
mod seen_from_above;
mod site;
mod strangers;
mod tabs;

//! Contacts one after the other, where each step begins with what the last one left behind.
//!
//! | process                       | a step is                                             | it carries                          |
//! |-------------------------------|-------------------------------------------------------|-------------------------------------|
//! | [`SlipHistory`]               | a normal contact, then a traction below `mu p`        | the traction                        |

mod slip;
mod slip_state;

pub use slip::SlipHistory;
pub use slip_state::{SlipCertificate, SlipState, Zone};

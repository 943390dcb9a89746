//! Contacts in motion: states that carry something on from the material that was there before.
//!
//! One picture holds for all of them. The rough surface lies above the solid and moves towards `+x` over it, at rest in the frame of the
//! fields. So material of the solid enters the contact at its `+x` side. Tractions act on the solid below.

mod rolling;
mod sliding;

pub use rolling::{Rolling, RollingConditions, RollingDrive};
pub use sliding::Sliding;

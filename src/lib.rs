//! Rough contact.

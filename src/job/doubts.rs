//! What is wrong with the contacts of a file, in sentences.

use crate::contact::SavedDoubt;

/// What is wrong with the contacts of a file.
pub(super) struct Doubts<'a> {
    name: &'a str,
    count: usize,
    /// The number of a contact, from 0, none for all of them, and what is wrong with it.
    found: Vec<(Option<usize>, SavedDoubt)>,
}

impl<'a> Doubts<'a> {
    /// No doubts about the contacts of a file, which has a number of them.
    pub fn new(name: &'a str, count: usize) -> Self {
        Self { name, count, found: Vec::new() }
    }

    /// Adds what is wrong with a contact.
    pub fn add(&mut self, number: Option<usize>, doubts: Vec<SavedDoubt>) {
        self.found.extend(doubts.into_iter().map(|doubt| (number, doubt)));
    }

    /// A sentence for each kind, about the first contact that it concerns.
    pub fn in_words(&self) -> Vec<String> {
        let is_first = |i: usize| !self.found[..i].iter().any(|(_, other)| other.is_like(&self.found[i].1));
        let firsts = self.found.iter().enumerate().filter(|(i, _)| is_first(*i));
        let sentence = |(_, (number, doubt)): (usize, &(Option<usize>, SavedDoubt))| {
            let place = match number {
                Some(number) if self.count > 1 => format!("{} (number {} of {})", self.name, number + 1, self.count),
                _ => self.name.to_owned(),
            };
            let others = self.found.iter().filter(|(_, other)| other.is_like(doubt)).count() - 1;
            match others {
                0 => format!("{}.", doubt.in_words(&place)),
                1 => format!("{}; the same is true of another one.", doubt.in_words(&place)),
                _ => format!("{}; the same is true of {others} others.", doubt.in_words(&place)),
            }
        };
        firsts.map(sentence).collect()
    }
}

//! A history of the steps of a run, of limited length.

/// Columns over the steps of a run: one for each step and, once there are too many, one for two, four, eight steps and so on, of which
/// the later ones are merged into the first.
///
/// ```
/// use asperity::diagnosis::History;
/// let mut history = History::new(4, |largest: &mut i32, next| *largest = next.max(*largest));
/// (0..6).for_each(|step| history.add(step));
/// assert_eq!((history.columns(), history.per_column()), (&[1, 3, 5][..], 2));
/// ```
#[derive(Debug, Clone)]
pub struct History<C> {
    columns: Vec<C>,
    most: usize,
    per_column: usize,
    steps: usize,
    merge: fn(&mut C, C),
}

impl<C> History<C> {
    /// An empty history of at most `most` columns, two or more.
    pub fn new(most: usize, merge: fn(&mut C, C)) -> Self {
        Self { columns: Vec::new(), most: most.max(2), per_column: 1, steps: 0, merge }
    }

    /// The columns, the last of which may be incomplete.
    pub fn columns(&self) -> &[C] {
        &self.columns
    }

    /// Steps of each column.
    pub fn per_column(&self) -> usize {
        self.per_column
    }

    /// Steps so far.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Whether the next step begins a column, so that it cannot be left out.
    pub fn begins(&self) -> bool {
        self.steps.is_multiple_of(self.per_column)
    }

    /// Adds a step that may be left out.
    pub fn pass(&mut self) {
        self.steps += 1;
    }

    /// Adds a step.
    pub fn add(&mut self, column: C) {
        if self.begins() {
            if self.columns.len() == self.most {
                self.halve();
            }
            if self.begins() {
                self.columns.push(column);
            } else {
                self.merge_last(column);
            }
        } else {
            self.merge_last(column);
        }
        self.steps += 1;
    }

    fn merge_last(&mut self, column: C) {
        if let Some(last) = self.columns.last_mut() {
            (self.merge)(last, column);
        }
    }

    fn halve(&mut self) {
        let mut halved: Vec<C> = Vec::with_capacity(self.most);
        for (i, column) in self.columns.drain(..).enumerate() {
            match halved.last_mut() {
                Some(last) if i % 2 == 1 => (self.merge)(last, column),
                _ => halved.push(column),
            }
        }
        self.columns = halved;
        self.per_column *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_is_in_its_column() {
        for (most, steps) in [(2, 1000), (7, 1000), (8, 64), (1024, 1000)] {
            let mut history = History::new(most, |set: &mut Vec<usize>, mut next| set.append(&mut next));
            (0..steps).for_each(|step| history.add(vec![step]));
            assert!(history.columns().len() <= most && history.steps() == steps);
            for (i, column) in history.columns().iter().enumerate() {
                let first = i * history.per_column();
                assert!(column.iter().copied().eq(first..(first + history.per_column()).min(steps)), "{most}, {i}");
            }
        }
    }

    #[test]
    fn steps_that_are_left_out_keep_the_place_of_the_others() {
        let mut history = History::new(4, |_: &mut usize, _| ());
        for step in 0..100 {
            if history.begins() { history.add(step) } else { history.pass() }
        }
        let expected: Vec<usize> = (0..100).step_by(history.per_column()).collect();
        assert_eq!(history.columns(), expected);
    }
}

//! The order in which tasks are done, and how many at a time.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Tasks that several workers take one after the other: the most work first, each as soon as there is memory for it.
pub(super) struct Queue {
    state: Mutex<QueueState>,
    given_back: Condvar,
    /// Bytes that each task needs.
    bytes: Vec<f64>,
}

/// A task that is being done, whose memory is given back in the end, however it ends.
pub(super) struct Task<'a> {
    pub number: usize,
    queue: &'a Queue,
}

struct QueueState {
    waiting: VecDeque<usize>,
    /// Bytes that are free.
    free: f64,
    /// Tasks that are being done.
    busy: usize,
}

impl Queue {
    /// Tasks of some `(work, bytes)`, which together take no more than `memory` bytes at a time; a task that needs more is done
    /// alone.
    pub(crate) fn new(tasks: &[(f64, f64)], memory: f64) -> Self {
        let mut waiting: Vec<usize> = (0..tasks.len()).collect();
        waiting.sort_by(|&a, &b| tasks[b].0.total_cmp(&tasks[a].0));
        let state = QueueState { waiting: waiting.into(), free: memory, busy: 0 };
        let bytes = tasks.iter().map(|(_, bytes)| *bytes).collect();
        Self { state: Mutex::new(state), given_back: Condvar::new(), bytes }
    }

    /// The next task, once there is memory for it; none when all are taken.
    pub(crate) fn take(&self) -> Option<Task<'_>> {
        let mut state = self.state();
        while !state.waiting.is_empty() {
            let fits = |&task: &usize| self.bytes[task] <= state.free;
            let next = state.waiting.iter().position(fits).or((state.busy == 0).then_some(0));
            if let Some(task) = next.and_then(|next| state.waiting.remove(next)) {
                state.free -= self.bytes[task];
                state.busy += 1;
                return Some(Task { number: task, queue: self });
            }
            state = self.given_back.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        None
    }

    /// Lets no more tasks be taken.
    pub(crate) fn close(&self) {
        self.state().waiting.clear();
        self.given_back.notify_all();
    }

    fn state(&self) -> MutexGuard<'_, QueueState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Task<'_> {
    fn drop(&mut self) {
        let mut state = self.queue.state();
        state.free += self.queue.bytes[self.number];
        state.busy -= 1;
        drop(state);
        self.queue.given_back.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(task: &Option<Task<'_>>) -> Option<usize> {
        task.as_ref().map(|task| task.number)
    }

    #[test]
    fn the_most_work_comes_first_as_far_as_memory_goes() {
        let queue = Queue::new(&[(1.0, 1.0), (9.0, 6.0), (5.0, 6.0), (9.0, 4.0)], 10.0);
        let (first, second) = (queue.take(), queue.take());
        assert_eq!([&first, &second].map(number), [Some(1), Some(3)]);
        drop(first);
        let third = queue.take();
        drop(second);
        assert_eq!([&third, &queue.take(), &queue.take()].map(number), [Some(2), Some(0), None]);
    }

    #[test]
    fn what_is_too_large_is_done_alone() {
        let queue = Queue::new(&[(9.0, 100.0), (1.0, 8.0), (2.0, 8.0)], 10.0);
        let small = queue.take();
        assert_eq!(number(&small), Some(2));
        std::thread::scope(|scope| {
            let next = scope.spawn(|| number(&queue.take()));
            drop(small);
            assert_eq!(next.join().unwrap(), Some(1));
        });
        assert_eq!(number(&queue.take()), Some(0));
        assert_eq!(number(&queue.take()), None);
    }

    #[test]
    fn nothing_is_taken_once_it_is_closed() {
        let queue = Queue::new(&[(1.0, 1.0), (1.0, 1.0)], 1.0);
        let first = queue.take();
        std::thread::scope(|scope| {
            let waiting = scope.spawn(|| number(&queue.take()));
            queue.close();
            assert_eq!(waiting.join().unwrap(), None);
        });
        drop(first);
    }
}

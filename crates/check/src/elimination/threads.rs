//! More than one thread, where there is much to do.

use std::sync::Mutex;

/// Items that a thread takes at a time.
const GROUP: usize = 16;

/// Works on all items, some at a time, with more threads if there are so many that it is worth
/// their start.
pub(crate) fn for_all<T: Send>(items: &mut [T], work: impl Fn(&mut [T]) + Sync) {
    let all =
        || std::thread::available_parallelism().map_or(1, |most| most.get().min(items.len() / 32));
    let threads = if items.len() < 64 { 1 } else { all() };
    let groups = Mutex::new(items.chunks_mut(GROUP));
    let next = || groups.lock().ok().and_then(|mut groups| groups.next());
    let run = || std::iter::from_fn(next).for_each(&work);
    std::thread::scope(|scope| {
        (1..threads).for_each(|_| drop(scope.spawn(run)));
        run();
    });
}

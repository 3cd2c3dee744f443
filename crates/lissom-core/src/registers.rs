//! Loops that use the widest registers of the machine.

use std::sync::LazyLock;

/// What the machine has. Asking it takes longer than the shortest loops.
static ARCH: LazyLock<pulp::Arch> = LazyLock::new(pulp::Arch::new);

/// What `work` gives, compiled for the widest registers that the machine has, found when the program runs. Nothing is contracted
/// or reordered: results are the same on every machine.
///
/// `work` calls a function that is always inlined; what is not inlined is compiled for the oldest machine.
pub(crate) fn widest<T>(work: impl FnOnce() -> T) -> T {
    ARCH.dispatch(Work(work))
}

struct Work<F>(F);

impl<T, F: FnOnce() -> T> pulp::WithSimd for Work<F> {
    type Output = T;

    #[expect(clippy::inline_always, reason = "compiled with the registers of the caller")]
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> T {
        (self.0)()
    }
}

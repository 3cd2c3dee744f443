//! Beams against reference solutions that were made another way: exact rationals and ball
//! arithmetic of hundreds to thousands of bits, (2)-(5) solved directly (`make_*.py`).

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests, which show their errors")]

mod damping;
mod data;
mod distributed;
mod lumped;
mod transfer;

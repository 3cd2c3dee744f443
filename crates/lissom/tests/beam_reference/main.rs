//! Beams against reference solutions that were made another way: exact rationals and ball
//! arithmetic of hundreds to thousands of bits, (2)-(5) solved directly (`make_*.py`).

mod damping;
mod data;
mod lumped;
mod transfer;

//! A value of a parameter.

/// A value of a log. Of a [`Machine`](super::machines::Machine) it is without the common course.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LogValue<'a> {
    pub(super) log: &'a str,
    pub(super) machine: Option<&'a str>,
    pub(super) time_us: Option<i64>,
    pub(super) value: f64,
    pub(super) std: f64,
}

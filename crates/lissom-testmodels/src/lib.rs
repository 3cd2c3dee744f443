//! Analytic plants shared by tests, benches and examples.

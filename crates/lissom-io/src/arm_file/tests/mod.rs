//! What an `arm.toml` gives, and what it is refused for.

mod arm_file_tests;
mod arm_fixture;
mod beam_spec_tests;
mod load_spec_tests;
mod mode_specs_tests;
mod rig_spec_tests;

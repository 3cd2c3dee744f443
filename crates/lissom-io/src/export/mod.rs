//! Models for other programs: python-control, MATLAB and Octave, MuJoCo, URDF, C.
//!
//! [`ExportModel`] is an identified or described arm with what the targets need; each target is a file of its own.

mod c_code;
mod described_arm;
mod export_error;
mod export_model;
mod friction_pair;
mod hinge_chain;
mod mat_file;
mod matlab_script;
mod mjcf;
mod mjcf_chain;
mod mjcf_text;
mod number_text;
mod python_script;
mod urdf;
mod xml_edit;

pub use c_code::{CFiles, c_files};
pub use described_arm::{export_model_of_arm_file, mjcf_of_arm_file};
pub use export_error::ExportError;
pub use export_model::{
    ExportModel, export_model_of_arm, export_model_of_result, export_model_of_text,
};
pub use mat_file::mat_file;
pub use matlab_script::matlab_script;
pub use mjcf::{mjcf, mjcf_into};
pub use python_script::python_script;
pub use urdf::urdf_into;

//! Models for other programs.

use std::path::PathBuf;

use lissom::io::export::{
    ExportError, c_files, export_model_of_text, mat_file, matlab_script, mjcf, mjcf_into,
    python_script, urdf_into,
};
use pyo3::prelude::*;

use crate::errors::{input_error, raised};

/// Writes a result for another program: files with their bytes. `into` is a user's model with the joint `joint`.
#[pyfunction]
#[pyo3(signature = (result, target, into=None, joint=None))]
pub(crate) fn export(
    py: Python<'_>,
    result: &str,
    target: &str,
    into: Option<PathBuf>,
    joint: Option<&str>,
) -> PyResult<Vec<(String, Vec<u8>)>> {
    let fail = |error: lissom::io::Error| raised(py, error);
    let model = export_model_of_text("result".to_owned(), result).map_err(fail)?;
    let one = |name: &str, bytes: Vec<u8>| vec![(name.to_owned(), bytes)];
    let users = into.map(|path| {
        let file = path.display().to_string();
        let text = lissom::io::read_text(&path)
            .map_err(|source| fail(ExportError::Read { file: file.clone(), source }.into()))?;
        Ok::<_, PyErr>((file, text))
    });
    let users = users.transpose()?;
    let merged = users.as_ref().zip(joint);
    Ok(match (target, merged) {
        ("python", _) => one("model.py", python_script(&model).into_bytes()),
        ("m", _) => one("model.m", matlab_script(&model).into_bytes()),
        ("mat", _) => one("model.mat", mat_file(&model)),
        ("mjcf", None) => one("model.xml", mjcf(&model).map_err(|e| fail(e.into()))?.into_bytes()),
        ("mjcf", Some(((file, text), joint))) => one(
            "model.xml",
            mjcf_into(&model, file, text, joint).map_err(|e| fail(e.into()))?.into_bytes(),
        ),
        ("urdf", Some(((file, text), joint))) => one(
            "model.urdf",
            urdf_into(&model, file, text, joint).map_err(|e| fail(e.into()))?.into_bytes(),
        ),
        ("c", _) => {
            let files = c_files(&model);
            let named = |name: &str, text: String| (name.to_owned(), text.into_bytes());
            vec![
                named("lissom_feedforward.h", files.header),
                named("lissom_feedforward.c", files.source),
            ]
        }
        _ => {
            let message = format!("there is no export to \"{target}\" with these arguments");
            return Err(input_error(py, &message, None));
        }
    })
}

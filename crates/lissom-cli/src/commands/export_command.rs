//! `lissom export RESULT --to TARGET --out FILE`.

use std::path::Path;

use lissom_io::ArmFile;
use lissom_io::export::{
    ExportError, ExportModel, c_files, export_model_of_arm_file, export_model_of_result, mat_file,
    matlab_script, mjcf, mjcf_into, mjcf_of_arm_file, python_script, urdf_into,
};
use lissom_io::write::Batch;

use crate::args::export_args::{ExportArgs, Target};
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::described_logs::is_toml;
use crate::views::printer;

pub(crate) fn run(args: &ExportArgs) -> Result<ExitCode, Failure> {
    let inputs: Vec<&Path> =
        [Some(&args.input), args.into.as_ref()].into_iter().flatten().map(AsRef::as_ref).collect();
    output_guard::guard_inputs(Some(&args.out), &inputs)?;
    output_guard::guard_marked(&args.out, MARK)?;
    let into = args.into.as_deref().zip(args.joint.as_deref());
    if into.is_some() && !matches!(args.to, Target::Mjcf | Target::Urdf) {
        return Err(Failure::Asked(
            "--into is for mjcf and urdf only".to_owned(),
            "leave out --into and --joint",
        ));
    }
    if args.to == Target::Mjcf && into.is_none() && is_toml(&args.input) {
        let text = mjcf_of_arm_file(&args.input, &ArmFile::read(&args.input)?)?;
        return write_one(&args.out, &text);
    }
    let model = model(&args.input)?;
    let mut batch = Batch::new();
    let mut written = vec![args.out.display().to_string()];
    match args.to {
        Target::Python => batch.file(&args.out, python_script(&model).as_bytes())?,
        Target::M => batch.file(&args.out, matlab_script(&model).as_bytes())?,
        Target::Mat => batch.file(&args.out, &mat_file(&model))?,
        Target::Mjcf => {
            let text = match into {
                None => mjcf(&model).map_err(lissom_io::Error::from)?,
                Some((file, joint)) => merged(&model, file, joint, mjcf_into)?,
            };
            batch.file(&args.out, text.as_bytes())?;
        }
        Target::Urdf => {
            let Some((file, joint)) = into else {
                return Err(Failure::Asked(
                    "URDF has friction only at a joint of a robot".to_owned(),
                    "give your robot and the joint: --into robot.urdf --joint NAME",
                ));
            };
            batch.file(&args.out, merged(&model, file, joint, urdf_into)?.as_bytes())?;
        }
        Target::C => {
            batch.folder(&args.out)?;
            let files = c_files(&model);
            let [header, source] =
                ["lissom_feedforward.h", "lissom_feedforward.c"].map(|n| args.out.join(n));
            batch.file(&header, files.header.as_bytes())?;
            batch.file(&source, files.source.as_bytes())?;
            written = [header, source].iter().map(|f| f.display().to_string()).collect();
        }
    }
    batch.commit()?;
    printer::line(&format!("written: {}", written.join(", ")));
    Ok(ExitCode::SUCCESS)
}

fn write_one(out: &Path, text: &str) -> Result<ExitCode, Failure> {
    let mut batch = Batch::new();
    batch.file(out, text.as_bytes())?;
    batch.commit()?;
    printer::line(&format!("written: {}", out.display()));
    Ok(ExitCode::SUCCESS)
}

/// What every exported file has: the copy of a user's model in the comment before the joint.
const MARK: &str = "by lissom";

/// The model of a result, or of an arm file.
fn model(input: &Path) -> Result<ExportModel, Failure> {
    if !is_toml(input) {
        return Ok(export_model_of_result(input)?);
    }
    Ok(export_model_of_arm_file(input, &ArmFile::read(input)?)?)
}

/// A function that writes the numbers of a joint into a text.
type Into = fn(&ExportModel, &str, &str, &str) -> Result<String, ExportError>;

fn merged(model: &ExportModel, file: &Path, joint: &str, write: Into) -> Result<String, Failure> {
    let name = file.display().to_string();
    let text = lissom_io::read_text(file).map_err(|source| {
        lissom_io::Error::from(ExportError::Read { file: name.clone(), source })
    })?;
    Ok(write(model, &name, &text, joint).map_err(lissom_io::Error::from)?)
}

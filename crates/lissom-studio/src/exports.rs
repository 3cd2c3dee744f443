//! Files made of a result. Nothing is compiled or run.

use std::fs;
use std::path::{MAIN_SEPARATOR, Path};

use lissom::record::Axis;
use lissom_io::ResultFile;
use lissom_io::export::{
    c_files, export_model_of_result, mat_file, matlab_script, mjcf, python_script,
};

use crate::problem::Problem;

/// A file for the user to save.
pub(crate) struct Export {
    pub(crate) content_type: &'static str,
    pub(crate) content: Vec<u8>,
}

/// Names of the files of a result; one of planned runs has a plan.toml, and others a campaign.toml.
pub(crate) fn names(planned: bool) -> impl Iterator<Item = &'static str> {
    let other = if planned { "campaign.toml" } else { "plan.toml" };
    FILES.into_iter().filter(move |name| *name != other)
}

const FILES: [&str; 11] = [
    "report.html",
    "result.json",
    "campaign.toml",
    "plan.toml",
    "arm.toml",
    "arm.py",
    "arm.m",
    "arm.mat",
    "arm.xml",
    "lissom_feedforward.h",
    "lissom_feedforward.c",
];

/// The file of this name, of the result in a folder.
pub(crate) fn export(folder: &Path, name: &str) -> Result<Export, Problem> {
    let result = folder.join("result.json");
    let model = || export_model_of_result(&result);
    // The folder means nothing to who reads the file.
    let plain = |text: String| {
        let folder = format!("{}{MAIN_SEPARATOR}", folder.display());
        text.replace(&folder, "").into_bytes()
    };
    let (content_type, content) = match name {
        "report.html" => ("text/html; charset=utf-8", fs::read(folder.join(name))?),
        "result.json" => ("application/json", fs::read(folder.join(name))?),
        "campaign.toml" | "plan.toml" => {
            ("text/plain; charset=utf-8", fs::read(folder.join(name))?)
        }
        "arm.toml" => {
            let text = fs::read(folder.join(name)).map_err(|_| {
                let is_linear = ResultFile::read(&result).is_ok_and(|r| r.axis == Axis::Linear);
                let (error, hint) = if is_linear {
                    let error =
                        "plans and the virtual rig are of rotary axes, and this axis is linear";
                    (error, "choose a result of a rotary axis")
                } else {
                    let error = "this result has no arm that can be simulated";
                    (error, "see its findings, or plan with an arm.toml of known dimensions")
                };
                Problem::input(error, Some(hint.to_owned()))
            })?;
            ("text/plain; charset=utf-8", text)
        }
        "arm.py" => ("text/plain; charset=utf-8", plain(python_script(&model()?))),
        "arm.m" => ("text/plain; charset=utf-8", plain(matlab_script(&model()?))),
        "arm.mat" => ("application/octet-stream", mat_file(&model()?)),
        "arm.xml" => {
            let text = mjcf(&model()?).map_err(lissom_io::Error::from)?;
            ("text/plain; charset=utf-8", plain(text))
        }
        "lissom_feedforward.h" => ("text/plain; charset=utf-8", plain(c_files(&model()?).header)),
        "lissom_feedforward.c" => ("text/plain; charset=utf-8", plain(c_files(&model()?).source)),
        _ => return Err(Problem::not_found("file")),
    };
    Ok(Export { content_type, content })
}

/// The content of the report page of the result in a folder.
pub(crate) fn report(folder: &Path) -> Result<String, Problem> {
    let page = fs::read_to_string(folder.join("report.html"))?;
    let content = page.split_once("<main>\n").and_then(|(_, rest)| rest.rsplit_once("</main>"));
    let content = content.ok_or_else(|| Problem::internal("the page of the result is damaged"))?;
    Ok(content.0.to_owned())
}

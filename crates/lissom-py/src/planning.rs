//! Experiments that give a wanted precision.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use lissom::io::{ArmFile, PlannedFile, write};
use lissom::plan::{Kinds, Precision, Wishes};
use pyo3::prelude::*;

use crate::errors::input_error;
use crate::simulating::text;
use crate::worker;

/// Plans experiments: the text that `lissom plan --json` writes, and the plan.toml. `precision` has relative standard
/// errors by the names of parameters, `all` for all except damping.
#[pyfunction]
#[pyo3(signature = (precision, runs, within_s=None, travel_rad=None, bend_rad=None, reserve=None, arm_path=None, arm_text=None))]
#[expect(clippy::too_many_arguments, reason = "options of a Python function")]
pub(crate) fn plan(
    py: Python<'_>,
    precision: HashMap<String, f64>,
    runs: &str,
    within_s: Option<f64>,
    travel_rad: Option<f64>,
    bend_rad: Option<f64>,
    reserve: Option<f64>,
    arm_path: Option<PathBuf>,
    arm_text: Option<String>,
) -> PyResult<(String, String)> {
    let kinds = match runs {
        "pair" => Kinds::WithPair,
        "sines" => Kinds::Sines,
        "any" => Kinds::Any,
        _ => {
            let message = format!("runs is \"{runs}\", and not pair, sines or any");
            return Err(input_error(py, &message, None));
        }
    };
    let none = Wishes::default();
    let wishes = Wishes {
        precision: precision_of(py, &precision)?,
        within_s: within_s.unwrap_or(none.within_s),
        travel_rad: travel_rad.unwrap_or(none.travel_rad),
        bend_rad: bend_rad.unwrap_or(none.bend_rad),
        current_reserve: reserve.unwrap_or(none.current_reserve),
        kinds,
    };
    let (path, arm) = text(py, arm_path, arm_text, "arm")?;
    worker::wait(py, move || planned(&path, &arm, &wishes))
}

fn precision_of(py: Python<'_>, wanted: &HashMap<String, f64>) -> PyResult<Precision> {
    let mut precision =
        wanted.get("all").map_or_else(Precision::default, |share| Precision::all(*share));
    for (name, share) in wanted {
        let place = match name.as_str() {
            "all" => continue,
            "coulomb" => &mut precision.coulomb,
            "viscous" => &mut precision.viscous,
            "inertia" => &mut precision.inertia,
            "coupling" => &mut precision.coupling,
            "frequency" => &mut precision.frequency,
            "damping" => &mut precision.damping,
            "gravity" => &mut precision.gravity,
            _ => {
                let message = format!("no precision can be asked of \"{name}\"");
                let hint = "the names are all, coulomb, viscous, inertia, coupling, frequency, damping and gravity";
                return Err(input_error(py, &message, Some(hint)));
            }
        };
        *place = *share;
    }
    Ok(precision)
}

fn planned(path: &Path, arm: &str, wishes: &Wishes) -> Result<(String, String), lissom::Error> {
    let rig = ArmFile::from_text(path, arm)?.rig(path)?;
    let made = lissom::plan::plan(&rig, wishes, |_, _| ())?;
    let json = write::json_text(Path::new("plan"), &PlannedFile::of(wishes, &made))?;
    Ok((json, write::plan_text(&made)))
}

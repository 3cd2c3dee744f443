//! Exchange of campaigns with another simulator.
//!
//! [`export`] writes the definition of a campaign: dimensions, constants, loop, references. The other
//! program draws its own noise and writes `NNNN/campaign.toml`, its logs and `facts.json`;
//! [`simulated`] reads them as logs of a user.

use std::fs;
use std::path::{Path, PathBuf};

use lissom::rig::{ControlLaw, Drive, Reference, Sensor, Sweep};
use lissom_io::read_campaign;
use lissom_io::write::{create_folder, write_json};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::campaign::{Campaign, PlannedRun, RunFacts, peak};

/// The reason why a campaign cannot be written or read.
pub type ExternalError = Box<dyn std::error::Error + Send + Sync>;

/// Facts about a run that its log does not contain.
#[derive(Debug, Deserialize)]
struct Fact {
    start: Vec<f64>,
    stuck_share: f64,
}

/// Writes `NNNN.json` of a campaign of seed `seed` into `folder`.
///
/// # Errors
/// If the folder cannot be written, or the campaign has a part that the format cannot describe.
pub fn export(campaign: &Campaign, seed: u64, folder: &Path) -> Result<(), ExternalError> {
    let rig = &campaign.definition.rig;
    let (arm, instruments) = (&rig.arm, &rig.instruments);
    let ControlLaw::Pd(pd) = &rig.controller else {
        return Err("only PD loops can be exported".into());
    };
    let spans = arm.beam().spans().iter().map(|s| {
        json!({
            "length_m": s.length_m,
            "flexural_rigidity_n_m2": s.flexural_rigidity_n_m2,
            "mass_kg": s.mass_kg,
            "damping_n_s_per_m": s.damping_n_s_per_m,
        })
    });
    let runs = campaign.definition.runs.iter().zip(&campaign.facts).zip(&campaign.logs.runs);
    let runs = runs.map(|((run, facts), log)| {
        Ok(json!({
            "name": run.name,
            "seed": run.seed,
            "wait_samples": (facts.waited_s / instruments.sample_time_s).round() as u64,
            "rows": log.len(),
            "reference": reference(run)?,
        }))
    });
    let given = json!({
        "seed": seed,
        "index": campaign.index,
        "spans": spans.collect::<Vec<_>>(),
        "inertia_kg_m2": arm.motor.inertia_kg_m2(),
        "viscous_nm_s_per_rad": arm.motor.viscous_nm_s_per_rad(),
        "torque_constant_nm_per_a": arm.motor.torque_constant_nm_per_a(),
        "forward_nm": arm.coulomb.forward(),
        "backward_nm": arm.coulomb.backward(),
        "proportional_a_per_rad": pd.proportional_a_per_rad(),
        "derivative_a_s_per_rad": pd.derivative_a_s_per_rad(),
        "filter_s": pd.filter_s().unwrap_or(0.0),
        "limit_a": instruments.amplifier.most_a(),
        "sample_time_s": instruments.sample_time_s,
        "motor": sensor(instruments.motor),
        "tip": sensor(instruments.tip(0)),
        "runs": runs.collect::<Result<Vec<Value>, ExternalError>>()?,
    });
    create_folder(folder)?;
    write_json(&folder.join(format!("{:04}.json", campaign.index)), &given)?;
    Ok(())
}

fn sensor(sensor: Sensor) -> Value {
    json!({
        "step_rad": sensor.quantiser.map_or(0.0, |q| q.step()),
        "noise_rad": sensor.noise.map_or(0.0, |n| n.std()),
    })
}

fn reference(run: &PlannedRun) -> Result<Value, ExternalError> {
    match &run.experiment.drive {
        Drive::Angle(Reference::Sine(sine)) => Ok(json!({
            "kind": "sine",
            "omega_rad_s": sine.omega_rad_s(),
            "amplitude_rad": sine.amplitude(),
        })),
        // Im(p·e^{jhx}) = Re p·sin hx + Im p·cos hx.
        Drive::Angle(Reference::Multisine(sum)) => Ok(json!({
            "kind": "multisine",
            "omega_rad_s": sum.omega_rad_s(),
            "lines": sum.lines().map(|(h, p)| json!([h, p.re, p.im])).collect::<Vec<_>>(),
        })),
        Drive::Angle(Reference::Chirp(chirp)) if chirp.sweep() == Sweep::Logarithmic => Ok(json!({
            "kind": "chirp",
            "ends_rad_s": chirp.ends_rad_s(),
            "duration_s": chirp.duration_s(),
            "amplitude_rad": chirp.amplitude(),
        })),
        other => Err(format!("{}: this motion cannot be exported: {other:?}", run.name).into()),
    }
}

/// A campaign with the logs that another simulator wrote to `folder`.
///
/// # Errors
/// If they cannot be read, or their number is not that of the planned runs.
pub fn simulated(mut campaign: Campaign, folder: &Path) -> Result<Campaign, ExternalError> {
    let own: PathBuf = folder.join(format!("{:04}", campaign.index));
    campaign.logs = read_campaign(&own.join("campaign.toml"))?.campaign;
    let facts: Vec<Fact> = serde_json::from_slice(&fs::read(own.join("facts.json"))?)?;
    let (asked, found) = (campaign.facts.len(), campaign.logs.runs.len());
    if (asked, asked) != (found, facts.len()) {
        return Err(format!("{}: it has {found} of the {asked} planned runs", own.display()).into());
    }
    let both = facts.into_iter().zip(&campaign.facts).zip(&campaign.logs.runs);
    // Other noise may make the amplifier saturate: the log contains the current that acted.
    let taken = both.map(|((fact, before), run)| RunFacts {
        stuck_share: fact.stuck_share,
        waited_s: before.waited_s,
        peak_a: peak(run),
        start: fact.start,
    });
    campaign.facts = taken.collect();
    Ok(campaign)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::draw_campaign;
    use crate::law::Law;

    /// The exported numbers give the reference of every kind of run again.
    #[test]
    fn exported_references_are_those_of_the_runs() {
        let number = |v: &Value| v.as_f64().unwrap();
        let mut kinds = std::collections::BTreeSet::new();
        // Sines, a chirp, a multisine.
        for campaign in [6, 18, 30].map(|index| draw_campaign(1, index, Law::None).unwrap()) {
            for run in &campaign.definition.runs {
                let (r, t) = (reference(run).unwrap(), 3.7);
                let value = match r["kind"].as_str().unwrap() {
                    "sine" => number(&r["amplitude_rad"]) * (number(&r["omega_rad_s"]) * t).sin(),
                    "multisine" => {
                        let line = |l: &Value| {
                            let phase = number(&l[0]) * number(&r["omega_rad_s"]) * t;
                            number(&l[1]) * phase.sin() + number(&l[2]) * phase.cos()
                        };
                        r["lines"].as_array().unwrap().iter().map(line).sum()
                    }
                    _ => {
                        let (a, b) = (number(&r["ends_rad_s"][0]), number(&r["ends_rad_s"][1]));
                        let d = number(&r["duration_s"]);
                        let grown = ((b / a).powf(t / d) - 1.0) / (b / a).ln();
                        number(&r["amplitude_rad"]) * (a * d * grown).sin()
                    }
                };
                let asked = run.experiment.drive.reference().value(t);
                assert!((value - asked).abs() < 1e-9, "{}: {value} for {asked}", run.name);
                kinds.insert(r["kind"].to_string());
            }
        }
        assert_eq!(kinds.len(), 3);
    }

    #[test]
    fn missing_logs_are_an_error_with_their_path() {
        let campaign = draw_campaign(1, 0, Law::None).unwrap();
        let error = simulated(campaign, Path::new("no-such-folder")).unwrap_err();
        assert!(error.to_string().contains("no-such-folder"), "{error}");
    }
}

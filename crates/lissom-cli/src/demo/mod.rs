//! `lissom demo`: the report's experiment on a virtual rig, identified from its logs alone.

mod plan;

use std::path::Path;
use std::process::ExitCode;

use lissom::arm::Arm;
use lissom::identify::{Estimate, Identified, OutputError};
use lissom::replay::{ModalArm, Parameter};
use lissom_io::write::{self, Batch};
use lissom_io::{ArmFile, ResultFile, UnitNames, read_campaign};
use serde_json::{Value, json};

use crate::cli::{DemoArgs, STDOUT};
use crate::failure::Failure;
use crate::reference::Reference;
use crate::{figures, identify, output, page, print};

/// The arm, as a user would describe it.
const ARM: &str = include_str!("arm.toml");

pub(crate) fn run(args: &DemoArgs) -> Result<ExitCode, Failure> {
    let out = &args.out;
    output::guard(args.json.as_deref().filter(|path| *path != Path::new(STDOUT)), None)?;
    let arm_path = out.join("arm.toml");
    let rig = ArmFile::from_text(&arm_path, ARM)?.rig(&arm_path).map_err(lissom_io::Error::from)?;
    write::create_folder(out)?;
    write::write_text(&arm_path, ARM)?;
    plan::write_logs(&rig, out)?;

    let campaign_path = out.join("campaign.toml");
    let file = read_campaign(&campaign_path)?;
    let id = identify::identified(&campaign_path, &file, None, false)?;

    let channels = &file.campaign.channels;
    let names = UnitNames::new(channels);
    let truth = Reference::truth(&rig.arm);
    let result = ResultFile::of(channels, &id, None);
    write::write_json(&out.join("result.json"), &result)?;
    let mut batch = Batch::new();
    figures::add_all(&mut batch, out, channels, names, &id, Some(&truth))?;
    batch.commit()?;
    let text = page::page("lissom demo", &file.campaign, names, &id, Some(&truth), None);
    write::write_text(&out.join("report.html"), &text)?;

    let rows = comparison(&rig.arm, &id);
    match args.json.as_deref() {
        Some(path) if path == Path::new(STDOUT) => print::json(&compared(&rows, &result)),
        json => {
            if let Some(path) = json {
                write::write_json(path, &compared(&rows, &result))?;
            }
            report(out, &file.campaign, &id, &rows);
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// A figure: name, unit, truth, the report's method, regression, output error.
struct Row {
    name: &'static str,
    unit: &'static str,
    truth: f64,
    third: Option<Estimate>,
    regression: Option<Estimate>,
    output_error: Option<Estimate>,
}

fn comparison(arm: &Arm, id: &Identified) -> Vec<Row> {
    let third = id.third_harmonic.as_ref();
    let fit = third.and_then(|t| t.motor.as_ref());
    let r = id.regression.as_ref();
    let oe = id.output_error.as_ref();
    let k = arm.motor.torque_constant_nm_per_a;
    let frequency = |m: &lissom::identify::ModeEstimate| m.natural_frequency_rad_s;
    vec![
        Row {
            name: "Coulomb friction",
            unit: "A",
            truth: arm.coulomb.forward / k,
            third: third.map(|t| t.coulomb_command),
            regression: r.and_then(|r| r.coulomb).map(|e| e.scaled(1.0 / k)),
            output_error: oe
                .and_then(|o| o.estimate(Parameter::Coulomb))
                .map(|e| e.scaled(1.0 / k)),
        },
        Row {
            name: "viscous friction",
            unit: "N·m·s/rad",
            truth: arm.motor.viscous_nm_s_per_rad,
            third: fit.map(|f| f.viscous),
            regression: r.and_then(|r| r.viscous),
            output_error: oe.and_then(|o| o.estimate(Parameter::Viscous)),
        },
        Row {
            name: "inertia",
            unit: "kg·m²",
            truth: arm.motor.inertia_kg_m2,
            third: fit.map(|f| f.inertia),
            regression: r.and_then(|r| r.inertia),
            output_error: oe.and_then(OutputError::inertia),
        },
        Row {
            name: "coupling",
            unit: "N·m/rad",
            truth: arm.dynamics().coupling_motor,
            third: fit.and_then(|f| f.coupling.first().copied()),
            regression: r.and_then(|r| r.coupling.first().copied().flatten()),
            output_error: oe.map(|o| o.figure(ModalArm::coupling_nm_per_rad)),
        },
        Row {
            name: "beam frequency",
            unit: "rad/s",
            truth: arm.beam().natural_frequencies_rad_s()[0],
            third: id.beam_model.as_ref().and_then(|b| b.modes.first()).map(frequency),
            regression: id.beam_regression.as_ref().and_then(|b| b.modes.first()).map(frequency),
            output_error: oe.and_then(|o| o.estimate(Parameter::Frequency(0))),
        },
    ]
}

fn compared(rows: &[Row], result: &ResultFile) -> Value {
    let value = |e: Option<Estimate>| e.map(|e| json!({ "value": e.value, "std": e.std }));
    let figures: Vec<Value> = rows
        .iter()
        .map(|r| {
            json!({
                "figure": r.name,
                "unit": r.unit,
                "true": r.truth,
                "third_harmonic": value(r.third),
                "regression": value(r.regression),
                "output_error": value(r.output_error),
            })
        })
        .collect();
    json!({ "comparison": figures, "result": result })
}

fn report(out: &Path, campaign: &lissom::record::Campaign, id: &Identified, rows: &[Row]) {
    print::campaign(campaign);
    print::runs(id);
    print::line("");
    let head = ["figure", "unit", "true", "third harmonic", "error", "regression", "error"];
    let head = head.into_iter().chain(["output error", "error"]);
    let mut table = vec![head.map(str::to_owned).collect::<Vec<_>>()];
    for r in rows {
        let mut line = vec![r.name.to_owned(), r.unit.to_owned(), significant(r.truth)];
        for (e, digits) in [(r.third, 2), (r.regression, 2), (r.output_error, 4)] {
            match e {
                Some(e) => {
                    line.push(significant(e.value));
                    line.push(format!("{:+.digits$} %", 100.0 * (e.value / r.truth - 1.0)));
                }
                None => line.extend(["refused".to_owned(), String::new()]),
            }
        }
        table.push(line);
    }
    print::table(&table);
    print::verdict(campaign.channels.axis, id);
    print::findings(&id.findings);
    print::line("");
    print::line(&format!(
        "logs, campaign.toml, result.json, report.html and the Bode plots are in {}",
        out.display()
    ));
    print::line(&format!(
        "identify them again with: lissom identify {}",
        out.join("campaign.toml").display()
    ));
}

/// Five significant digits.
fn significant(value: f64) -> String {
    let digits = (4.0 - value.abs().log10().floor()).clamp(0.0, 12.0);
    let digits = digits as usize;
    format!("{value:.digits$}")
}

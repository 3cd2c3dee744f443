//! `lissom figures`: Figures 6, 7 and 8 of the report on a virtual rig.

use std::path::Path;
use std::process::ExitCode;

use lissom::drive::DryFriction;
use lissom::identify::{Estimate, Identified};
use lissom::rig::{JointFriction, Rig};
use lissom_io::write::{self, Batch};
use lissom_io::{ArmFile, PlanFile, UnitNames, read_campaign};
use lissom_report::{LinePlot, Role, Trace};
use serde_json::{Value, json};

use crate::cli::{FiguresArgs, STDOUT};
use crate::failure::Failure;
use crate::reference::Reference;
use crate::{figures, identify, output, print, rig};

const ARM: &str = include_str!("arm.toml");
const PLAN: &str = include_str!("plan.toml");

/// Printed in 6.2.2: classical forward and backward, spectral \[A\].
const PRINTED_A: [f64; 3] = [0.161, 0.152, 0.132];
/// Fastest velocity of the curve in Figure 8 \[rad/s\], and its points.
const FASTEST_RAD_S: f64 = 40.0;
const POINTS: u32 = 400;

pub(crate) fn run(args: &FiguresArgs) -> Result<ExitCode, Failure> {
    let out = &args.out;
    let to_stdout = args.json.as_deref() == Some(Path::new(STDOUT));
    output::guard(args.json.as_deref().filter(|_| !to_stdout), None)?;
    let (arm_path, plan_path) = (out.join("arm.toml"), out.join("plan.toml"));
    write::create_folder(out)?;
    write::write_text(&arm_path, ARM)?;
    write::write_text(&plan_path, PLAN)?;
    let made = ArmFile::read(&arm_path)?.rig(&arm_path).map_err(lissom_io::Error::from)?;
    let plan = PlanFile::read(&plan_path)?;
    let logs = out.join("logs");
    let inputs = rig::Inputs { arm: ARM.to_owned(), plan: PLAN.to_owned() };
    rig::campaign(&made, &plan, &inputs, &logs, None)?;

    let campaign = logs.join("campaign.toml");
    let file = read_campaign(&campaign)?;
    let id = identify::identified(&campaign, &file, None, false)?;
    let channels = &file.campaign.channels;
    let names = UnitNames::new(channels);
    let truth = Reference { label: "theory", ..Reference::truth(&made.arm) };
    let mut batch = Batch::new();
    batch.folder(out)?;
    let bodes = figures::bode_plots(channels, names, &id, Some(&truth));
    for ((_, plot), name) in bodes.iter().zip(["figure-6", "figure-7"]) {
        figures::add(&mut batch, out, name, plot)?;
    }
    if let Some(plot) = figures::friction_plot(channels, names, &id) {
        figures::add(&mut batch, out, "figure-8", &with_truth(plot, &made, &id))?;
    }
    batch.commit()?;
    let rows = rows(&made, &id);
    match args.json.as_deref() {
        Some(_) if to_stdout => print::json(&as_json(&rows)),
        json => {
            if let Some(path) = json {
                write::write_json(path, &as_json(&rows))?;
            }
            report(out, &rows);
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Figure 8 with the joint's own friction and the spectral figure.
fn with_truth(mut plot: LinePlot, rig: &Rig, id: &Identified) -> LinePlot {
    let (motor, beam, law) = (&rig.arm.motor, rig.arm.beam(), law(rig));
    // Turning steadily, the masses' dampers against the fixed frame take their part.
    let dampers = beam.spans().iter().zip(beam.position_m());
    let drag: f64 = dampers.map(|(s, at)| s.damping_n_s_per_m * at * at).sum();
    let viscous = motor.viscous_nm_s_per_rad + drag;
    let speeds: Vec<f64> =
        (0..=POINTS).map(|k| FASTEST_RAD_S * f64::from(k) / f64::from(POINTS)).collect();
    for (label, forward) in [("truth", true), ("", false)] {
        let current = |v: &f64| {
            let dry = law.at(*v, 0.0);
            let dry = if forward { dry.forward } else { dry.backward };
            (dry + viscous * v) / motor.torque_constant_nm_per_a
        };
        let currents = speeds.iter().map(current).collect();
        plot.traces.push(Trace::line(label, Role::Truth, speeds.clone(), currents));
    }
    if let Some(third) = &id.third_harmonic {
        let spectral = third.coulomb_command;
        plot.traces.push(Trace::points_with_bars(
            "spectral, (29)",
            Role::Fitted,
            vec![0.0],
            vec![spectral.value],
            vec![spectral.std],
        ));
    }
    "Friction by steady velocities, and by sines".clone_into(&mut plot.title);
    plot
}

fn law(rig: &Rig) -> DryFriction {
    match rig.scene.friction {
        JointFriction::Dry(law) => law,
        _ => rig.arm.coulomb.into(),
    }
}

/// A figure of Section 6.2.2 \[A\].
struct Row {
    name: &'static str,
    printed_a: Option<f64>,
    here: Option<Estimate>,
}

fn rows(rig: &Rig, id: &Identified) -> Vec<Row> {
    let constant = rig.arm.motor.torque_constant_nm_per_a;
    let classical = id.constant_velocity.as_ref();
    let side = |line: Option<Estimate>| line.map(|e| e.scaled(1.0 / constant));
    let [forward, backward, spectral] = PRINTED_A;
    vec![
        Row {
            name: "classical, forward",
            printed_a: Some(forward),
            here: side(classical.and_then(|c| c.forward.as_ref().ok()).map(|l| l.coulomb)),
        },
        Row {
            name: "classical, backward",
            printed_a: Some(backward),
            here: side(classical.and_then(|c| c.backward.as_ref().ok()).map(|l| l.coulomb)),
        },
        Row {
            name: "spectral, (26)-(29)",
            printed_a: Some(spectral),
            here: id.third_harmonic.as_ref().map(|t| t.coulomb_command),
        },
        Row {
            name: "regression on slip phases",
            printed_a: None,
            here: side(id.regression.as_ref().and_then(|r| r.coulomb)),
        },
        Row {
            name: "truth at rest",
            printed_a: None,
            here: Some(Estimate { value: law(rig).at(0.0, 0.0).forward / constant, std: 0.0 }),
        },
    ]
}

fn as_json(rows: &[Row]) -> Value {
    let row = |r: &Row| {
        json!({
            "figure": r.name,
            "printed_a": r.printed_a,
            "value_a": r.here.map(|e| e.value),
            "std_a": r.here.map(|e| e.std),
        })
    };
    json!({ "coulomb": rows.iter().map(row).collect::<Vec<_>>() })
}

fn report(out: &Path, rows: &[Row]) {
    let head = ["Coulomb friction [A]", "printed in 6.2.2", "here", "deviation"];
    let mut table = vec![head.map(str::to_owned).to_vec()];
    for r in rows {
        let printed = r.printed_a.map_or_else(String::new, |v| format!("{v:.3}"));
        let here = r.here.map_or_else(|| "refused".to_owned(), |e| format!("{:.4}", e.value));
        let std =
            r.here.filter(|e| e.std > 0.0).map_or_else(String::new, |e| format!("{:.4}", e.std));
        table.push(vec![r.name.to_owned(), printed, here, std]);
    }
    print::table(&table);
    print::line("");
    print::line(&format!(
        "figure-6 (motor), figure-7 (beam) and figure-8 (friction) are in {}, the logs in {}",
        out.display(),
        out.join("logs").display()
    ));
}

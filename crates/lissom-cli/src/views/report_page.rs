//! The report page: one self-contained HTML file.

use lissom::identify::{Finding, GeometryCheck, Identified, RunKind, Severity};
use lissom::record::Campaign;
use lissom_io::UnitNames;
use lissom_report::{
    Axis, Band, Cells, Finding as ReportFinding, KeyFigure, LinePlot, Page, Role,
    Severity as ReportSeverity, Table, Trace, significant,
};

use super::parameter_table::{KNOWN_DIGITS, ParameterRow, classical_rows, parameter_rows};
use super::printer::counted;
use super::{
    arm_check, bode_plots, equivalent_table, friction_curve, separability_section,
    velocity_friction,
};
use crate::shared::command_hint::command_hint;
use crate::tasks::known_arm::Reference;

/// The page as HTML.
pub(crate) fn page(
    title: &str,
    campaign: &Campaign,
    names: UnitNames,
    id: &Identified,
    reference: Option<&Reference>,
    described: Option<&GeometryCheck>,
) -> String {
    let refusals = id.findings.iter().filter(|f| f.severity() == Severity::Refusal).count();
    let warnings = id.findings.iter().filter(|f| f.severity() == Severity::Warning).count();
    let summary = format!(
        "{}; {}, {}. Each parameter is given with its standard error and its 95 % interval. The section \
         Findings lists what the data could not determine.",
        counted(id.runs.len(), "run"),
        counted(warnings, "warning"),
        counted(refusals, "refusal")
    );
    let mut page = Page::new(title).summary(&summary).heading("Parameters").key_figures(
        "Drive and beam; 0.1320(12) means 0.1320 ± 0.0012",
        &key_figures(names, id, reference),
    );
    page = separability_section::section(page, names, id);
    let bode = bode_plots::bode_plots(&campaign.channels, names, id, reference);
    if !bode.is_empty() {
        page = page.heading("Frequency responses");
    }
    for (_, plot) in &bode {
        page = page.figure(
            plot,
            "Points: runs, or frequency bands. Line: the model, fitted to the points or computed from the \
             parameters.",
        );
    }
    if let Some(plot) = pairs(names, id) {
        page = page.heading("Third harmonic").figure(
            &plot,
            "Coulomb friction from each pair of runs, at a frequency and at three times this frequency.",
        );
        page = page.table(&pair_table(names, id));
    }
    if let Some(table) = windows(id) {
        page = page
            .heading("Regression in slip phases")
            .paragraph(
                "The window with the smallest sensitivity is chosen. Sensitivity combines the relative \
                 change of the parameters from the next shorter to the next longer window with their \
                 relative standard errors.",
            )
            .table(&table);
    }
    if let Some(plot) = friction_curve::plot(names, id) {
        page = page.heading("Friction against speed").figure(
            &plot,
            "Friction at a few speeds, fitted in slip phases together with the linear terms, without a \
             friction law. Speeds without a slip phase are not drawn. A constant load is included.",
        );
    }
    if let Some(law) = &id.friction_law {
        page = page
            .paragraph(
                "A term is accepted if it describes left-out slip phases better by more than three \
                 standard errors, describes left-out stretches of one kind better as well, reduces the \
                 residual to 0.9 or less, and friction at rest stays positive.",
            )
            .table(&friction_curve::table(names, law));
    }
    if let Some(plot) = velocity_friction::friction_plot(&campaign.channels, names, id) {
        page = page
            .heading("Constant velocity")
            .figure(
                &plot,
                "The command that maintains a velocity, both directions as magnitudes. Solid: straight \
                 lines through the points. Dashed: extrapolated to zero speed.",
            )
            .key_figures("Friction from constant velocities", &constant_velocity_values(names, id))
            .table(&points(names, id));
    }
    page = equivalent_table::section(page, names, id.equivalent.as_ref());
    page = arm_check::section(page, described);
    page.heading("Runs")
        .table(&runs(id))
        .heading("Findings")
        .findings(&id.findings.iter().map(finding).collect::<Vec<_>>())
        .footer(&format!("lissom {}", env!("CARGO_PKG_VERSION")))
        .to_html()
}

fn key_figures(names: UnitNames, id: &Identified, reference: Option<&Reference>) -> Vec<KeyFigure> {
    parameter_rows(names, id, reference)
        .into_iter()
        .map(|row| {
            let note = match (row.known, reference) {
                (Some(known), Some(r)) => {
                    format!("{}: {}", r.label, significant(known, KNOWN_DIGITS))
                }
                _ => String::new(),
            };
            key_figure(row, note)
        })
        .collect()
}

fn key_figure(row: ParameterRow, note: String) -> KeyFigure {
    KeyFigure {
        name: row.name.trim().to_owned(),
        value: row.estimate.map(|e| e.value),
        std: row.estimate.map(|e| e.std),
        ci95: row.estimate.map(|e| e.ci95()),
        unit: row.unit,
        note,
    }
}

fn constant_velocity_values(names: UnitNames, id: &Identified) -> Vec<KeyFigure> {
    let rows = id.constant_velocity.as_ref().map(|c| classical_rows(names, id, c));
    rows.unwrap_or_default().into_iter().map(|row| key_figure(row, String::new())).collect()
}

/// Table of all stretches at a constant velocity.
fn points(names: UnitNames, id: &Identified) -> Table {
    let velocity = format!("velocity ({}/s)", names.angle());
    let command = format!("{} ({})", names.command_name(), names.command_unit());
    let mut table = Table::new(
        "Stretches at a constant velocity",
        &[
            ("run", Cells::Text),
            ("from (s)", Cells::Numbers),
            ("to (s)", Cells::Numbers),
            (&velocity, Cells::Numbers),
            (&command, Cells::Numbers),
            ("standard error", Cells::Numbers),
        ],
    );
    for p in id.constant_velocity.iter().flat_map(|c| &c.points) {
        table = table.row([
            id.runs[p.run].name.clone(),
            format!("{:.3}", p.start_s),
            format!("{:.3}", p.end_s),
            format!("{:.5}", p.velocity.value),
            format!("{:.5}", p.command.value),
            format!("{:.5}", p.command.std),
        ]);
    }
    table
}

fn pairs(names: UnitNames, id: &Identified) -> Option<LinePlot> {
    let third = id.third_harmonic.as_ref()?;
    let mean = third.coulomb_command;
    let [low, high] = mean.ci95();
    let trace = Trace::points_with_bars(
        "each pair",
        Role::Corrected,
        third.pairs.iter().map(|p| p.omega_rad_s).collect(),
        third.pairs.iter().map(|p| p.coulomb_command.value).collect(),
        third.pairs.iter().map(|p| p.coulomb_command.std).collect(),
    )
    .with_flags(third.used.iter().map(|u| !u).collect());
    let unit = names.command_unit();
    let plot = LinePlot::new(
        "Coulomb friction by the third harmonic",
        Axis::log("ω0 (rad/s)"),
        Axis::linear(format!("Coulomb friction ({unit})")),
    )
    .band(Band::new("mean, 95 % interval", Role::Fitted, mean.value, (low, high)))
    .trace(trace);
    Some(plot)
}

fn pair_table(names: UnitNames, id: &Identified) -> Table {
    let unit = names.command_unit();
    let coulomb = format!("Coulomb friction ({unit})");
    let mut table = Table::new(
        "Estimate from each pair, and the minimum of the cost (29)",
        &[
            ("run at ω0", Cells::Text),
            ("run at 3·ω0", Cells::Text),
            ("ω0 (rad/s)", Cells::Numbers),
            (&coulomb, Cells::Numbers),
            ("standard error", Cells::Numbers),
            ("cost", Cells::Numbers),
            ("", Cells::Text),
        ],
    );
    if let Some(third) = &id.third_harmonic {
        for (p, used) in third.pairs.iter().zip(&third.used) {
            table = table.row([
                id.runs[p.run].name.clone(),
                id.runs[p.triple_run].name.clone(),
                format!("{:.4}", p.omega_rad_s),
                format!("{:.5}", p.coulomb_command.value),
                format!("{:.5}", p.coulomb_command.std),
                significant(p.cost, 3),
                (if *used { "" } else { "left out" }).to_owned(),
            ]);
        }
        table = table.row([
            "mean".to_owned(),
            String::new(),
            String::new(),
            format!("{:.5}", third.coulomb_command.value),
            format!("{:.5}", third.coulomb_command.std),
            String::new(),
            format!("spread {:.5}", third.spread_command),
        ]);
    }
    table
}

fn windows(id: &Identified) -> Option<Table> {
    let r = id.regression.as_ref()?;
    let mut table = Table::new(
        "Windows tried",
        &[
            ("window (s)", Cells::Numbers),
            ("rows", Cells::Numbers),
            ("slip phases", Cells::Numbers),
            ("residual torque (%)", Cells::Numbers),
            ("sensitivity (%)", Cells::Numbers),
            ("", Cells::Text),
        ],
    );
    for c in &r.candidates {
        let chosen = (c.window_s - r.window_s).abs() < 1e-12;
        let sensitivity = if c.sensitivity.is_finite() {
            format!("{:.3}", 100.0 * c.sensitivity)
        } else {
            "–".to_owned()
        };
        table = table.row([
            format!("{:.4}", c.window_s),
            c.rows.to_string(),
            c.clusters.to_string(),
            format!("{:.2}", 100.0 * c.relative_residual),
            sensitivity,
            (if chosen { "chosen" } else { "" }).to_owned(),
        ]);
    }
    Some(table)
}

fn runs(id: &Identified) -> Table {
    let mut table = Table::new(
        "Motion of each run",
        &[
            ("run", Cells::Text),
            ("ω0 (rad/s)", Cells::Numbers),
            ("periods used", Cells::Numbers),
            ("periods dropped", Cells::Numbers),
            ("sticking (%)", Cells::Numbers),
            ("saturated (%)", Cells::Numbers),
        ],
    );
    for run in &id.runs {
        let share = |s: f64| format!("{:.1}", 100.0 * s);
        let cells = match &run.kind {
            RunKind::Sinusoidal(s) => [
                run.name.clone(),
                format!("{:.4}", s.omega_rad_s),
                s.steady.periods.to_string(),
                s.steady.dropped.to_string(),
                run.stuck_share.map_or_else(String::new, share),
                share(run.saturated_share),
            ],
            RunKind::ConstantVelocity => [
                run.name.clone(),
                format!("constant velocities ({})", run.steady.len()),
                String::new(),
                String::new(),
                String::new(),
                share(run.saturated_share),
            ],
            RunKind::General => [
                run.name.clone(),
                "other motion".to_owned(),
                String::new(),
                String::new(),
                String::new(),
                share(run.saturated_share),
            ],
        };
        table = table.row(cells);
    }
    table
}

fn finding(f: &Finding) -> ReportFinding {
    let severity = match f.severity() {
        Severity::Info => ReportSeverity::Info,
        Severity::Warning => ReportSeverity::Warning,
        Severity::Refusal => ReportSeverity::Refusal,
    };
    let mut finding = ReportFinding::new(severity, f.code(), f.message());
    finding.run.clone_from(&f.run);
    finding.affects = f.affects().into_iter().map(str::to_owned).collect();
    let hints: Vec<&str> = [f.hint()].into_iter().chain(command_hint(&f.kind)).collect();
    let hint = hints.join("; ");
    if hint.is_empty() { finding } else { finding.hint(hint) }
}

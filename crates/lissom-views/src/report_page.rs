//! The report page: one self-contained HTML document.

use lissom::identify::{Finding, GeometryCheck, Identified, Severity};
use lissom::record::Campaign;
use lissom_io::UnitNames;
use lissom_report::{
    Finding as ReportFinding, KeyFigure, Page, Severity as ReportSeverity, significant,
};

use crate::digits::counted;
use crate::known_arm::Reference;
use crate::parameter_rows::{KNOWN_DIGITS, ParameterRow, classical_rows, parameter_rows};
use crate::program_hints::ProgramHints;
use crate::run_table::run_table;
use crate::slip_windows::window_table;
use crate::velocity_friction::{friction_plot, stretch_table};
use crate::{
    arm_check, bode_plots, equivalent_section, friction_curve, separability_section, third_harmonic,
};

/// The page as HTML. `reference` adds the parameters of a known arm, `described` the comparison with its dimensions.
/// `hints` names what helps in the program that makes the page.
pub fn page(
    title: &str,
    campaign: &Campaign,
    id: &Identified,
    reference: Option<&Reference>,
    described: Option<&GeometryCheck>,
    hints: ProgramHints,
) -> String {
    let names = UnitNames::new(&campaign.channels);
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
    if let Some(plot) = third_harmonic::pair_plot(names, id) {
        page = page.heading("Third harmonic").figure(
            &plot,
            "Coulomb friction from each pair of runs, at a frequency and at three times this frequency.",
        );
        page = page.table(&third_harmonic::pair_table(names, id));
    }
    if let Some(table) = window_table(id) {
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
    if let Some(plot) = friction_plot(&campaign.channels, names, id) {
        page = page
            .heading("Constant velocity")
            .figure(
                &plot,
                "The command that maintains a velocity, both directions as magnitudes. Solid: straight \
                 lines through the points. Dashed: extrapolated to zero speed.",
            )
            .key_figures("Friction from constant velocities", &constant_velocity_values(names, id))
            .table(&stretch_table(names, id));
    }
    let intervals = hints.equivalent_intervals;
    page = equivalent_section::section(page, names, id.equivalent.as_ref(), intervals);
    page = arm_check::section(page, described);
    page.heading("Runs")
        .table(&run_table(id))
        .heading("Findings")
        .findings(&id.findings.iter().map(|f| finding(f, hints)).collect::<Vec<_>>())
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

fn finding(f: &Finding, hints: ProgramHints) -> ReportFinding {
    let severity = match f.severity() {
        Severity::Info => ReportSeverity::Info,
        Severity::Warning => ReportSeverity::Warning,
        Severity::Refusal => ReportSeverity::Refusal,
    };
    let mut finding = ReportFinding::new(severity, f.code(), f.message());
    finding.run.clone_from(&f.run);
    finding.affects = f.affects().into_iter().map(str::to_owned).collect();
    let hints: Vec<&str> = [f.hint()].into_iter().chain((hints.of_finding)(&f.kind)).collect();
    let hint = hints.join("; ");
    if hint.is_empty() { finding } else { finding.hint(hint) }
}

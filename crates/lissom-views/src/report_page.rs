//! The report page: one self-contained HTML document.

use lissom::identify::{Finding, GeometryCheck, Identified, LogPrediction, Severity};
use lissom::record::Campaign;
use lissom_io::UnitNames;
use lissom_report::{
    Finding as ReportFinding, KeyFigure, Page, Severity as ReportSeverity, significant,
    with_uncertainty,
};

use crate::digits::counted;
use crate::known_arm::Reference;
use crate::parameter_rows::{KNOWN_DIGITS, ParameterRow, classical_rows, parameter_rows};
use crate::program_hints::ProgramHints;
use crate::run_table::run_table;
use crate::slip_windows::window_table;
use crate::validation_plots::correlation_figures;
use crate::velocity_friction::{friction_plot, stretch_table};
use crate::{
    arm_check, bode_plots, equivalent_section, friction_curve, own_logs, pole_zero_map,
    separability_section, third_harmonic,
};

/// Most parameters in the summary.
const MAIN_PARAMETERS: usize = 6;
/// Most findings in the summary.
const MAIN_FINDINGS: usize = 3;

/// The page of a result. `own` is the prediction of the campaign itself, see [`own_logs()`](crate::own_logs()). `reference`
/// adds the parameters of a known arm, `described` the comparison with its dimensions.
/// `hints` names what helps in the program that makes the page.
pub fn page(
    title: &str,
    campaign: &Campaign,
    id: &Identified,
    own: Option<&LogPrediction>,
    reference: Option<&Reference>,
    described: Option<&GeometryCheck>,
    hints: ProgramHints,
) -> Page {
    let names = UnitNames::new(&campaign.channels);
    let rows = parameter_rows(names, id, reference);
    let findings: Vec<ReportFinding> = id.findings.iter().map(|f| finding(f, hints)).collect();
    let main: Vec<ReportFinding> = main_findings(&findings);
    let mut page = Page::new(title).summary(&in_words(id, &rows));
    if !main.is_empty() {
        page = page.main_findings(&main);
    }
    page = page.contents().heading("Parameters").key_figures(
        "Drive and beam; 0.1320(12) means 0.1320 ± 0.0012",
        &key_figures(id, rows, reference),
    );
    page = separability_section::section(page, names, id);
    page = motion_section(page, campaign, id, own);
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
    let maps = pole_zero_map::maps(&campaign.channels, id);
    if !maps.is_empty() {
        page = page.gallery(
            "response of",
            &maps,
            "Of the linear models, without dry friction and delays.",
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
        .findings(&findings)
        .footer(&format!("lissom {}", env!("CARGO_PKG_VERSION")))
}

/// Adds what the result says about its own logs.
fn motion_section(
    mut page: Page,
    campaign: &Campaign,
    id: &Identified,
    own: Option<&LogPrediction>,
) -> Page {
    if let Some(own) = own {
        let motion = own_logs::motion_figures(campaign, own);
        if !motion.is_empty() {
            page = page.heading("Measured and predicted motion").gallery(
                "run",
                &motion,
                "The motion that the identified arm makes of the logged command, and the terms of the torque, averaged with a \
                 short window; no prediction while the motor rests. The run with the largest residual torque comes first.",
            );
        }
        let cycles = own_logs::cycle_figures(campaign, id, own);
        if !cycles.is_empty() {
            page = page.heading("One cycle with its friction").gallery(
                "run",
                &cycles,
                "Friction is that of the identified arm at the logged speed, viscous friction included.",
            );
        }
        let residuals = correlation_figures(campaign, own);
        if !residuals.is_empty() {
            page = page.heading("Residuals").gallery(
                "plot",
                &residuals,
                "The residual of a complete model is noise: it is not correlated with itself or with the command beyond the \
                 bands.",
            );
        }
    }
    let harmonics = own_logs::harmonic_figures(id);
    if harmonics.is_empty() {
        return page;
    }
    page.heading("Harmonics").gallery(
        "run",
        &harmonics,
        "Dry friction makes odd harmonics. Bars: one standard error.",
    )
}

/// The result in two sentences: the most important parameters, and how many findings there are.
fn in_words(id: &Identified, rows: &[ParameterRow]) -> String {
    let main = rows.iter().filter(|row| !row.name.starts_with(' '));
    let estimates = main.filter_map(|row| {
        let estimate = row.estimate?;
        let unit = if row.unit == "–" || row.unit == "1" { "" } else { row.unit.as_str() };
        let value = with_uncertainty(estimate.value, estimate.std);
        Some(format!("{} {value} {unit}", row.name).trim_end().to_owned())
    });
    let given: Vec<String> = estimates.take(MAIN_PARAMETERS).collect();
    let count = |severity| id.findings.iter().filter(|f| f.severity() == severity).count();
    let runs = counted(id.runs.len(), "run");
    let what = if given.is_empty() {
        format!("{runs} do not determine friction and inertia")
    } else {
        format!("{}, from {runs}", given.join(", "))
    };
    let mut letters = what.chars();
    let what = letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().collect::<String>() + letters.as_str()
    });
    format!(
        "{what}. {} and {}.",
        counted(count(Severity::Warning), "warning"),
        counted(count(Severity::Refusal), "refusal")
    )
}

/// The findings to know first: refusals, then warnings, each kind once.
fn main_findings(findings: &[ReportFinding]) -> Vec<ReportFinding> {
    let mut main: Vec<ReportFinding> = Vec::new();
    for severity in [ReportSeverity::Refusal, ReportSeverity::Warning] {
        for finding in findings.iter().filter(|finding| finding.severity == severity) {
            if main.iter().all(|known| known.code != finding.code) {
                main.push(finding.clone());
            }
        }
    }
    main.truncate(MAIN_FINDINGS);
    main
}

fn key_figures(
    id: &Identified,
    rows: Vec<ParameterRow>,
    reference: Option<&Reference>,
) -> Vec<KeyFigure> {
    let figure = |row: ParameterRow| {
        let note = match (row.known, reference) {
            (Some(known), Some(r)) => {
                format!("{}: {}", r.label, significant(known, KNOWN_DIGITS))
            }
            _ => String::new(),
        };
        let doubted_by = doubted_by(id, row.key);
        KeyFigure { doubted_by, ..key_figure(row, note) }
    };
    rows.into_iter().map(figure).collect()
}

/// Codes of the warnings and refusals that affect a key of the result.
fn doubted_by(id: &Identified, key: &str) -> Vec<String> {
    let mut codes: Vec<String> = Vec::new();
    for finding in id.findings.iter().filter(|f| f.severity() != Severity::Info) {
        let is_new = !codes.iter().any(|code| code == finding.code());
        if is_new && finding.affects().contains(&key) {
            codes.push(finding.code().to_owned());
        }
    }
    codes
}

fn key_figure(row: ParameterRow, note: String) -> KeyFigure {
    KeyFigure {
        name: row.name.trim().to_owned(),
        value: row.estimate.map(|e| e.value),
        std: row.estimate.map(|e| e.std),
        ci95: row.estimate.map(|e| e.ci95()),
        unit: row.unit,
        known: row.known,
        note,
        ..KeyFigure::default()
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

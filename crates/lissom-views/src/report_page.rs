//! The report page: one self-contained HTML document.

use std::collections::HashSet;

use lissom::identify::{LogPrediction, Severity};
use lissom::record::Campaign;
use lissom_io::result::FindingEntry;
use lissom_io::{ResultFile, UnitNames};
use lissom_report::{
    BodePlot, Finding as ReportFinding, KeyFigure, Page, Role, Severity as ReportSeverity,
    significant, with_uncertainty,
};

use crate::digits::counted;
use crate::friction_speeds::friction_speeds_words;
use crate::known_arm::Reference;
use crate::parameter_rows::{KNOWN_DIGITS, ParameterRow, classical_rows, parameter_rows};
use crate::program_hints::ProgramHints;
use crate::run_table::run_table;
use crate::slip_windows::window_table;
use crate::unused_torque::unused_torque_words;
use crate::validation_plots::correlation_figures;
use crate::velocity_friction::{friction_plot, stretch_table};
use crate::{
    arm_check, bode_plots, equivalent_section, friction_curve, own_logs, pole_zero_map,
    separability_section, third_harmonic,
};

/// Most parameters in the summary.
const MAIN_PARAMETERS: usize = 6;
/// Why the line of a model has no band.
const NO_BAND: &str =
    " No band: the data do not determine the standard errors of all coefficients.";
/// Most findings in the summary.
const MAIN_FINDINGS: usize = 3;

/// What a page is made of.
#[derive(Debug, Clone, Copy)]
pub struct PageContent<'a> {
    /// The result, as `result.json` has it.
    pub result: &'a ResultFile,
    /// Logs with what the arm of the result predicts of them, see [`own_logs()`](crate::own_logs()).
    pub logs: Option<(&'a Campaign, &'a LogPrediction)>,
    /// A known arm, whose parameters are compared.
    pub reference: Option<&'a Reference>,
    /// What helps in the program that makes the page.
    pub hints: &'a ProgramHints,
}

/// The page of a result. Only what is predicted of logs is not in `result.json`.
pub fn page(title: &str, content: PageContent<'_>) -> Page {
    let page = Page::new(title);
    let PageContent { result, logs, reference, hints } = content;
    let names = result.names();
    let rows = parameter_rows(names, result, reference);
    let findings = result.findings.iter().enumerate();
    let findings: Vec<ReportFinding> = findings.map(|(k, f)| finding(f, hints.of(k))).collect();
    let main: Vec<ReportFinding> = main_findings(&findings, &rows);
    let mut page = page.summary(&in_words(result, &rows));
    if !main.is_empty() {
        page = page.main_findings(&main);
    }
    page = page.contents().heading("Parameters").key_figures(
        "Drive and beam; 0.1320(12) means 0.1320 ± 0.0012",
        &key_figures(result, rows, reference),
    );
    if let Some(words) = unused_torque_words(result) {
        page = page.paragraph(&format!("Unused {words}."));
    }
    let speeds = friction_speeds_words(result);
    if !speeds.is_empty() {
        page = page.paragraph(&format!("{}.", speeds.join(". ")));
    }
    page = separability_section::section(page, result);
    page = motion_section(page, result, logs);
    page = response_section(page, names, result, reference);
    if let Some(plot) = third_harmonic::pair_plot(names, result) {
        page = page.heading("Third harmonic").figure(
            &plot,
            "Coulomb friction from each pair of runs, at a frequency and at three times this frequency.",
        );
        if let Some(plot) = third_harmonic::pair_plot_over_amplitude(names, result) {
            page = page.figure(
                &plot,
                "The same over the amplitude of the motor in the run at the lower frequency. An estimate that changes by \
                 more than its bars shows friction that is not Coulomb friction alone.",
            );
        }
        page = page.table(&third_harmonic::pair_table(names, result));
    }
    if let Some(table) = window_table(result) {
        page = page
            .heading("Regression in slip phases")
            .paragraph(
                "The window with the smallest sensitivity is chosen. Sensitivity combines the relative \
                 change of the parameters from the next shorter to the next longer window with their \
                 relative standard errors.",
            )
            .table(&table);
    }
    if let Some(plot) = friction_curve::plot(names, result) {
        page = page.heading("Friction against speed").figure(
            &plot,
            "Friction at a few speeds, fitted in slip phases together with the linear terms, without a \
             friction law. Speeds without a slip phase are not drawn. A constant load is included.",
        );
    }
    if let Some(law) = &result.methods.friction_law {
        page = page
            .paragraph(
                "A term is adopted if the model with it predicts blocks of the logs that were left out of the \
                 fit better, by two standard errors and a twentieth of their squared residual, and kinds of \
                 motion that were left out as well, and if a joint may have it: friction at rest stays positive.",
            )
            .table(&friction_curve::table(law));
    }
    if let Some(plot) = friction_plot(names, result) {
        page = page
            .heading("Constant velocity")
            .figure(
                &plot,
                "The command that maintains a velocity, both directions as magnitudes. Solid: straight \
                 lines through the points. Dashed: extrapolated to zero speed.",
            )
            .key_figures("Friction from constant velocities", &constant_velocity_values(result))
            .table(&stretch_table(names, result));
    }
    let intervals = hints.equivalent_intervals;
    page = equivalent_section::section(page, names, result.equivalent.as_ref(), intervals);
    page = arm_check::section(page, result.geometry.as_ref());
    page.heading("Runs")
        .table(&run_table(result))
        .heading("Findings")
        .findings(&findings)
        .footer(&format!("lissom {}", result.lissom))
}

/// Adds what the result says about logs.
fn motion_section(
    mut page: Page,
    result: &ResultFile,
    logs: Option<(&Campaign, &LogPrediction)>,
) -> Page {
    if let Some((campaign, own)) = logs {
        let others = own_logs::other_runs(campaign, result);
        if !others.is_empty() {
            page = page.heading("Logs of this page").paragraph(&format!(
                "The result is not from these runs, which its arm predicts: {}.",
                others.join(", ")
            ));
        }
        let motion = own_logs::motion_figures(campaign, own);
        if !motion.is_empty() {
            page = page.heading("Measured and predicted motion").gallery(
                "run",
                &motion,
                "The motion that the identified arm makes of the logged command: it starts from a fitted state, again after the \
                 longest time over which all runs fit. The terms of the torque are averaged with a short window; there is no \
                 prediction of it while the motor rests. The run with the largest residual torque comes first.",
            );
        }
        let cycles = own_logs::cycle_figures(campaign, result, own);
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
                 bands. A simulated position adds up small errors of the torque: bars near one at all lags show slow drift, and \
                 the figures of the motion show how large it is.",
            );
        }
    }
    let harmonics = own_logs::harmonic_figures(result);
    if harmonics.is_empty() {
        return page;
    }
    page.heading("Harmonics").gallery(
        "run",
        &harmonics,
        "Dry friction makes odd harmonics. Bars: one standard error.",
    )
}

/// What to know of the band of a plot's model.
fn of_band(plot: &BodePlot, result: &ResultFile) -> String {
    let doubted_by = result.verdict.as_ref().map_or(&[][..], |verdict| &verdict.doubted_by);
    let Some(model) = plot.series.iter().find(|series| series.role == Role::Fitted) else {
        return String::new();
    };
    if model.band.is_none() {
        NO_BAND.to_owned()
    } else if doubted_by.is_empty() {
        String::new()
    } else {
        format!(" The band does not count what the model lacks ({}).", doubted_by.join(", "))
    }
}

/// Bode plots, and the poles and zeros of their models.
fn response_section(
    mut page: Page,
    names: UnitNames,
    result: &ResultFile,
    reference: Option<&Reference>,
) -> Page {
    let bode = bode_plots::bode_plots(names, result, reference);
    if !bode.is_empty() {
        page = page.heading("Frequency responses");
    }
    for (_, plot) in &bode {
        let of_band = of_band(plot, result);
        page = page.figure(
            plot,
            &format!(
                "Points: runs, or frequency bands. Line: the model, fitted to the points or computed from the \
                 parameters.{of_band}"
            ),
        );
    }
    let maps = pole_zero_map::maps(result).into_iter().map(|(_, name, plot)| (name, plot));
    let maps: Vec<_> = maps.collect();
    if !maps.is_empty() {
        page = page.gallery(
            "response of",
            &maps,
            "Of the linear models, without dry friction and delays.",
        );
    }
    page
}

/// The result in two sentences: the most important parameters, and how many findings there are.
fn in_words(result: &ResultFile, rows: &[ParameterRow]) -> String {
    let main = rows.iter().filter(|row| !row.name.starts_with(' '));
    let estimates = main.filter_map(|row| {
        let estimate = row.estimate?;
        let unit = if row.unit == "–" || row.unit == "1" { "" } else { row.unit.as_str() };
        let value = with_uncertainty(estimate.value, estimate.std);
        Some(format!("{} {value} {unit}", row.name).trim_end().to_owned())
    });
    let given: Vec<String> = estimates.take(MAIN_PARAMETERS).collect();
    let count = |severity| result.findings.iter().filter(|f| f.severity == severity).count();
    let runs = counted(result.runs.len(), "run");
    let what = if given.is_empty() {
        let verb = if result.runs.len() == 1 { "does" } else { "do" };
        format!("{runs} {verb} not determine friction and inertia")
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

/// The findings to know first, in the order of the result, which has causes before what follows from them; those that
/// affect none of `rows` last. The first refusal always has a place. Infos, of the rows alone, only where there is nothing
/// else.
fn main_findings(findings: &[ReportFinding], rows: &[ParameterRow]) -> Vec<ReportFinding> {
    // What names no estimate is about all.
    let of_rows = |f: &ReportFinding| {
        f.affects.is_empty() || rows.iter().any(|row| f.affects.iter().any(|a| a == row.key))
    };
    let is_info = |f: &&ReportFinding| f.severity == ReportSeverity::Info;
    let mut main: Vec<&ReportFinding> = findings.iter().filter(|f| !is_info(f)).collect();
    if main.is_empty() {
        main = findings.iter().filter(|f| of_rows(f)).collect();
    }
    main.sort_by_key(|f| !of_rows(f));
    let mut codes = HashSet::new();
    main.retain(|f| codes.insert(&f.code));
    let refused = main.iter().position(|f| f.severity == ReportSeverity::Refusal);
    if let Some(refusal) = refused.filter(|at| *at >= MAIN_FINDINGS) {
        main.swap(refusal, MAIN_FINDINGS - 1);
    }
    main.into_iter().take(MAIN_FINDINGS).cloned().collect()
}

fn key_figures(
    result: &ResultFile,
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
        let doubted_by = doubted_by(result, row.key);
        KeyFigure { doubted_by, ..key_figure(row, note) }
    };
    rows.into_iter().map(figure).collect()
}

/// Codes of the warnings and refusals that affect a key of the result.
fn doubted_by(result: &ResultFile, key: &str) -> Vec<String> {
    let mut codes: Vec<String> = Vec::new();
    for finding in result.findings.iter().filter(|f| f.severity != Severity::Info) {
        let is_new = !codes.contains(&finding.code);
        if is_new && finding.affects.iter().any(|affected| affected == key) {
            codes.push(finding.code.clone());
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

fn constant_velocity_values(result: &ResultFile) -> Vec<KeyFigure> {
    let found = result.methods.constant_velocity.as_ref();
    let rows = found.map(|found| classical_rows(result, found));
    rows.unwrap_or_default().into_iter().map(|row| key_figure(row, String::new())).collect()
}

fn finding(f: &FindingEntry, hint: Option<&str>) -> ReportFinding {
    let severity = match f.severity {
        Severity::Info => ReportSeverity::Info,
        Severity::Warning => ReportSeverity::Warning,
        Severity::Refusal => ReportSeverity::Refusal,
    };
    let mut finding = ReportFinding::new(severity, f.code.clone(), f.message.clone());
    finding.run.clone_from(&f.run);
    finding.affects.clone_from(&f.affects);
    let hints: Vec<&str> = [f.hint.as_str()].into_iter().chain(hint).collect();
    let hint = hints.join("; ");
    if hint.is_empty() { finding } else { finding.hint(hint) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(key: &'static str) -> ParameterRow {
        ParameterRow { name: key.to_owned(), key, estimate: None, unit: String::new(), known: None }
    }

    fn codes(findings: &[(ReportSeverity, &str, &str)]) -> Vec<String> {
        let of = |(severity, code, affects): &(ReportSeverity, &str, &str)| {
            let mut finding = ReportFinding::new(*severity, *code, "");
            finding.affects = vec![(*affects).to_owned()];
            finding
        };
        let findings: Vec<ReportFinding> = findings.iter().map(of).collect();
        main_findings(&findings, &[row("inertia")]).into_iter().map(|f| f.code).collect()
    }

    #[test]
    fn causes_come_first_and_a_refusal_has_a_place() {
        use ReportSeverity::{Info, Refusal, Warning};
        let found = [
            (Warning, "elsewhere", "curve"),
            (Warning, "cause", "inertia"),
            (Warning, "cause", "inertia"),
            (Warning, "second", "inertia"),
            (Warning, "third", "inertia"),
            (Refusal, "refused", "inertia"),
            (Info, "known", "inertia"),
        ];
        assert_eq!(codes(&found), ["cause", "second", "refused"]);
        assert_eq!(codes(&found[..2]), ["cause", "elsewhere"]);
        // Infos only where there is nothing else, and of the parameters alone.
        assert_eq!(codes(&[(Info, "other", "curve"), (Info, "known", "inertia")]), ["known"]);
    }
}

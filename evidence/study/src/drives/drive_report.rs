//! The results of a study of drives as markdown.

use std::collections::BTreeMap;

use super::drive_parameter::DriveParameter;
use super::drive_score::{DriveScore, FoundCode, ParameterScore};
use super::drive_study::{DriveOutcome, DriveStudyPlan};
use super::effects::{Cause, DriveStudy, Effects, Input};
use crate::statistics::{Share, median};
use crate::tables::table;

/// Largest bound of a parameter that is counted, relative to its value \[1\].
const BOUND_MOST: f64 = 0.05;
/// Length of the list of silently wrong parameters.
const WORST: usize = 40;

/// A campaign and its score.
type Scored<'a> = (&'a DriveOutcome, &'a DriveScore);

/// A parameter and its campaign.
type One<'a> = (&'a DriveOutcome, &'a ParameterScore);

/// The page of a study.
pub fn drive_report(plan: &DriveStudyPlan, outcomes: &[Option<DriveOutcome>]) -> String {
    let drawn: Vec<&DriveOutcome> = outcomes.iter().flatten().collect();
    let all: Vec<Scored<'_>> =
        drawn.iter().filter_map(|o| Some((*o, o.score.as_ref().ok()?))).collect();
    let failed = drawn.iter().filter_map(|o| Some((o.index, o.score.as_ref().err()?)));
    let mut sections = vec![format!(
        "# Drives: `{}`\n\n{} campaigns of seed {}: `cargo xtask study --drives {} --campaigns {} --seed {}{}`. {} campaigns could \
         not be drawn, {} draws were rejected. Simulation {:.0} s, identification {:.0} s.",
        plan.study,
        drawn.len(),
        plan.seed,
        plan.study,
        plan.campaigns,
        plan.seed,
        if plan.quick { " --quick" } else { "" },
        outcomes.len() - drawn.len(),
        drawn.iter().map(|o| o.rejected.len()).sum::<usize>(),
        drawn.iter().map(|o| o.simulation.as_secs_f64()).sum::<f64>(),
        drawn.iter().map(|o| o.identification.as_secs_f64()).sum::<f64>(),
    )];
    let failed: Vec<String> = failed.map(|(i, why)| format!("- {i}: {why}")).collect();
    if !failed.is_empty() {
        sections.push(format!("## Nothing identified\n\n{}", failed.join("\n")));
    }
    match plan.study {
        DriveStudy::Real => sections.extend(real(&all)),
        DriveStudy::Causes => sections.extend(causes(&all)),
    }
    sections.push(worst(&all));
    sections.join("\n\n") + "\n"
}

fn parameters<'a>(all: &[Scored<'a>]) -> Vec<One<'a>> {
    all.iter().flat_map(|(o, s)| s.parameters.iter().map(move |p| (*o, p))).collect()
}

/// Whether the logs can determine a parameter to 5 %.
fn counts(p: &ParameterScore) -> bool {
    p.bound_share().is_some_and(|share| share < BOUND_MOST)
}

/// A condition on a parameter.
type Is<'f> = &'f dyn Fn(&ParameterScore) -> bool;

/// The header of [`Real::row`].
const HEADER: [&str; 10] = [
    "",
    "parameters",
    "bound below 5 %",
    "given without a warning",
    "within 5 standard errors",
    "95 % intervals that contain the truth",
    "the same, with the wander of the runs",
    "\\|error\\|, median",
    "standard error / bound, median",
    "refused",
];

/// The parameters of a study, and the condition for "given without a warning".
struct Real<'a> {
    every: Vec<One<'a>>,
    vouched: Is<'a>,
}

impl Real<'_> {
    fn row(&self, name: String, of: impl Fn(&One<'_>) -> bool) -> Vec<String> {
        let total: Vec<&One<'_>> = self.every.iter().filter(|one| of(one)).collect();
        let mine: Vec<&ParameterScore> =
            total.iter().map(|(_, p)| *p).filter(|p| counts(p)).collect();
        let vouched: Vec<&ParameterScore> =
            mine.iter().copied().filter(|p| (self.vouched)(p)).collect();
        let errors: Vec<f64> = vouched.iter().filter_map(|p| p.error()).map(f64::abs).collect();
        let over: Vec<f64> = vouched.iter().filter_map(|p| p.over_bound()).collect();
        vec![
            name,
            total.len().to_string(),
            mine.len().to_string(),
            Share::count(&mine, |p| (self.vouched)(p)).to_string(),
            Share::count(&vouched, |p| !p.is_wrong()).to_string(),
            Share::count(&vouched, |p| p.covers() == Some(true)).to_string(),
            Share::count(&vouched, |p| p.covers_as_fell() == Some(true)).to_string(),
            median(&errors).map_or_else(String::new, |e| format!("{:.2} %", 100.0 * e)),
            median(&over).map_or_else(String::new, |r| format!("{r:.1}")),
            mine.iter().filter(|p| p.estimate.is_none()).count().to_string(),
        ]
    }

    /// All parameters, and each kind of them.
    fn kinds(&self) -> String {
        let mut rows = vec![self.row("all".to_owned(), |_| true)];
        for parameter in DriveParameter::ALL {
            rows.push(self.row(parameter.to_string(), |(_, p)| p.parameter == parameter));
        }
        table(&HEADER, &rows)
    }

    fn effects(&self) -> String {
        let mut rows = Vec::new();
        for name in Effects::NAMES {
            for there in [true, false] {
                let label = format!("{}{name}", if there { "" } else { "no " });
                let is = |(o, _): &One<'_>| o.effects.names().contains(&name) == there;
                if self.every.iter().any(is) {
                    rows.push(self.row(label, is));
                }
            }
        }
        for low in [true, false] {
            let label = format!("noise {} 1 %", if low { "below" } else { "above" });
            rows.push(self.row(label, |(o, _)| match o.effects.input {
                Input::Measured { noise_share, .. } => (noise_share < 0.01) == low,
                Input::Held => false,
            }));
        }
        table(&HEADER, &rows)
    }
}

fn real(all: &[Scored<'_>]) -> Vec<String> {
    let every = parameters(all);
    let counted: Vec<One<'_>> = every.iter().copied().filter(|(_, p)| counts(p)).collect();
    let strict = Real { every: every.clone(), vouched: &ParameterScore::vouched };
    let aside = Real { every, vouched: &ParameterScore::vouched_but_for_law };
    let goals = format!(
        "## Goals\n\nOf the parameters whose bound is below 5 %, 80 % are given without a warning. Of these, 99 % are within \
         five standard errors, and 90 to 99 % of the 95 % intervals contain the truth. The columns after the bound count \
         only parameters whose bound is below 5 %.\n\n{}",
        strict.kinds()
    );
    let law = format!(
        "## The same without `friction-law`\n\nThis finding warns about Coulomb and viscous friction whenever the result has a \
         friction law with further terms. Here it does not count as a warning.\n\n{}",
        aside.kinds()
    );
    let effects = format!(
        "## By effect\n\n`friction-law` does not count as a warning.\n\n{}",
        aside.effects()
    );
    vec![goals, law, effects, blockers(&counted)]
}

/// The findings that affect the counted parameters.
fn blockers(counted: &[One<'_>]) -> String {
    let mut by_code: BTreeMap<&str, BTreeMap<String, usize>> = BTreeMap::new();
    let mut alone: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, p) in counted.iter().filter(|(_, p)| !p.vouched()) {
        let mut codes = p.warned_by.clone();
        codes.sort_unstable();
        codes.dedup();
        if codes.is_empty() {
            codes.push("(no finding)");
        }
        if let [only] = codes[..] {
            *alone.entry(only).or_default() += 1;
        }
        for code in codes {
            *by_code.entry(code).or_default().entry(p.parameter.to_string()).or_default() += 1;
        }
    }
    let rows: Vec<Vec<String>> = by_code
        .iter()
        .map(|(code, of)| {
            let mut cells = vec![format!("`{code}`")];
            cells.extend(
                DriveParameter::ALL
                    .map(|p| of.get(&p.to_string()).map_or_else(String::new, usize::to_string)),
            );
            cells.push(alone.get(code).map_or_else(String::new, usize::to_string));
            cells
        })
        .collect();
    let mut header = vec!["finding".to_owned()];
    header.extend(DriveParameter::ALL.map(|p| p.to_string()));
    header.push("as the only one".to_owned());
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    format!(
        "## Warnings and refusals of parameters whose bound is below 5 %\n\n{}",
        table(&header, &rows)
    )
}

fn causes(all: &[Scored<'_>]) -> Vec<String> {
    let of = |cause: Cause| -> Vec<Scored<'_>> {
        all.iter().copied().filter(|(o, _)| o.cause == Some(cause)).collect()
    };
    let label = |s: &DriveScore| match s.first() {
        None => "nothing".to_owned(),
        Some(f) if f.warns() => f.label(),
        Some(f) => format!("info: {}", f.label()),
    };
    let confusion = counted_codes(all, |s| vec![label(s)]);
    let any = counted_codes(all, |s| {
        let mut codes: Vec<String> =
            s.findings.iter().filter(|f| f.warns()).map(FoundCode::label).collect();
        codes.sort_unstable();
        codes.dedup();
        codes
    });
    let infos = counted_codes(all, |s| {
        let mut codes: Vec<String> =
            s.findings.iter().filter(|f| !f.warns()).map(FoundCode::label).collect();
        codes.sort_unstable();
        codes.dedup();
        codes
    });
    let rows: Vec<Vec<String>> = Cause::ALL
        .into_iter()
        .map(|cause| {
            let mine = of(cause);
            let every = parameters(&mine);
            let given: Vec<&ParameterScore> =
                every.iter().map(|(_, p)| *p).filter(|p| p.estimate.is_some()).collect();
            let vouched: Vec<&ParameterScore> =
                given.iter().copied().filter(|p| p.vouched()).collect();
            let off: Vec<f64> =
                vouched.iter().filter_map(|p| p.standard_errors()).map(f64::abs).collect();
            let silent = mine
                .iter()
                .filter(|(_, s)| s.parameters.iter().any(ParameterScore::silently_wrong));
            let by = |p: DriveParameter| {
                vouched.iter().filter(|s| s.parameter == p && s.silently_wrong()).count()
            };
            let mut cells = vec![
                cause.to_string(),
                mine.len().to_string(),
                Share::count(&mine, |(_, s)| !s.warns()).to_string(),
                every.iter().filter(|(_, p)| p.estimate.is_none()).count().to_string(),
                vouched.len().to_string(),
                median(&off).map_or_else(String::new, |m| format!("{m:.2}")),
                Share::count(&vouched, |p| p.covers() == Some(true)).to_string(),
                silent.count().to_string(),
            ];
            cells.extend(DriveParameter::ALL.map(|p| by(p).to_string()));
            cells
        })
        .collect();
    let header = [
        "cause",
        "campaigns",
        "without a warning",
        "parameters refused",
        "given without a warning",
        "\\|error\\| / standard error, median",
        "95 % intervals that contain the truth",
        "campaigns silently wrong",
        "coulomb",
        "viscous",
        "inertia",
        "gravity",
        "load",
    ];
    vec![
        format!(
            "## By cause\n\nSilently wrong: more than five standard errors off without a warning.\n\n{}",
            table(&header, &rows)
        ),
        format!(
            "## The first finding\n\nThe finding at the top of the list: causes come before their consequences.\n\n{confusion}"
        ),
        format!("## Warnings and refusals\n\nNumber of campaigns with each of them.\n\n{any}"),
        format!("## Information\n\nNumber of campaigns with each of them.\n\n{infos}"),
    ]
}

/// A table of codes by cause.
fn counted_codes(all: &[Scored<'_>], codes: impl Fn(&DriveScore) -> Vec<String>) -> String {
    let mut by_code: BTreeMap<String, [usize; Cause::ALL.len()]> = BTreeMap::new();
    for (outcome, score) in all {
        let at = outcome.index % Cause::ALL.len();
        for code in codes(score) {
            by_code.entry(code).or_default()[at] += 1;
        }
    }
    let rows: Vec<Vec<String>> = by_code
        .iter()
        .map(|(code, counts)| {
            let counts = counts.iter().map(|n| if *n == 0 { String::new() } else { n.to_string() });
            std::iter::once(code.clone()).chain(counts).collect()
        })
        .collect();
    let mut header = vec!["finding".to_owned()];
    header.extend(Cause::ALL.map(|c| c.to_string()));
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    table(&header, &rows)
}

/// Parameters that are silently wrong.
fn worst(all: &[Scored<'_>]) -> String {
    let mut wrong: Vec<One<'_>> = parameters(all)
        .into_iter()
        .filter(|(_, p)| p.vouched_but_for_law() && p.is_wrong())
        .collect();
    let off = |p: &ParameterScore| p.standard_errors().map_or(f64::INFINITY, f64::abs);
    wrong.sort_by(|a, b| off(b.1).total_cmp(&off(a.1)));
    let rows: Vec<Vec<String>> = wrong
        .iter()
        .take(WORST)
        .map(|(o, p)| {
            let method = o.score.as_ref().ok().and_then(|s| s.method).unwrap_or("none");
            vec![
                o.index.to_string(),
                p.parameter.to_string(),
                format!("{:+.1}", p.standard_errors().unwrap_or(f64::NAN)),
                format!("{:+.2} %", 100.0 * p.error().unwrap_or(f64::NAN)),
                p.bound_share().map_or_else(String::new, |b| format!("{:.3} %", 100.0 * b)),
                method.to_owned(),
                p.warned_by.join(" "),
                o.cause.map_or_else(String::new, |c| c.to_string()),
                o.effects.names().join(" "),
                format!("{:?}", o.motion),
            ]
        })
        .collect();
    let header = [
        "index",
        "parameter",
        "standard errors",
        "error",
        "bound",
        "from",
        "warned by",
        "cause",
        "effects",
        "motion",
    ];
    format!(
        "## Silently wrong\n\n{} parameters are more than five standard errors off without a warning, or with no warning but `friction-law`.\n\n{}",
        wrong.len(),
        table(&header, &rows)
    )
}

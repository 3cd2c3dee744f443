//! The goals of the project for its estimators, compared with the results.

use super::markdown::{percent, significant, table};
use super::responses::{CLOSER, silently_wrong};
use super::{Outcome, scores};
use crate::law::Law;
use crate::score::{EstimateScore, PointScore, Score};
use crate::scored_parameter::ScoredParameter;
use crate::statistics::{Share, median, quantile};
use crate::study::Study;

/// Smallest share of the campaigns in which a parameter must be within its limit.
const CAMPAIGNS: f64 = 0.95;
/// Allowed share of nominal 95 % intervals that contain the truth.
const COVERAGE: (f64, f64) = (0.93, 0.97);
/// Largest allowed width of intervals, and largest variance, relative to those of the Cramér-Rao bound.
const BEYOND_BOUND: f64 = 1.5;
/// Largest allowed share of campaigns with a silently wrong parameter.
const SILENT: f64 = 1e-3;
/// Largest allowed error of a corrected response: the median, and the largest.
const RESPONSE: (f64, f64) = (0.01, 0.05);
/// Largest allowed error of the linear parameters under a wrong law.
const LINEAR: f64 = 0.03;
/// Smallest share of wrong laws that are reported, largest share of false alarms.
const FLAGGED: (f64, f64) = (0.9, 0.05);

/// The largest allowed median error of a parameter.
fn median_bar(parameter: ScoredParameter) -> Option<f64> {
    match parameter {
        ScoredParameter::Coulomb => Some(1e-3),
        ScoredParameter::Inertia | ScoredParameter::Coupling => Some(2e-3),
        _ => None,
    }
}

/// One line: the goal, the result, and whether the goal is met; `None` if the line has no goal.
type Goal = (String, String, Option<bool>);

pub(super) fn section(studies: &[(Study, Outcome)]) -> String {
    let mut goals: Vec<Goal> = Vec::new();
    for (study, outcome) in studies {
        let all: Vec<&Score> = scores(outcome).into_iter().map(|(_, score)| score).collect();
        if studies.len() == 1 && study.law == Law::None {
            estimates(&all, &mut goals);
            coverage(&all, &mut goals);
            limit(&all, &mut goals);
            responses(&all, &mut goals);
            silence(&all, &mut goals);
        }
        law(study.law, &all, &mut goals);
        if studies.len() > 1 || study.law != Law::None {
            let asked = format!("{}: campaigns with a silently wrong parameter", study.law);
            goals.push((asked, silent(&all).to_string(), None));
        }
    }
    let rows: Vec<Vec<String>> = goals
        .into_iter()
        .map(|(asked, done, met)| {
            let met = met.map_or("–", |met| if met { "yes" } else { "no" });
            vec![asked, done, met.to_owned()]
        })
        .collect();
    format!(
        "## Goals\n\nA refused estimate counts as outside its limit.\n\n{}",
        table(&["goal", "result", "met"], &rows)
    )
}

/// All scores of a parameter; for frequencies those of every mode.
fn of(all: &[&Score], parameter: ScoredParameter) -> Vec<EstimateScore> {
    let same = |f: &&EstimateScore| match parameter {
        ScoredParameter::Frequency(_) => matches!(f.parameter, ScoredParameter::Frequency(_)),
        one => f.parameter == one,
    };
    all.iter().flat_map(|s| s.estimates.iter().filter(same).cloned()).collect()
}

fn name(parameter: ScoredParameter) -> String {
    match parameter {
        ScoredParameter::Frequency(_) => "every frequency".to_owned(),
        one => one.to_string(),
    }
}

fn estimates(all: &[&Score], goals: &mut Vec<Goal>) {
    let every = [
        ScoredParameter::Coulomb,
        ScoredParameter::Inertia,
        ScoredParameter::Coupling,
        ScoredParameter::Frequency(0),
        ScoredParameter::Viscous,
    ];
    for parameter in every {
        let (mut found, name) = (of(all, parameter), name(parameter));
        let only = if parameter == ScoredParameter::Viscous { " without a warning" } else { "" };
        if parameter == ScoredParameter::Viscous {
            found.retain(EstimateScore::vouched);
        }
        let errors: Vec<f64> =
            found.iter().filter_map(EstimateScore::error).map(f64::abs).collect();
        if let Some(bar) = parameter.bar() {
            let within = Share::count(&found, |f| f.error().is_some_and(|e| e.abs() <= bar));
            let asked = format!("{name} within {} in 95 % of the cases{only}", percent(Some(bar)));
            goals.push((asked, within.to_string(), Some(within.value() >= CAMPAIGNS)));
        }
        if let Some(bar) = median_bar(parameter) {
            let middle = median(&errors);
            let asked = format!("{name}: median error at most {}", percent(Some(bar)));
            goals.push((asked, percent(middle), Some(middle.is_some_and(|m| m <= bar))));
        }
    }
}

fn coverage(all: &[&Score], goals: &mut Vec<Goal>) {
    let every = [
        ScoredParameter::Coulomb,
        ScoredParameter::Inertia,
        ScoredParameter::Coupling,
        ScoredParameter::Viscous,
        ScoredParameter::Frequency(0),
    ];
    for parameter in every {
        let covered: Vec<bool> =
            of(all, parameter).iter().filter_map(EstimateScore::covers).collect();
        let share = Share::count(&covered, |c| *c);
        let asked =
            format!("95 % intervals of {} contain the truth in 93 to 97 %", name(parameter));
        let met = (COVERAGE.0..=COVERAGE.1).contains(&share.value());
        goals.push((asked, share.to_string(), Some(met)));
    }
}

/// Intervals and variances compared with the Cramér-Rao bound.
fn limit(all: &[&Score], goals: &mut Vec<Goal>) {
    let every = [
        ScoredParameter::Coulomb,
        ScoredParameter::Inertia,
        ScoredParameter::Coupling,
        ScoredParameter::Viscous,
        ScoredParameter::Frequency(0),
    ];
    for parameter in every {
        let (found, name) = (of(all, parameter), name(parameter));
        let mut goal = |asked: String, found: Option<f64>| {
            let shown = found.map_or_else(|| "–".to_owned(), significant);
            goals.push((asked, shown, Some(found.is_some_and(|v| v <= BEYOND_BOUND))));
        };
        goal(
            format!(
                "95 % interval of {name} at most {BEYOND_BOUND} times as wide as the bound's, median"
            ),
            median(&super::limit::widths(&found)),
        );
        goal(
            format!("variance of {name} at most {BEYOND_BOUND} times that of the bound"),
            super::limit::variance(&found),
        );
    }
}

fn responses(all: &[&Score], goals: &mut Vec<Goal>) {
    let (least, most) = RESPONSE;
    let met = |value: Option<f64>, bar: f64| value.is_some_and(|v| v <= bar);
    for (name, sinusoidal) in [("sines", true), ("other runs", false)] {
        let of = |p: &&PointScore| p.vouched && p.sinusoidal == sinusoidal;
        let points: Vec<&PointScore> = all.iter().flat_map(|s| &s.points).filter(of).collect();
        let errors: Vec<f64> = points.iter().filter_map(|p| p.corrected).collect();
        let (middle, worst) = (median(&errors), quantile(&errors, 1.0));
        let asked = |what: &str, bar| {
            format!("corrected response of {name}: {what} error at most {}", percent(Some(bar)))
        };
        goals.push((asked("median", least), percent(middle), Some(met(middle, least))));
        goals.push((asked("largest", most), percent(worst), Some(met(worst, most))));
        let closer: Vec<f64> =
            points.iter().filter_map(|p| Some(p.third_harmonic? / p.corrected?)).collect();
        if let Some(times) = median(&closer) {
            let asked = format!("error {CLOSER} times smaller than that of (30), median");
            goals.push((asked, significant(times), Some(times >= CLOSER)));
        }
    }
}

fn silence(all: &[&Score], goals: &mut Vec<Goal>) {
    let mut goal = |what: &str, wrong: Share| {
        let asked = format!("campaigns with a silently wrong {what}: at most 1 of 1000");
        goals.push((asked, wrong.to_string(), Some(wrong.value() <= SILENT)));
    };
    goal("parameter", silent(all));
    goal("vouched-for point of the response", silently_wrong(all));
}

/// Campaigns with a silently wrong parameter.
fn silent(all: &[&Score]) -> Share {
    Share::count(all, |s| s.estimates.iter().any(EstimateScore::silently_wrong))
}

fn law(law: Law, all: &[&Score], goals: &mut Vec<Goal>) {
    let flagged = Share::count(all, |s| !s.law_alarms().is_empty());
    if law.is_described() {
        let asked = format!("{law}: false alarms about the friction law in at most 5 %");
        goals.push((asked, flagged.to_string(), Some(flagged.value() <= FLAGGED.1)));
    }
    if law == Law::None {
        return;
    }
    let linear =
        [ScoredParameter::Inertia, ScoredParameter::Coupling, ScoredParameter::Frequency(0)];
    let sound = Share::count(all, |s| {
        let good = |parameter: &ScoredParameter| {
            s.of(*parameter).and_then(EstimateScore::error).is_some_and(|e| e.abs() <= LINEAR)
        };
        linear.iter().all(good)
    });
    let asked =
        format!("{law}: inertia, coupling and first frequency within 3 % in 95 % of the cases");
    goals.push((asked, sound.to_string(), Some(sound.value() >= CAMPAIGNS)));
    if !law.is_described() {
        let asked = format!("{law}: reported in 90 % of the campaigns");
        goals.push((asked, flagged.to_string(), Some(flagged.value() >= FLAGGED.0)));
    }
}

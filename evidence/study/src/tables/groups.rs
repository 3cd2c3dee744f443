//! The same results for parts of the campaigns.

use super::markdown::{percent, table};
use super::{Outcome, scores};
use crate::score::{EstimateScore, Score};
use crate::scored_parameter::ScoredParameter;
use crate::statistics::{Share, median, quantile};
use crate::stratum::Kind;
use crate::study::Scored;

/// A part of the campaigns: its name and the condition for belonging to it.
type Group = (String, Box<dyn Fn(&Scored) -> bool>);

const FIGURES: [ScoredParameter; 5] = [
    ScoredParameter::Coulomb,
    ScoredParameter::Inertia,
    ScoredParameter::Coupling,
    ScoredParameter::Viscous,
    ScoredParameter::Frequency(0),
];

pub(super) fn section(outcome: &Outcome) -> String {
    let all = scores(outcome);
    let header = [
        "campaigns",
        "number",
        "Coulomb",
        "inertia",
        "coupling",
        "viscous",
        "frequency 1",
        "silently wrong",
    ];
    let rows: Vec<Vec<String>> = groups().iter().map(|group| row(group, &all)).collect();
    let header_held = ["campaigns", "Coulomb", "inertia", "coupling", "viscous", "frequency 1"];
    let held: Vec<Vec<String>> = (1..=3).map(|masses| held(masses, &all)).collect();
    format!(
        "## By campaign\n\nMedian error / 95th percentile (share refused) of all estimates. *Sticking* is the largest share \
         of a run; CF is relative to the peak torque; T is the sample time.\n\n{}\n\n95 % intervals that contain the \
         truth:\n\n{}",
        table(&header, &rows),
        table(&header_held, &held)
    )
}

/// Shares of the intervals that contain the truth.
fn held(masses: usize, all: &[(&Scored, &Score)]) -> Vec<String> {
    let mut cells = vec![format!("n = {masses}")];
    for parameter in FIGURES {
        let of = all.iter().filter(|(s, _)| s.stratum.masses == masses);
        let covered: Vec<bool> =
            of.filter_map(|(_, score)| score.of(parameter)?.covers()).collect();
        cells.push(Share::count(&covered, |c| *c).to_string());
    }
    cells
}

fn row((name, belongs): &Group, all: &[(&Scored, &Score)]) -> Vec<String> {
    let of: Vec<&Score> = all.iter().filter(|(s, _)| belongs(s)).map(|(_, score)| *score).collect();
    let mut cells = vec![name.clone(), of.len().to_string()];
    for parameter in FIGURES {
        let estimates: Vec<&EstimateScore> = of.iter().filter_map(|s| s.of(parameter)).collect();
        let errors: Vec<f64> = estimates.iter().filter_map(|f| f.error()).map(f64::abs).collect();
        let refused = Share::count(&estimates, |f| f.estimate.is_none());
        cells.push(format!(
            "{} / {} ({})",
            percent(median(&errors)),
            percent(quantile(&errors, 0.95)),
            percent(Some(refused.value()).filter(|_| refused.of > 0))
        ));
    }
    let silent =
        of.iter().filter(|s| s.estimates.iter().any(EstimateScore::silently_wrong)).count();
    cells.push(silent.to_string());
    cells
}

fn groups() -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut add =
        |name: String, belongs: Box<dyn Fn(&Scored) -> bool>| groups.push((name, belongs));
    for n in 1..=3 {
        add(format!("n = {n}"), Box::new(move |s| s.stratum.masses == n));
    }
    for kind in Kind::ALL {
        add(kind.to_string(), Box::new(move |s| s.stratum.kind == kind));
    }
    for (low, high) in [(10, 11), (12, 13), (14, 16)] {
        let belongs = move |s: &Scored| (low..=high).contains(&s.stratum.motor_bits);
        add(format!("motor {low}-{high} bits"), Box::new(belongs));
    }
    for (low, high) in [(10, 11), (12, 13), (14, 16)] {
        let belongs = move |s: &Scored| (low..=high).contains(&s.stratum.tip_bits);
        add(format!("tips {low}-{high} bits"), Box::new(belongs));
    }
    for (low, high) in [(0.0, 0.02), (0.02, 0.05), (0.05, 0.1), (0.1, 0.15)] {
        let belongs = move |s: &Scored| s.stuck_share >= low && s.stuck_share < high;
        add(format!("sticking {:.0}-{:.0} %", 100.0 * low, 100.0 * high), Box::new(belongs));
    }
    for (low, high) in [(0.05, 0.2), (0.2, 0.4), (0.4, 0.6)] {
        let belongs = move |s: &Scored| s.coulomb_share >= low && s.coulomb_share < high;
        add(format!("CF {:.0}-{:.0} %", 100.0 * low, 100.0 * high), Box::new(belongs));
    }
    for (name, least, most) in [
        ("no noise", 0.0, 0.0),
        ("noise up to 0.3 steps", 1e-9, 0.3),
        ("noise up to 1 step", 0.3, 1.0),
    ] {
        let belongs = move |s: &Scored| {
            let noise = s.stratum.noise_steps.unwrap_or(0.0);
            noise >= least && noise <= most
        };
        add(name.to_owned(), Box::new(belongs));
    }
    for (low, high) in [(0.001, 0.007), (0.007, 0.05)] {
        let belongs =
            move |s: &Scored| s.stratum.damping_ratio >= low && s.stratum.damping_ratio < high;
        add(format!("damping ratio {low}-{high}"), Box::new(belongs));
    }
    for (low, high) in [(1.0, 2.0), (2.25, 4.0)] {
        let belongs = move |s: &Scored| {
            let milliseconds = 1e3 * s.stratum.sample_time_s;
            milliseconds >= low - 0.1 && milliseconds <= high + 0.1
        };
        add(format!("T {low}-{high} ms"), Box::new(belongs));
    }
    groups
}

//! The results as comma separated text, one row for each campaign.

use crate::law::Law;
use crate::score::EstimateScore;
use crate::scored_parameter::ScoredParameter;
use crate::study::{Scored, Study};

/// Columns before the parameters.
const HEAD: &str = "law,seed,index,masses,runs_kind,runs,motor_bits,tip_bits,sample_time_s,noise_steps,\
                    damping_ratio,coulomb_share,stuck_share,samples,identification_s,findings";

/// Every parameter that a campaign may have, with the name of its columns.
const FIGURES: [(&str, ScoredParameter); 12] = [
    ("coulomb_nm", ScoredParameter::Coulomb),
    ("coulomb_forward_nm", ScoredParameter::Forward),
    ("coulomb_backward_nm", ScoredParameter::Backward),
    ("inertia_kg_m2", ScoredParameter::Inertia),
    ("coupling_nm_per_rad", ScoredParameter::Coupling),
    ("viscous_nm_s_per_rad", ScoredParameter::Viscous),
    ("frequency_1_rad_s", ScoredParameter::Frequency(0)),
    ("frequency_2_rad_s", ScoredParameter::Frequency(1)),
    ("frequency_3_rad_s", ScoredParameter::Frequency(2)),
    ("damping_ratio_1", ScoredParameter::Damping(0)),
    ("damping_ratio_2", ScoredParameter::Damping(1)),
    ("damping_ratio_3", ScoredParameter::Damping(2)),
];

/// The campaigns of all studies as comma separated text, with a header; refused estimates are empty.
pub fn rows(studies: &[(Study, Vec<Option<Scored>>)]) -> String {
    let mut header = HEAD.to_owned();
    for (name, _) in FIGURES {
        for column in ["_true", "", "_std", "_warned", "_bound"] {
            header.extend([",", name, column]);
        }
    }
    let mut lines = vec![header];
    for (study, outcome) in studies {
        lines.extend(outcome.iter().filter_map(|one| Some(row(study, one.as_ref()?))));
    }
    lines.join("\n") + "\n"
}

fn row(study: &Study, scored: &Scored) -> String {
    let stratum = &scored.stratum;
    let score = scored.score.as_ref().ok();
    let mut codes: Vec<&str> =
        score.map_or(Vec::new(), |s| s.findings.iter().map(|f| f.code.as_str()).collect());
    codes.sort_unstable();
    codes.dedup();
    let mut cells = vec![
        law_cell(study.law),
        study.seed.to_string(),
        scored.index.to_string(),
        stratum.masses.to_string(),
        stratum.kind.to_string(),
        scored.runs.len().to_string(),
        stratum.motor_bits.to_string(),
        stratum.tip_bits.to_string(),
        stratum.sample_time_s.to_string(),
        stratum.noise_steps.unwrap_or(0.0).to_string(),
        stratum.damping_ratio.to_string(),
        scored.coulomb_share.to_string(),
        scored.stuck_share.to_string(),
        scored.samples.to_string(),
        format!("{:.4}", scored.identification.as_secs_f64()),
        codes.join(" "),
    ];
    for (_, parameter) in FIGURES {
        cells.extend(figure_cells(score.and_then(|s| s.of(parameter))));
    }
    cells.join(",")
}

/// The name of a law in the column `law`.
fn law_cell(law: Law) -> String {
    match law {
        Law::None => "true Coulomb".to_owned(),
        other => other.to_string(),
    }
}

fn figure_cells(parameter: Option<&EstimateScore>) -> [String; 5] {
    let Some(f) = parameter else { return Default::default() };
    let estimate = |of: fn(&lissom::identify::Estimate) -> f64| {
        f.estimate.as_ref().map_or_else(String::new, |e| of(e).to_string())
    };
    [
        f.truth.to_string(),
        estimate(|e| e.value),
        estimate(|e| e.std),
        f.warned.to_string(),
        f.bound.map_or_else(String::new, |b| b.to_string()),
    ]
}

//! All details of one drive, to look for the cause of an error.

use super::drive_campaign::DriveCampaign;
use super::drive_score::{ParameterScore, score_drive};
use super::drive_study::identified_drive;

/// Identifies and describes a drive's campaign.
pub fn describe_drive(campaign: &DriveCampaign, quick: bool) -> String {
    let cause = campaign.cause().map_or_else(String::new, |c| format!(", cause: {c}"));
    let mut lines = vec![
        format!(
            "campaign {} of seed {}, study `{}`{cause}",
            campaign.index, campaign.seed, campaign.study
        ),
        format!("{:#?}", campaign.effects),
        format!("{:#?}", campaign.numbers),
        format!("{} draws rejected before: {:?}", campaign.rejected.len(), campaign.rejected),
    ];
    for ((stamps, run), stuck) in campaign.raw.iter().zip(&campaign.stuck_share) {
        let (from, to) =
            run.motor().iter().fold((f64::MAX, f64::MIN), |(l, h), a| (l.min(*a), h.max(*a)));
        let peak = run.command().iter().fold(0.0_f64, |m, i| m.max(i.abs()));
        lines.push(format!(
            "{}: {:?}, {} rows, {:.2} s, {from:.3} to {to:.3} rad, peak current {peak:.4} A, stuck {:.1} %",
            run.name(),
            campaign.motion,
            run.len(),
            stamps[stamps.len() - 1] - stamps[0],
            100.0 * stuck
        ));
    }
    match identified_drive(campaign, quick) {
        Err(error) => lines.push(format!("nothing identified: {error}")),
        Ok(id) => {
            let scored = score_drive(campaign, &id);
            lines.push(format!("\nmethod {:?}", scored.method));
            lines.push(format!(
                "{:10} {:>13} {:>13} {:>13} {:>11} {:>11} {:>9} {:>10}",
                "parameter",
                "true",
                "in these runs",
                "estimate",
                "std. error",
                "bound",
                "error",
                "std. errors"
            ));
            lines.extend(scored.parameters.iter().map(parameter));
            if let Some(line) = &id.least_squares {
                let f = &line.estimates.friction;
                lines.push(format!(
                    "least squares: coulomb {:?}, viscous {:?}",
                    f.coulomb, f.viscous
                ));
            }
            lines.push(format!("friction: {:#?}", id.friction));
            lines.push(format!("residual of the regression: {:?}", id.regression_residual));
            for f in &id.findings {
                let run = f.run.as_deref().unwrap_or("campaign");
                let (severity, code, affects) = (f.severity(), f.code(), f.affects().join(" "));
                lines.push(format!("{severity:?} {code} [{run}] {affects}\n    {f}"));
            }
        }
    }
    lines.join("\n") + "\n"
}

fn parameter(p: &ParameterScore) -> String {
    let bound = p.bound.unwrap_or(f64::NAN);
    let head =
        format!("{:10} {:13.6e} {:13.6e}", p.parameter.to_string(), p.truth, p.truth_as_fell);
    let Some(e) = p.estimate else { return format!("{head}       refused {:?}", p.warned_by) };
    let mark = if p.silently_wrong() { " SILENTLY WRONG" } else { "" };
    format!(
        "{head} {:13.6e} {:11.3e} {bound:11.3e} {:+8.3} % {:+10.2} {}{mark}",
        e.value,
        e.std,
        100.0 * p.error().unwrap_or(f64::NAN),
        p.standard_errors().unwrap_or(f64::NAN),
        p.warned_by.join(" ")
    )
}

//! All details of one campaign, to look for the cause of an error.

use std::fmt::Write;
use std::time::Instant;

use lissom::identify::{Candidate, FrictionLaw, OutputError, starts};
use lissom::replay::ModalArm;

use crate::bound::Bound;
use crate::campaign::Campaign;
use crate::score::{EstimateScore, Score, score};
use crate::study::identified;
use crate::truth::Truth;

/// Identifies and describes a campaign of `seed`.
pub fn describe(campaign: &Campaign, seed: u64, quick: bool) -> String {
    let mut lines = conditions(campaign, seed);
    let start = Instant::now();
    let found = identified(campaign, quick);
    lines.push(format!("identified in {:.3} s", start.elapsed().as_secs_f64()));
    match found {
        Err(error) => lines.push(format!("nothing identified: {error}")),
        Ok(id) => {
            let bound = Bound::of(campaign);
            let scored = score(&Truth::of(campaign), &id).with_bound(bound.as_ref());
            lines.push(String::new());
            lines.push(estimates(&scored));
            if let Some(bound) = bound {
                lines.push(format!(
                    "residual of the true arm, in standard deviations of the sensors: {:.4?}",
                    bound.left
                ));
            }
            lines.push(format!(
                "modes found that the arm does not have: {}\n",
                scored.surplus_modes
            ));
            lines.push(points(&scored));
            if let Some(replayed) = &id.output_error {
                lines.push(stages(replayed, campaign));
            }
            if let Some(motor) = &id.regression {
                let (beam, rational) = (id.beam_regression.as_ref(), id.beam_model.as_ref());
                let from = starts(&campaign.logs, &motor.estimates(), beam, rational);
                lines.extend(from.iter().map(|arm| format!("start {}", arm_line(arm))));
            }
            lines.extend(id.regression.iter().map(|r| candidates("motor", &r.candidates)));
            let beam = id.beam_regression.iter().flat_map(|b| &b.candidates);
            lines.extend(beam.map(|tried| candidates("beam", tried)));
            lines.extend(id.friction_law.iter().map(friction));
            for f in &id.findings {
                let run = f.run.as_deref().unwrap_or("campaign");
                let affects = f.affects().join(" ");
                let (severity, code) = (f.severity(), f.code());
                lines.push(format!("{severity:?} {code} [{run}] {affects}\n    {f}"));
            }
        }
    }
    lines.join("\n") + "\n"
}

/// Windows that a regression tried.
fn candidates(of: &str, tried: &[Candidate]) -> String {
    let line = |c: &Candidate| {
        let Candidate { window_s, rows, clusters, relative_residual, sensitivity } = c;
        format!(
            "{of} {window_s:7.3} s {rows:6} rows {clusters:5} phases, residual {relative_residual:9.2e}, sensitivity {sensitivity:9.2e}"
        )
    };
    tried.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn conditions(campaign: &Campaign, seed: u64) -> Vec<String> {
    let rig = &campaign.definition.rig;
    let arm = &rig.arm;
    let mut lines = vec![
        format!("campaign {} of seed {seed}, {}", campaign.index, campaign.law),
        format!("{:?}", campaign.stratum),
        format!("{} draws rejected before: {:?}", campaign.rejected.len(), campaign.rejected),
        format!("{:?}", arm.motor),
        format!("{:?}, {:?}", arm.coulomb, rig.scene.friction),
    ];
    lines.extend(arm.beam().spans().iter().map(|span| format!("{span:?}")));
    lines.push(format!("{:?}", rig.controller));
    lines.push(format!(
        "current limit {:.4} A, CF {:.1} % of the peak torque",
        rig.instruments.amplifier.most_a(),
        100.0 * campaign.coulomb_share()
    ));
    for ((run, facts), log) in
        campaign.definition.runs.iter().zip(&campaign.facts).zip(&campaign.logs.runs)
    {
        let largest = log.motor().iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        lines.push(format!(
            "{:30} {:6} samples, waited {:6.1} s, stuck {:5.2} %, motor to {largest:.4} rad, peak {:.4} A",
            run.name,
            log.len(),
            facts.waited_s,
            100.0 * facts.stuck_share,
            facts.peak_a
        ));
    }
    lines.push(format!("runs given up: {:?}", campaign.dropped));
    lines
}

fn estimates(scored: &Score) -> String {
    let mut text = format!(
        "{:18} {:>13} {:>13} {:>13} {:>13} {:>10} {:>10}\n",
        "parameter", "true", "estimate", "std. error", "bound", "error", "std. errors"
    );
    for f in &scored.estimates {
        let _ = writeln!(text, "{}", parameter(f));
    }
    text
}

/// The choice of the friction law, term by term, and the friction curve.
fn friction(law: &FrictionLaw) -> String {
    let [simplest, chosen, curve] = law.relative_residual.map(|r| 100.0 * r);
    let mut text = format!(
        "friction law: windows of {:.4} s; residual {simplest:.3} % with the simplest law, {chosen:.3} % with \
         the chosen law, {curve:.3} % with the curve\n",
        law.window_s
    );
    for c in &law.candidates {
        let _ = writeln!(
            text,
            "{} in addition to {}: {:?} {:+.4e} ± {:.1e}, saves {:.2} % of blocks left out ({:+.2} standard errors), \
             kinds of motion better: {}",
            if c.taken { "adopted" } else { "rejected" },
            c.beside,
            c.term,
            c.amplitude.value,
            c.amplitude.std,
            100.0 * c.saved,
            c.standard_errors,
            c.across_kinds
        );
    }
    for p in &law.curve {
        let _ = writeln!(
            text,
            "{:+} {:10.4e}: {:+.4e} ± {:.1e} in {} windows",
            p.direction, p.speed, p.friction.value, p.friction.std, p.windows
        );
    }
    let _ = writeln!(
        text,
        "inertia {:?}, coupling {:?}",
        law.chosen.inertia, law.chosen.total_coupling
    );
    text
}

fn parameter(f: &EstimateScore) -> String {
    let name = f.parameter.to_string();
    let Some(e) = f.estimate else { return format!("{name:18} {:13.6e}       refused", f.truth) };
    let mark = match (f.warned, f.silently_wrong()) {
        (true, _) => "warned",
        (false, true) => "SILENTLY WRONG",
        (false, false) => "",
    };
    format!(
        "{name:18} {:13.6e} {:13.6e} {:13.3e} {:13.3e} {:+9.3} % {:+10.2} {mark}",
        f.truth,
        e.value,
        e.std,
        f.bound.unwrap_or(f64::NAN),
        100.0 * f.error().unwrap_or(f64::NAN),
        f.standard_errors().unwrap_or(f64::NAN)
    )
}

/// The stages of the output-error method, a line for each, and the true arm.
fn stages(found: &OutputError, campaign: &Campaign) -> String {
    let mut text = String::new();
    for s in &found.stages {
        let cost = s.iterations.last().map_or(f64::NAN, |i| i.cost);
        let residual: Vec<String> = s.residual.iter().map(|r| format!("{r:.2e}")).collect();
        let _ = writeln!(
            text,
            "{:4} windows of {:8.3} s, {:2} steps, {:?}, cost {cost:.4e}, residual {}\n     {}",
            s.windows,
            s.window_s,
            s.iterations.len(),
            s.stop,
            residual.join(" "),
            arm_line(&s.arm)
        );
    }
    for e in &found.extensions {
        let (name, z) = (e.parameter.name(), e.value / e.std);
        let done = if e.added { "added" } else { "rejected" };
        let _ = writeln!(
            text,
            "{done} {name}: {:.4e}, {z:+.1} standard errors, share {:.1e}",
            e.value, e.share
        );
    }
    for parameter in &found.parameters {
        if let Some(e) = found.estimate(*parameter) {
            let _ = writeln!(text, "free {}: {:.6e} ± {:.1e}", parameter.name(), e.value, e.std);
        }
    }
    let truth = ModalArm::of_arm(&campaign.definition.rig.arm);
    let truth = truth.as_ref().map_or_else(String::new, arm_line);
    let _ = writeln!(
        text,
        "whole runs {}, residual {:.2} times the noise, by channel {:.4?}, point masses {}\ntrue {truth}",
        found.whole_runs, found.beyond_noise, found.left_over, found.point_masses
    );
    text
}

fn arm_line(arm: &ModalArm) -> String {
    let modes = arm.modes.iter().map(|m| format!("{:.4e}", m.omega_rad_s));
    let stiffness = arm.modes.iter().map(|m| format!("{:.3e}", m.stiffness_nm_per_rad));
    let shape =
        |row: &Vec<f64>| row.iter().map(|r| format!("{r:+.3}")).collect::<Vec<_>>().join(" ");
    format!(
        "J {:.4e} CF {:.4e}, modes {}, k {}, shapes {}",
        arm.inertia_kg_m2,
        arm.coulomb_nm,
        modes.collect::<Vec<_>>().join(" "),
        stiffness.collect::<Vec<_>>().join(" "),
        arm.shapes.iter().map(shape).collect::<Vec<_>>().join(" | ")
    )
}

fn points(scored: &Score) -> String {
    let mut text = format!(
        "{:>10} {:>5} {:>10} {:>10} {:>10} {:>10}\n",
        "rad/s", "kind", "raw", "(30)", "corrected", "std. errors"
    );
    for p in &scored.points {
        let percent = |v: Option<f64>| {
            v.map_or_else(|| format!("{:>10}", "-"), |v| format!("{:8.2} %", 100.0 * v))
        };
        let _ = writeln!(
            text,
            "{:10.3} {:>5} {} {} {} {:10.2} {}",
            p.omega_rad_s,
            if p.sinusoidal { "sine" } else { "band" },
            percent(Some(p.raw)),
            percent(p.third_harmonic),
            percent(p.corrected),
            p.standard_errors.unwrap_or(f64::NAN),
            if p.vouched { "" } else { "not vouched for" }
        );
    }
    text
}

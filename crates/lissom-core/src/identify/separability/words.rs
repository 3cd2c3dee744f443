//! What the logs separate, in words.

use crate::identify::findings::Finding;
use crate::identify::separability::direction::{Direction, DirectionPart};
use crate::identify::separability::run_to_add::RunToAdd;
use crate::identify::separability::runs::{Carried, RunShare};
use crate::identify::separability::thresholds::{CHANGE_SHOWN, CORRELATED};
use crate::identify::separability::{FigureKnown, Separability};
use crate::identify::thresholds::NORMAL_95;
use crate::information::Figure;
use crate::plan::{PlannedMotion, percent};
use crate::record::Axis;

impl Separability {
    /// The verdict, a sentence or two for each thing to know.
    pub fn words(&self, axis: Axis) -> Vec<String> {
        let stands_out = self.finding();
        let line = |f: &Finding| format!("Run {}: {f}.", f.run.as_deref().unwrap_or_default());
        // What is doubted comes before how well it is known.
        let mut lines: Vec<String> = self.doubted().into_iter().collect();
        lines.extend(stands_out.iter().map(line));
        lines.extend(self.least_known());
        lines.extend(self.suffering());
        if stands_out.is_none() {
            lines.extend(self.runs.iter().filter_map(carries));
        }
        lines.extend(self.run_to_add.as_ref().map(|run| worth_adding(run, axis)));
        lines
    }

    fn least_known(&self) -> Option<String> {
        let worst = self.directions.first()?;
        if self.is_sharp() {
            let least = self.figures.iter().max_by(|a, b| a.std.total_cmp(&b.std))?;
            let if_so = if self.doubted_by.is_empty() { "" } else { ", if the model is complete" };
            return Some(format!(
                "Every parameter is known to 1 % or better{if_so}; least well known is {}, to ± {} (± {} with 95 %).",
                least.figure.name(),
                percent(least.std),
                percent(NORMAL_95 * least.std)
            ));
        }
        if worst.std.is_infinite() {
            return Some(format!(
                "The logs cannot separate some of the parameters: with {} they would be the same.",
                moved(&worst.parts, CHANGE_SHOWN / worst.parts.first()?.weight)
            ));
        }
        Some(format!("{}{}", told(worst)?, self.best_known()))
    }

    /// What speaks against the deviations that all of this is by.
    fn doubted(&self) -> Option<String> {
        let codes = self.doubted_by.join(", ");
        (!codes.is_empty() && !self.figures.is_empty()).then(|| {
            format!(
                "The runs contain more than the model has ({codes}): parameters may be off by more than their standard \
                 errors, and more runs of the same kind do not change that."
            )
        })
    }

    fn best_known(&self) -> String {
        let best = self.figures.iter().min_by(|a, b| a.std.total_cmp(&b.std));
        best.filter(|_| self.figures.len() > 1).map_or_else(String::new, |best| {
            format!(" Best known is {}, to ± {}.", best.figure.name(), percent(best.std))
        })
    }

    /// What the leading figure would be if the others were known.
    fn suffering(&self) -> Option<String> {
        let lead = self.directions.first()?.parts.first()?.figure;
        let known = self.figures.iter().find(|f| f.figure == lead)?;
        let FigureKnown { std, alone, .. } = *known;
        (!self.is_sharp() && std.is_finite() && std > CORRELATED * alone).then(|| {
            format!(
                "If the other parameters were known, {} would be known to ± {}: what is missing is not more signal but a \
                 motion that separates them.",
                lead.name(),
                percent(alone)
            )
        })
    }
}

/// A direction that is known badly.
fn told(worst: &Direction) -> Option<String> {
    let first = worst.parts.first()?;
    Some(if worst.parts.len() == 1 {
        let std = worst.std * first.weight;
        format!("Least well known is {}: ± {}.", first.figure.name(), percent(std))
    } else {
        format!(
            "Least well known is one combination: {} (one standard error) would hardly change the logs.",
            moved(&worst.parts, worst.std)
        )
    })
}

/// "viscous friction up by 10 % with Coulomb friction down by 0.8 %".
fn moved(parts: &[DirectionPart], length: f64) -> String {
    let part = |p: &DirectionPart| {
        let change = p.weight * length;
        let way = if change < 0.0 { "down" } else { "up" };
        let of = if p.figure == Figure::Offset { " of Coulomb friction" } else { "" };
        format!("{} {way} by {}{of}", p.figure.name(), percent(change.abs()))
    };
    match parts {
        [] => String::new(),
        [first] => part(first),
        [first, others @ ..] => {
            let others: Vec<String> = others.iter().map(part).collect();
            format!("{} together with {}", part(first), others.join(" and "))
        }
    }
}

/// What a run alone tells.
fn carries(run: &RunShare) -> Option<String> {
    let carried: Vec<&Carried> = run.carries().collect();
    let names = |of: &dyn Fn(&Carried) -> bool| {
        let names: Vec<String> =
            carried.iter().filter(|c| of(c)).map(|c| c.figure.name()).collect();
        (!names.is_empty()).then(|| names.join(", "))
    };
    let alone = names(&|c| c.growth.is_infinite());
    let mostly = names(&|c| c.growth.is_finite());
    let growth = carried.iter().map(|c| c.growth).filter(|g| g.is_finite()).fold(0.0, f64::max);
    let alone = alone.map(|names| format!("alone gives {names}"));
    let mostly = mostly.map(|names| {
        format!("carries {names}: without it standard errors grow up to {growth:.1}-fold")
    });
    let all: Vec<String> = alone.into_iter().chain(mostly).collect();
    (!all.is_empty()).then(|| format!("Run {} {}.", run.run, all.join(" and ")))
}

fn worth_adding(run: &RunToAdd, axis: Axis) -> String {
    let unit = match axis {
        Axis::Rotary => "rad",
        Axis::Linear => "m",
    };
    let motion = match run.motion {
        PlannedMotion::Sine { omega_rad_s } => format!("a sine at {omega_rad_s} rad/s"),
        PlannedMotion::Multisine { omega_rad_s, to_rad_s, .. } => {
            format!("a multisine from {omega_rad_s} to {to_rad_s} rad/s")
        }
        PlannedMotion::Chirp { from_rad_s, to_rad_s, .. } => {
            format!("a sweep from {from_rad_s} to {to_rad_s} rad/s")
        }
    };
    format!(
        "Worth adding: {motion} with {} {unit} for {:.0} s: {} from ± {} to about ± {}.",
        run.amplitude_rad,
        run.record_s,
        run.figure.name(),
        percent(run.std_now),
        percent(run.std_then)
    )
}

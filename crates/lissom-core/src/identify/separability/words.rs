//! The verdict in words: which parameters the logs separate, and which run to add.

use crate::identify::findings::Finding;
use crate::identify::separability::direction::{Direction, DirectionPart};
use crate::identify::separability::run_to_add::RunToAdd;
use crate::identify::separability::runs::{Carried, RunShare};
use crate::identify::separability::thresholds::{CHANGE_SHOWN, CORRELATED};
use crate::identify::separability::{ParameterCertainty, Separability};
use crate::identify::thresholds::NORMAL_95;
use crate::information::ArmParameter;
use crate::plan::percent;
use crate::record::Axis;

impl Separability {
    /// The verdict in words, one or two sentences for each statement.
    pub fn words(&self, axis: Axis) -> Vec<String> {
        let stands_out = self.finding();
        let line = |f: &Finding| format!("{}: {f}.", named(f.run.as_deref().unwrap_or_default()));
        // Doubts about the model come before the standard errors.
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
            let least = self.parameters.iter().max_by(|a, b| a.std.total_cmp(&b.std))?;
            let if_so = if self.doubted_by.is_empty() { "" } else { ", if the model is complete" };
            let offset = self.parameters.iter().any(|f| f.parameter == ArmParameter::Offset);
            let of_what = if offset { " (the offset in percent of Coulomb friction)" } else { "" };
            let names: Vec<String> = self.parameters.iter().map(|p| p.parameter.name()).collect();
            return Some(format!(
                "Standard errors of 1 % or less: {}{of_what}{if_so}. Least certain: {}, standard error {}, 95 % interval ±{}.",
                names.join(", "),
                least.parameter.name(),
                percent(least.std),
                percent(NORMAL_95 * least.std)
            ));
        }
        if worst.std.is_infinite() {
            return Some(format!(
                "These logs cannot separate some parameters: {} would not change the motion.",
                moved(&worst.parts, CHANGE_SHOWN / worst.parts.first()?.weight)
            ));
        }
        Some(format!("{}{}", least_certain(worst)?, self.best_known()))
    }

    /// Findings that speak against the standard errors on which the verdict is based.
    fn doubted(&self) -> Option<String> {
        let codes = self.doubted_by.join(", ");
        (!codes.is_empty() && !self.parameters.is_empty()).then(|| {
            format!(
                "The runs contain effects that the model does not have ({codes}): errors of the parameters may be larger than \
                 their standard errors, and more runs of the same kind do not change this."
            )
        })
    }

    fn best_known(&self) -> String {
        let own_size =
            self.parameters.iter().filter(|p| p.given && p.parameter != ArmParameter::Offset);
        let best = own_size.min_by(|a, b| a.std.total_cmp(&b.std));
        best.filter(|_| self.parameters.len() > 1).map_or_else(String::new, |best| {
            format!(
                " Most certain: {}, standard error {}.",
                best.parameter.name(),
                percent(best.std)
            )
        })
    }

    /// The standard error of the leading parameter if the other parameters were known.
    fn suffering(&self) -> Option<String> {
        let lead = self.directions.first()?.parts.first()?.parameter;
        let known = self.parameters.iter().find(|f| f.parameter == lead)?;
        let ParameterCertainty { std, alone, .. } = *known;
        (!self.is_sharp() && std.is_finite() && std > CORRELATED * alone).then(|| {
            format!(
                "If the other parameters were known, the standard error of {} would be {}: the logs do not lack signal, but a \
                 motion that separates the parameters.",
                lead.name(),
                percent(alone)
            )
        })
    }
}

/// The direction with the largest standard error.
fn least_certain(worst: &Direction) -> Option<String> {
    let first = worst.parts.first()?;
    Some(if worst.parts.len() == 1 {
        let std = worst.std * first.weight;
        format!("Least certain: {}, standard error {}.", first.parameter.name(), percent(std))
    } else {
        format!(
            "Some parameters are correlated: {} (one standard error) would change the motion by hardly more than the noise.",
            moved(&worst.parts, worst.std)
        )
    })
}

/// A combined change in words: "viscous friction up by 10 % together with Coulomb friction down by 0.8 %".
fn moved(parts: &[DirectionPart], length: f64) -> String {
    let part = |p: &DirectionPart| {
        let change = p.weight * length;
        let way = if change < 0.0 { "down" } else { "up" };
        let of = if p.parameter == ArmParameter::Offset { " of Coulomb friction" } else { "" };
        format!("{} {way} by {}{of}", p.parameter.name(), percent(change.abs()))
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

/// Parameters that depend mainly on one run.
fn carries(run: &RunShare) -> Option<String> {
    let carried: Vec<&Carried> = run.carries().collect();
    let names = |of: &dyn Fn(&Carried) -> bool| {
        let names: Vec<String> =
            carried.iter().filter(|c| of(c)).map(|c| c.parameter.name()).collect();
        (!names.is_empty()).then(|| names.join(", "))
    };
    let alone = names(&|c| c.growth.is_infinite());
    let mostly = names(&|c| c.growth.is_finite());
    let growth = carried.iter().map(|c| c.growth).filter(|g| g.is_finite()).fold(0.0, f64::max);
    let alone = alone.map(|names| format!("alone determines {names}"));
    let mostly = mostly.map(|names| {
        format!(
            "is the main source of {names} (without it standard errors would be up to {growth:.1} times as large)"
        )
    });
    let all: Vec<String> = alone.into_iter().chain(mostly).collect();
    (!all.is_empty()).then(|| format!("{} {}.", named(&run.run), all.join(" and ")))
}

/// The name of a run at the beginning of a sentence.
fn named(run: &str) -> String {
    match run.strip_prefix("run ") {
        Some(rest) => format!("Run {rest}"),
        None => format!("Run {run}"),
    }
}

fn worth_adding(run: &RunToAdd, axis: Axis) -> String {
    let unit = match axis {
        Axis::Rotary => "rad",
        Axis::Linear => "m",
    };
    format!(
        "A run worth adding: a {} with an amplitude of {} {unit} for {:.0} s. The standard error of {} would drop from \
         {} to about {}.",
        run.motion,
        run.amplitude_rad,
        run.record_s,
        run.parameter.name(),
        percent(run.std_now),
        percent(run.std_then)
    )
}

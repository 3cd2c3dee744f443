//! Output error: the logged command replayed through an arm whose parameters are moved until it shows
//! the logged angles.

use crate::identify::methods::output_error::budget::Budget;
use crate::identify::methods::output_error::fitting::Fitting;
use crate::identify::methods::output_error::found::{OutputError, OutputErrorStart};
use crate::identify::methods::output_error::schedule::{Attempt, best};
use crate::identify::methods::output_error::thresholds::{EVALUATIONS_MOST, WINDOW_WIDENING};
use crate::identify::methods::output_error::undecided::{Known, undecided};
use crate::identify::methods::output_error::{data, noise};
use crate::identify::prepare::prepared::Prepared;
use crate::replay::SensorNoise;

/// Moves the figures of an arm until the replayed command shows the logged angles.
///
/// From one of the arms after another, until one describes the runs; else the one that comes nearest: where short
/// windows show that an arm does not describe the runs it is given up there.
/// In stages: windows with an initial state each, short at first, so that sticking and slipping
/// follow the log; then ever longer ones, until they are whole runs or the residual grows because the
/// arm does not describe what happens. Parameters beyond the simplest law (lag, viscous friction by
/// direction, the other kind of damping, friction near rest, ripple) are added where the residual calls for them. At the end the
/// sensors' steps are counted as what they are, and readings that only repeat a step once. Where more
/// than the sensors' noise is left then, or the highest mode is faint, it is done again more slowly, from
/// other frequencies of that mode, too.
///
/// `None` where no window can be cut or nothing is left of the search.
pub fn output_error(prepared: &Prepared<'_>, start: &OutputErrorStart) -> Option<OutputError> {
    let campaign = prepared.used();
    let masks = data::masks(campaign);
    let blocks = data::blocks(campaign, &start.omega_rad_s);
    let law = &start.law;
    let noise = noise::of_samples(campaign);
    let budget = Budget::new(start.most_evaluations.unwrap_or(EVALUATIONS_MOST));
    let fitting = Fitting {
        campaign,
        masks: &masks,
        blocks: &blocks,
        law,
        noise: &noise,
        budget: &budget,
        widening: WINDOW_WIDENING,
        tries_laws: true,
    };
    let Attempt { fit, mut report, without_repeats, left } = best(&fitting, start)?;
    let fitting = Fitting { masks: without_repeats.as_deref().unwrap_or(&masks), ..fitting };
    let beyond_noise = fitting.beyond_noise(&fit);
    let undecided = undecided(&fitting, &fit);
    let noise = fit.noise.iter().map(|n| SensorNoise::gaussian(n.deviation())).collect();
    let mut found = fit.covariances(&undecided.sums);
    let Known { parameters, covariance, open_by_damping } =
        undecided.known(&fit.free, found.larger());
    let n = parameters.len();
    found.white.resize_mut(n, n, 0.0);
    found.blocks.resize_mut(n, n, 0.0);
    let by_run = fit.by_run(&undecided.sums).of_parameters(n);
    report.added.append(&mut report.refused);
    Some(OutputError {
        point_masses: fit.body.masses.is_some(),
        arm: fit.body.arm,
        covariance,
        white: found.white,
        blocks: found.blocks,
        by_run,
        noise,
        windows: fit.windows,
        parameters,
        beyond_noise,
        left_over: left,
        stages: report.stages,
        extensions: report.added,
        open_by_damping,
        whole_runs: fit.whole_runs,
        evaluations: budget.spent(),
        budget_spent: budget.is_spent(),
    })
}

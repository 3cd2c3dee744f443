//! The output-error method: it simulates the arm under the logged command, and changes the arm's parameters until the
//! simulated motion is the logged one.

use crate::identify::output_error::command_noise;
use crate::identify::output_error::engine::budget::Budget;
use crate::identify::output_error::engine::{data, noise};
use crate::identify::output_error::found::{OutputError, OutputErrorStart, SearchEnd};
use crate::identify::output_error::model::describes::accepted_residual;
use crate::identify::output_error::model::fitting::Fitting;
use crate::identify::output_error::schedule::{Attempt, best};
use crate::identify::output_error::thresholds::WINDOW_WIDENING;
use crate::identify::output_error::undecided::{KnownParameters, undecided};
use crate::identify::prepare::prepared::Prepared;
use crate::replay::SensorNoise;

/// Identifies the arm whose simulated motion under the logged command is the logged motion.
///
/// The search starts from one arm after another until one describes the runs. If none does, the closest one is
/// returned. An arm that does not describe short windows is given up at once.
///
/// Each window has its own initial state. Windows are short at first, so that sticking and slipping follow the log.
/// They are lengthened until they are whole runs, or until the residual grows because the arm does not describe the
/// motion. Parameters in addition to the simplest law are added if they are significant: a lag, viscous friction by
/// direction, another kind of damping, friction near rest, a ripple. At the end the steps of the sensors are part of
/// the likelihood, and readings that only repeat a step are counted once. If the residual is then above the noise, or
/// the highest mode is weak, the search is repeated: windows grow more slowly, and other starting frequencies of that
/// mode are tried.
///
/// `None` if no window can be cut or no starting arm is within the limits of the search.
pub fn output_error(prepared: &Prepared<'_>, start: &OutputErrorStart) -> Option<OutputError> {
    let campaign = prepared.used();
    let masks = data::masks(campaign);
    let blocks = data::blocks(campaign, &start.omega_rad_s);
    let noise = noise::of_samples(campaign);
    let inertia = start.arms.first()?.inertia_kg_m2;
    let most = start.most_evaluations;
    let budget = Budget::new(most, start.interrupt.clone());
    let fitting = Fitting {
        campaign,
        masks: &masks,
        blocks: &blocks,
        further_terms: &start.further_terms,
        shown_rad_s: &start.shown_rad_s,
        noise: &noise,
        command_noise_most: command_noise::most(campaign, inertia),
        budget: &budget,
        widening: WINDOW_WIDENING,
    };
    let Attempt { fit, mut report, without_repeats, left } = best(&fitting, start)?;
    let fitting = Fitting { masks: without_repeats.as_deref().unwrap_or(&masks), ..fitting };
    let beyond_noise = fitting.beyond_noise(&fit);
    let sees_modes = fitting.sees_modes(&fit);
    let undecided = undecided(&fitting, &fit);
    let noise = fit.noise.iter().map(|n| SensorNoise::gaussian(n.deviation())).collect();
    let mut found = fit.covariances(&undecided.sums);
    let KnownParameters { parameters, covariance, open_by_damping } =
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
        accepted_residual: accepted_residual(fit.whole_runs),
        sees_modes,
        left_over: left,
        command_noise: fit.command_noise,
        unused: None,
        stages: report.stages,
        extensions: report.added,
        open_by_damping,
        whole_runs: fit.whole_runs,
        evaluations: budget.spent(),
        end: if budget.spent() >= most {
            SearchEnd::Evaluations
        } else if budget.is_spent() {
            SearchEnd::Interrupted
        } else {
            SearchEnd::Done
        },
    })
}

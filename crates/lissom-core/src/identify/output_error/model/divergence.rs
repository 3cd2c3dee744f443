//! Neighbouring motions that grow apart. If friction falls with speed or changes over the angle, they do so
//! exponentially, and windows can be too long.

use crate::identify::output_error::engine::windows::widen;
use crate::identify::output_error::model::fit::{ArmFit, Report};
use crate::identify::output_error::model::fitting::Fitting;
use crate::identify::output_error::thresholds::{NEIGHBOURS_GROW_APART, RESIDUAL_AT_NOISE};
use crate::record::TipQuantity;
use crate::replay::{SensorNoise, WindowSums};

impl Fitting<'_> {
    /// Whether neighbouring motions grow apart within a fit's windows, by more than [`NEIGHBOURS_GROW_APART`].
    pub(crate) fn diverges(&self, fit: &ArmFit) -> bool {
        self.growth(fit) > NEIGHBOURS_GROW_APART
    }

    /// Uses all windows of the fit's present length instead of some, because longer ones give no more information.
    /// The fit stays as it was if its residual is then above the noise.
    pub(crate) fn take_all(&self, fit: &mut ArmFit, report: &mut Report) {
        let before = fit.clone();
        fit.windows = widen(self.campaign, &fit.body.arm, &fit.windows, fit.window_s);
        fit.whole_runs = true;
        self.search(fit, report);
        if self.beyond_noise(fit) > RESIDUAL_AT_NOISE {
            *fit = before;
        }
    }

    /// Growth of a change of a window's first angle: its rms over the window in the sensors of angles, relative to
    /// the change; the largest of all windows. If it is large, the motion depends on the last digits of the first
    /// state.
    fn growth(&self, fit: &ArmFit) -> f64 {
        if fit.body.arm.dry_terms.is_empty() {
            return 1.0;
        }
        // The change of an acceleration contains the square of a frequency: it does not show the growth of the angle.
        let tips = self.campaign.channels.tips.iter();
        let counts = tips.map(|tip| tip.quantity != TipQuantity::Acceleration);
        let counts: Vec<bool> = std::iter::once(true).chain(counts).collect();
        let weightless = SensorNoise::gaussian(f64::MAX.sqrt());
        let noise = fit.noise.iter().zip(&counts);
        let noise: Vec<SensorNoise> =
            noise.map(|(own, counts)| if *counts { *own } else { weightless }).collect();
        let problem = self.problem(&fit.free, (&noise, 0.0), true);
        let point = problem.at(fit.body.clone(), fit.windows.clone());
        let first_angle = fit.coordinates();
        let of_window = |sums: &WindowSums| {
            let readings = sums.readings.iter().zip(&noise).zip(&counts);
            let weights = readings.filter(|(_, counts)| **counts);
            let unchanged: f64 = weights.map(|((n, e), _)| *n as f64 / e.deviation().powi(2)).sum();
            let grown = (sums.gram[(first_angle, first_angle)] / unchanged).sqrt();
            if grown.is_nan() && unchanged > 0.0 { f64::INFINITY } else { grown }
        };
        point.sums.iter().map(of_window).fold(0.0, f64::max)
    }
}

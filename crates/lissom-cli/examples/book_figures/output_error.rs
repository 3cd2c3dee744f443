//! `output-error.svg`: a run replayed through the arm that was found.

use lissom::identify::{Options, identify};
use lissom::replay::predict;
use lissom_report::{Axis, LinePlot, Role, StackedPlot, Trace, TraceStyle};

use crate::Drawn;
use crate::arms::noisy_rig;
use crate::experiments::{campaign, settled_sine};

/// Frequency \[rad/s\] and amplitude \[rad\] of the sines; the figure shows the first.
const SINES: [(f64, f64); 3] = [(1.3, 0.1), (3.9, 0.3), (9.3, 0.3)];
const RECORD_S: f64 = 15.0;
/// What the figure shows of it \[s\].
const SHOWN_S: f64 = 6.0;
/// Noise of both angles \[rad\].
const NOISE_RAD: f64 = 1e-3;
const SEED: u64 = 400;

/// Measured and replayed motor angle, and the residual.
pub(crate) fn figure() -> Drawn {
    let rig = noisy_rig(NOISE_RAD)?;
    let sine = |(omega, amplitude)| settled_sine(omega, amplitude, RECORD_S);
    let experiments = SINES.into_iter().map(sine).collect::<Result<Vec<_>, _>>()?;
    let campaign = campaign(&rig, &experiments, SEED)?;
    let found =
        identify(&campaign, &Options::default(), |_| ())?.output_error.ok_or("no solution")?;
    let window = found.windows.iter().find(|w| w.run == 0).ok_or("no window")?;
    let replayed = predict(&found.arm, &campaign, window).ok_or("too many modes")?;
    let run = &campaign.runs[0];
    let first = *window.samples.start();
    let rows = (SHOWN_S / run.sample_time_s()) as usize - first;
    let replayed = replayed.channels[0][..rows].to_vec();
    let measured = run.motor()[first..first + rows].to_vec();
    let time: Vec<f64> = (first..first + rows).map(|k| k as f64 * run.sample_time_s()).collect();
    let residual = measured.iter().zip(&replayed).map(|(m, r)| m - r).collect();
    let axis = || Axis::linear("time (s)").range(0.0, SHOWN_S);
    let plot = StackedPlot::new("Motor angle, measured and replayed with the arm found")
        .subtitle(format!("One of {} runs; sensor noise {NOISE_RAD} rad", SINES.len()))
        .plot(
            LinePlot::new("", axis(), Axis::linear("angle (rad)"))
                .trace(Trace::line("measured", Role::Raw, time.clone(), measured))
                .trace(Trace::new(
                    "replayed",
                    Role::Fitted,
                    TraceStyle::Dashes,
                    time.clone(),
                    replayed,
                )),
        )
        .plot(LinePlot::new("", axis(), Axis::linear("residual (rad)")).trace(Trace::line(
            "residual",
            Role::Corrected,
            time,
            residual,
        )));
    Ok(Box::new(plot))
}

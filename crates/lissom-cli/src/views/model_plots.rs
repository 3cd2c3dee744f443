//! Plots of a model: Bode plots, mode shapes, and poles and zeros over the load.

use std::path::Path;

use lissom::beam::RootClass;
use lissom_io::model::{Model, PayloadCase};
use lissom_io::write::Batch;
use lissom_report::{Axis, BodePlot, LinePlot, Role, Series, Style, Trace, TraceStyle};
use lissom_views::digits::shown;
use num_complex::Complex64;

use super::plot_file::add;
use crate::args::model_args::Omega;
use crate::shared::failure::Failure;
use crate::shared::progress_bar;
use crate::tasks::load_study::of_class;
use crate::tasks::mode_shapes::{ModeShape, shapes};
use crate::tasks::model_task::{Task, motor_response};

/// Number of points on the line of a response.
const LINE: usize = 1200;
/// Largest product of masses and points; more would take too long.
const WORK: usize = 20_000_000;
/// Number of modes that the frequency axis covers.
const MODES_REACHED: usize = 6;
/// Relative distance from the imaginary axis at which a response without damping is drawn.
const ASIDE: f64 = 1e-4;
/// Number of modes, poles and zeros that are drawn.
const DRAWN: usize = 4;

/// Adds every plot to the files to write.
pub(crate) fn add_all(
    batch: &mut Batch,
    folder: &Path,
    task: &Task<'_>,
    model: &Model,
) -> Result<(), Failure> {
    batch.folder(folder)?;
    let (tip, motor) = bode(task, model);
    add(batch, folder, "bode-tip", &tip)?;
    if let Some(motor) = motor {
        add(batch, folder, "bode-motor", &motor)?;
    }
    let shapes = shapes(task.beam, DRAWN);
    if !shapes.is_empty() {
        add(batch, folder, "modes", &modes(shapes, model))?;
    }
    if let Some(cases) = &model.payload_study {
        add(batch, folder, "payload", &payload(cases))?;
    }
    Ok(())
}

/// Frequencies of the lines, between the ends of the frequencies asked for, with points at the resonances.
fn grid(task: &Task<'_>, model: &Model) -> Vec<f64> {
    let clamped = &model.natural_frequencies_rad_s;
    let reached = clamped.len().min(MODES_REACHED);
    let asked = task.omega_rad_s.as_deref().unwrap_or(&[]);
    let low = asked.iter().copied().fold(f64::INFINITY, f64::min);
    let high = asked.iter().copied().fold(0.0, f64::max);
    let (low, high) =
        if low < high { (low, high) } else { (clamped[0] / 10.0, clamped[reached - 1] * 2.0) };
    let points = (WORK / task.beam.len()).clamp(60, LINE);
    let mut grid = Omega::range(low, high, points);
    if points == LINE {
        let coupled = model.coupled_frequencies_rad_s.iter().flatten();
        let zeros = model.tip_zeros.iter().flat_map(|z| &z.z);
        let zeros = zeros.filter(|z| z.re < 0.0).map(|z| z.sqrt().im.abs());
        let centres = clamped.iter().copied().chain(coupled.copied()).chain(zeros);
        for centre in centres.filter(|w| (low..high).contains(w)) {
            grid.push(centre);
            for k in -2..9 {
                let off = ASIDE * 2.0_f64.powi(k);
                grid.extend([centre * (1.0 - off), centre * (1.0 + off)]);
            }
        }
        grid.retain(|w| (low..=high).contains(w));
        grid.sort_by(f64::total_cmp);
    }
    grid
}

fn bode(task: &Task<'_>, model: &Model) -> (BodePlot, Option<BodePlot>) {
    let grid = grid(task, model);
    let bar = progress_bar::stages(grid.len());
    bar.set_message("Bode plots");
    let aside = if task.beam.is_undamped() { ASIDE } else { 0.0 };
    let (mut tip, mut motor) = (Vec::new(), Vec::new());
    for omega in &grid {
        let s = Complex64::new(aside * omega, *omega);
        let beam = task.beam.response(s);
        tip.extend(beam.angles.last());
        if let Some((drive, _)) = &task.drive {
            motor.push(motor_response(drive, s, beam.coupling_nm_per_rad));
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let plot = |title: String, unit: &str, values: Vec<Complex64>| {
        let series = Series::new("", Role::Corrected, Style::Line, grid.clone(), values);
        let plot = BodePlot::new(title, unit).series(series);
        if aside > 0.0 {
            plot.subtitle("the beam has no damping: drawn at s = (0.0001 + j)ω, to limit the peaks")
        } else {
            plot
        }
    };
    let tip = plot(format!("Tip: angle θ_{} per motor angle", model.len()), "", tip);
    let motor = task.drive.is_some().then(|| {
        plot("Motor: angle per current, without Coulomb friction".to_owned(), "rad/A", motor)
    });
    (tip, motor)
}

/// The shapes of the first modes.
fn modes(shapes: Vec<ModeShape>, model: &Model) -> LinePlot {
    let mut plot = LinePlot::new(
        "Modes with the motor clamped",
        Axis::linear("distance from the motor's axis (m)"),
        Axis::linear("deflection (largest: 1)"),
    );
    for (k, shape) in shapes.into_iter().enumerate() {
        let role = Role::Other(u8::try_from(k).unwrap_or(0));
        let omega = model.natural_frequencies_rad_s.get(k).copied().unwrap_or(0.0);
        let label = format!("{} rad/s", shown(omega, 4));
        let (x, y) = shape.line.into_iter().unzip();
        plot = plot.trace(Trace::line(label, role, x, y));
        if !shape.points.is_empty() {
            let (x, y) = shape.points.into_iter().unzip();
            plot = plot.trace(Trace::new("", role, TraceStyle::Points, x, y));
        }
    }
    plot
}

/// Plot of |s| of the first poles and zeros over the load.
fn payload(cases: &[PayloadCase]) -> LinePlot {
    let mut order: Vec<&PayloadCase> = cases.iter().collect();
    order.sort_by(|a, b| a.tip_mass_kg.total_cmp(&b.tip_mass_kg));
    let load = "load at the tip (kg)";
    let empty = order.iter().any(|case| case.tip_mass_kg == 0.0);
    let mut plot = LinePlot::new(
        "Poles and zeros of the tip's response over its load",
        if empty { Axis::linear(load) } else { Axis::log(load) },
        Axis::log("|s| (rad/s)"),
    );
    let mut add = |name: &str, role: Role, value: &dyn Fn(&PayloadCase, usize) -> Option<f64>| {
        for k in 0..DRAWN {
            let points = order.iter().filter_map(|case| Some((case.tip_mass_kg, value(case, k)?)));
            let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
            if x.is_empty() {
                continue;
            }
            let label = if k == 0 { name } else { "" };
            let line = Trace::line("", role, x.clone(), y.clone());
            let points = Trace::new(label, role, TraceStyle::Points, x, y);
            plot = std::mem::take(&mut plot).trace(line).trace(points);
        }
    };
    add("poles (motor clamped)", Role::Corrected, &|case, k| {
        case.natural_frequencies_rad_s.get(k).copied()
    });
    for (kind, name, role) in [
        (RootClass::Imaginary, "zeros ±jω (a)", Role::Fitted),
        (RootClass::Real, "zeros ±σ (b)", Role::Raw),
        (RootClass::Quadruple, "zeros ±σ ± jω (c)", Role::Other(0)),
    ] {
        add(name, role, &|case, k| of_class(&case.zeros, kind).nth(k).map(|z| z.sqrt().norm()));
    }
    plot
}

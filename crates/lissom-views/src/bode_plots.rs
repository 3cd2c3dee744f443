//! Bode plots of a result.

use lissom::identify::NORMAL_95;
use lissom::lti::{CoefficientCovariance, TransferFunction};
use lissom::record::TipQuantity;
use lissom_io::result::{SeriesEntry, TipResponseEntry};
use lissom_io::{ResultFile, UnitNames};
use lissom_report::{BodePlot, Role, Series, Style};
use num_complex::Complex64;

use crate::known_arm::Reference;

/// What the band of a line shows.
const BAND: &str = "; band of the line: 95 %";
/// Number of points on the line of a model, without those near its poles and zeros.
const LINE: i32 = 240;
/// Number of points near each pole and zero.
const NEAR_ROOT: i32 = 24;
/// Reach of these points, in half widths of a resonance.
const REACH: f64 = 12.0;

/// A point of a response.
struct Point {
    omega_rad_s: f64,
    value: Complex64,
    std: f64,
    flagged: bool,
}

/// The plots of motor and tips, each with its file name. `reference` adds a line for a known arm.
pub fn bode_plots(
    names: UnitNames,
    result: &ResultFile,
    reference: Option<&Reference>,
) -> Vec<(String, BodePlot)> {
    let responses = &result.frequency_response;
    if responses.omega_rad_s.is_empty() {
        return Vec::new();
    }
    let mut plots = vec![("bode-motor".to_owned(), motor(names, result, reference))];
    for (i, tip) in responses.tips.iter().enumerate() {
        let points = points(result, &tip.series);
        if !points.is_empty() {
            let file = format!("bode-tip-{}", i + 1);
            plots.push((file, tip_plot(i, tip, &points, result, reference)));
        }
    }
    plots
}

/// The points of a response that have a value.
fn points(result: &ResultFile, series: &SeriesEntry) -> Vec<Point> {
    let responses = &result.frequency_response;
    let point = |(k, omega_rad_s): (usize, &f64)| {
        let at = |list: &[Option<f64>]| list.get(k).copied().flatten();
        let value = Complex64::new(at(&series.re)?, at(&series.im)?);
        let flagged = responses.flagged.get(k).copied().unwrap_or(false);
        Some(Point { omega_rad_s: *omega_rad_s, value, std: at(&series.std)?, flagged })
    };
    responses.omega_rad_s.iter().enumerate().filter_map(point).collect()
}

/// The model of the motor; none if its inertia is refused, which the model then contains.
pub(crate) fn motor_model(result: &ResultFile) -> Option<&TransferFunction> {
    result.models.motor.as_ref().filter(|_| result.drive.inertia.is_some())
}

/// A transfer function of a result.
pub(crate) fn function(num: &[f64], den: &[f64]) -> TransferFunction {
    TransferFunction { num: num.to_vec(), den: den.to_vec() }
}

/// The line of a model with a delay.
fn line(function: &TransferFunction, delay_s: f64, grid: &[f64]) -> Vec<Complex64> {
    let at = |w: &f64| function.response(*w) * Complex64::cis(-w * delay_s);
    grid.iter().map(at).collect()
}

/// The line of a model with a delay, and its 95 % band where the covariance of its coefficients is known.
fn fitted(
    function: &TransferFunction,
    delay_s: f64,
    covariance: Option<&Vec<Vec<f64>>>,
    grid: &[f64],
) -> Series {
    let response = line(function, delay_s, grid);
    let covariance = covariance.and_then(|rows| CoefficientCovariance::of_rows(rows));
    let series = Series::new("fitted model", Role::Fitted, Style::Line, grid.to_vec(), response);
    let covariance = covariance.filter(|covariance| covariance.fits(function));
    let Some(covariance) = covariance else { return series };
    let half_widths = |w: &f64| {
        let error = covariance.of_response(function, *w);
        error.map_or([f64::NAN; 2], |e| {
            [e.relative_magnitude, e.phase_rad].map(|std| NORMAL_95 * std)
        })
    };
    series.with_band(grid.iter().map(half_widths).collect())
}

fn motor(names: UnitNames, result: &ResultFile, reference: Option<&Reference>) -> BodePlot {
    let unit = format!("{}/{}", names.angle(), names.command_unit());
    let title = format!("Motor: {} per {}", names.motion(), names.command_name());
    let responses = &result.frequency_response;
    let raw = points(result, &responses.motor_raw);
    let mut plot = BodePlot::new(title, unit).series(Series::new(
        "as measured",
        Role::Raw,
        Style::Points,
        raw.iter().map(|p| p.omega_rad_s).collect(),
        raw.iter().map(|p| p.value).collect(),
    ));
    let sound = points(result, &responses.motor_corrected);
    if !sound.is_empty() {
        let flagged = sound.iter().any(|p| p.flagged);
        let note = if flagged { "flagged: a finding affects the point; " } else { "" };
        let band = result.models.motor_covariance.as_ref().map_or("", |_| BAND);
        plot = plot.subtitle(format!("{note}bars: one standard error{band}"));
        let series = Series::new(
            "friction removed",
            Role::Corrected,
            Style::PointsWithBars,
            sound.iter().map(|p| p.omega_rad_s).collect(),
            sound.iter().map(|p| p.value).collect(),
        );
        plot = plot.series(
            series
                .with_std(sound.iter().map(|p| p.std).collect())
                .with_flags(sound.iter().map(|p| p.flagged).collect()),
        );
    }
    let grid = grid(result);
    if let Some(model) = motor_model(result) {
        let delay_s = result.models.motor_delay_s.as_ref().map_or(0.0, |delay| delay.value);
        let model = function(&model.num, &model.den);
        plot = plot.series(fitted(&model, delay_s, result.models.motor_covariance.as_ref(), &grid));
    }
    if let Some((label, arm)) = reference.and_then(|r| Some((r.label, r.arm.as_ref()?))) {
        let exact: Vec<(f64, Complex64)> =
            grid.iter().map(|w| (*w, arm.motor_response(*w))).collect();
        plot = plot.series(known(label, &exact));
    }
    plot
}

fn tip_plot(
    i: usize,
    tip: &TipResponseEntry,
    points: &[Point],
    result: &ResultFile,
    reference: Option<&Reference>,
) -> BodePlot {
    let what = tip.quantity.name();
    let measured = Series::new(
        "as measured",
        Role::Corrected,
        Style::PointsWithBars,
        points.iter().map(|p| p.omega_rad_s).collect(),
        points.iter().map(|p| p.value).collect(),
    )
    .with_std(points.iter().map(|p| p.std).collect());
    let title = format!("Beam: {what} of {} per motor angle", tip.name);
    let mut plot = BodePlot::new(title, "").series(measured);
    let grid = grid(result);
    // The model of a calibrated deflection is that of its angle.
    let model = result.models.tips.get(i);
    if let Some(model) = model.filter(|_| tip.quantity != TipQuantity::Deflection) {
        if model.covariance.is_some() {
            plot = plot.subtitle(format!("bars: one standard error{BAND}"));
        }
        let (of_model, delay_s) = (function(&model.num, &model.den), model.delay_s.unwrap_or(0.0));
        plot = plot.series(fitted(&of_model, delay_s, model.covariance.as_ref(), &grid));
    }
    let known_arm = reference.and_then(|r| Some((r.label, r.arm.as_ref()?)));
    if let Some((label, arm)) = known_arm.filter(|_| tip.quantity == TipQuantity::Angle) {
        let exact: Vec<(f64, Complex64)> =
            grid.iter().filter_map(|w| Some((*w, arm.tip_response(*w).get(i).copied()?))).collect();
        plot = plot.series(known(label, &exact));
    }
    plot
}

/// Frequencies of a model's line, over the range of the data; closer near lightly damped poles and zeros.
fn grid(result: &ResultFile) -> Vec<f64> {
    let models = &result.models;
    let motor = models.motor.as_ref().map(|g| function(&g.num, &g.den));
    let tips = models.tips.iter().map(|tip| function(&tip.num, &tip.den));
    let of_model = |g: TransferFunction| {
        let both = [g.poles(), g.zeros()];
        both.into_iter().flatten().flatten().collect::<Vec<_>>()
    };
    let roots = motor.into_iter().chain(tips).flat_map(of_model).filter(|root| root.im > 0.0);
    // Evenly spaced phases of a resonance.
    let near = |root: Complex64| {
        let end = REACH.atan();
        let phase = move |k: i32| end * f64::from(2 * k - NEAR_ROOT) / f64::from(NEAR_ROOT);
        (0..=NEAR_ROOT).map(move |k| root.im + root.re.abs() * phase(k).tan())
    };
    let omega = || result.frequency_response.omega_rad_s.iter().copied();
    let (low, high) = (omega().fold(f64::INFINITY, f64::min), omega().fold(0.0, f64::max));
    let (low, high) = (low / 1.1, high * 1.1);
    let even = (0..=LINE).map(|k| low * (high / low).powf(f64::from(k) / f64::from(LINE)));
    let close = roots.flat_map(near).filter(|omega| (low..high).contains(omega));
    let mut grid: Vec<f64> = even.chain(close).collect();
    grid.sort_by(f64::total_cmp);
    grid
}

fn known(label: &str, exact: &[(f64, Complex64)]) -> Series {
    let (omega, response) = exact.iter().copied().unzip();
    Series::new(label, Role::Truth, Style::Line, omega, response)
}

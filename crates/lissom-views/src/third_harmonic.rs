//! Coulomb friction by the third harmonic: plot and table of the pairs of runs.

use lissom_io::result::{EstimateEntry, SinePairEntry};
use lissom_io::{ResultFile, UnitNames};
use lissom_report::{Axis, Band, Cells, LinePlot, Quantity, Role, Table, Trace, significant};

/// Plot of the estimate from each pair of runs over its frequency; `None` without this method.
pub fn pair_plot(names: UnitNames, result: &ResultFile) -> Option<LinePlot> {
    let axis = Axis::log("ω0 (rad/s)").quantity(Quantity::FrequencyRadPerSecond);
    plot_over(names, result, axis, "frequency", |pair| Some(pair.omega_rad_s))
}

/// The same over the amplitude of the motor's motion in the run at the lower frequency; `None` if an amplitude is missing.
pub fn pair_plot_over_amplitude(names: UnitNames, result: &ResultFile) -> Option<LinePlot> {
    let amplitude = |pair: &SinePairEntry| {
        let run = result.runs.iter().find(|run| run.name == pair.run)?;
        Some(run.sinusoid.as_ref()?.amplitude.value)
    };
    let axis = Axis::log(format!("amplitude of the motor ({})", names.angle()));
    plot_over(names, result, axis, "amplitude", amplitude)
}

fn plot_over(
    names: UnitNames,
    result: &ResultFile,
    axis: Axis,
    over: &str,
    abscissa: impl Fn(&SinePairEntry) -> Option<f64>,
) -> Option<LinePlot> {
    let third = result.methods.third_harmonic.as_ref()?;
    let mean = &third.coulomb;
    let [low, high] = mean.ci95;
    let trace = Trace::points_with_bars(
        "each pair",
        Role::Corrected,
        third.pairs.iter().map(abscissa).collect::<Option<_>>()?,
        third.pairs.iter().map(|p| p.coulomb.value).collect(),
        third.pairs.iter().map(|p| p.coulomb.std).collect(),
    )
    .with_flags(third.pairs.iter().map(|p| !p.used).collect());
    let unit = names.command_unit();
    let plot = LinePlot::new(
        format!("Coulomb friction by the third harmonic over {over}"),
        axis,
        Axis::linear(format!("Coulomb friction ({unit})")),
    )
    .band(Band::new("mean, 95 % interval", Role::Fitted, mean.value, (low, high)))
    .trace(trace);
    Some(plot)
}

/// Table of the estimates from the pairs, with the cost of each.
pub fn pair_table(names: UnitNames, result: &ResultFile) -> Table {
    let unit = names.command_unit();
    let coulomb = format!("Coulomb friction ({unit})");
    let mut table = Table::new(
        "Estimate from each pair, and the minimum of the cost (29)",
        &[
            ("run at ω0", Cells::Text),
            ("run at 3·ω0", Cells::Text),
            ("ω0 (rad/s)", Cells::Numbers),
            (&coulomb, Cells::Numbers),
            ("standard error", Cells::Numbers),
            ("cost", Cells::Numbers),
            ("", Cells::Text),
        ],
    );
    let shown = |e: &EstimateEntry| [e.value, e.std].map(|value| format!("{value:.5}"));
    if let Some(third) = &result.methods.third_harmonic {
        for p in &third.pairs {
            let [coulomb, std] = shown(&p.coulomb);
            table = table.row([
                p.run.clone(),
                p.triple_run.clone(),
                format!("{:.4}", p.omega_rad_s),
                coulomb,
                std,
                significant(p.cost, 3),
                (if p.used { "" } else { "left out" }).to_owned(),
            ]);
        }
        let [coulomb, std] = shown(&third.coulomb);
        table = table.row([
            "mean".to_owned(),
            String::new(),
            String::new(),
            coulomb,
            std,
            String::new(),
            format!("spread {:.5}", third.spread.value),
        ]);
    }
    table
}

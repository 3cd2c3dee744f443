//! Coulomb friction by the third harmonic: plot and table of the pairs of runs.

use lissom::identify::Identified;
use lissom_io::UnitNames;
use lissom_report::{Axis, Band, Cells, LinePlot, Role, Table, Trace, significant};

/// Plot of the estimate from each pair of runs over its frequency; `None` without this method.
pub fn pair_plot(names: UnitNames, id: &Identified) -> Option<LinePlot> {
    let third = id.third_harmonic.as_ref()?;
    let mean = third.coulomb_command;
    let [low, high] = mean.ci95();
    let trace = Trace::points_with_bars(
        "each pair",
        Role::Corrected,
        third.pairs.iter().map(|p| p.omega_rad_s).collect(),
        third.pairs.iter().map(|p| p.coulomb_command.value).collect(),
        third.pairs.iter().map(|p| p.coulomb_command.std).collect(),
    )
    .with_flags(third.used.iter().map(|u| !u).collect());
    let unit = names.command_unit();
    let plot = LinePlot::new(
        "Coulomb friction by the third harmonic",
        Axis::log("ω0 (rad/s)"),
        Axis::linear(format!("Coulomb friction ({unit})")),
    )
    .band(Band::new("mean, 95 % interval", Role::Fitted, mean.value, (low, high)))
    .trace(trace);
    Some(plot)
}

/// Table of the estimates from the pairs, with the cost of each.
pub fn pair_table(names: UnitNames, id: &Identified) -> Table {
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
    if let Some(third) = &id.third_harmonic {
        for (p, used) in third.pairs.iter().zip(&third.used) {
            table = table.row([
                id.runs[p.run].name.clone(),
                id.runs[p.triple_run].name.clone(),
                format!("{:.4}", p.omega_rad_s),
                format!("{:.5}", p.coulomb_command.value),
                format!("{:.5}", p.coulomb_command.std),
                significant(p.cost, 3),
                (if *used { "" } else { "left out" }).to_owned(),
            ]);
        }
        table = table.row([
            "mean".to_owned(),
            String::new(),
            String::new(),
            format!("{:.5}", third.coulomb_command.value),
            format!("{:.5}", third.coulomb_command.std),
            String::new(),
            format!("spread {:.5}", third.spread_command),
        ]);
    }
    table
}

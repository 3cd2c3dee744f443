//! `lissom equivalent CAMPAIGN|FRF...`: the equivalent arm of Section 4 of the 1989 report, from measured responses.

use std::path::Path;

use lissom::beam::{BestPoint, DistributedBeam};
use lissom::identify::{EquivalentError, EquivalentRefusal, equivalent};
use lissom_io::write::{self, Batch};
use lissom_io::{ArmFile, BeamKind, EquivalentFile};
use lissom_views::equivalent_plots;

use super::saved_arm;
use crate::args::equivalent_args::EquivalentArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::equivalent_input;
use crate::views::plot_file::Picture;
use crate::views::{equivalent_table, finding_list, printer};

pub(crate) fn run(args: &EquivalentArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, None)?;
    if let Some(path) = &args.save_arm {
        output_guard::guard_headed(path, write::ARM_HEAD)?;
    }
    let picture = args.plot.as_deref().map(Picture::of).transpose()?;
    let beside = picture.as_ref().map(|p| p.beside("motor"));
    let pictures = picture.iter().chain(&beside).map(Picture::path);
    let outputs = json_file.into_iter().chain(args.save_arm.as_deref()).chain(pictures);
    output_guard::ready(&outputs.collect::<Vec<_>>())?;
    let beam = args.arm.as_deref().map(beam).transpose()?;
    let input = equivalent_input::read(args)?;
    known(args, &input.data.names)?;
    let found = equivalent(&input.data, args.modes.map(usize::from));
    let found = match found {
        Ok(found) => found,
        Err(source) => {
            let place = better_place(args, beam.as_ref(), &source)?;
            let (input, source) = (args.inputs[0].clone(), Box::new(source));
            return Err(Failure::Equivalent { input, source, place });
        }
    };
    let mut batch = Batch::new();
    if let Some(path) = json_file {
        let value = EquivalentFile::of(input.names, &found);
        batch.file(path, write::json_text(path, &value)?.as_bytes())?;
    }
    if let Some(path) = &args.save_arm {
        batch.file(path, saved_arm::text(&args.inputs[0], &input, &found)?.as_bytes())?;
    }
    if let Some(picture) = &picture {
        picture.draw(&mut batch, &equivalent_plots::points(&input.data, &found))?;
        if let Some(plot) = equivalent_plots::motor(&input.data, input.names, &found) {
            picture.beside("motor").draw(&mut batch, &plot)?;
        }
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        printer::json(&EquivalentFile::of(input.names, &found))?;
    } else {
        equivalent_table::print(&input, &found);
        finding_list::findings(&found.findings);
    }
    Ok(ExitCode::SUCCESS)
}

/// The beam of known dimensions.
fn beam(path: &Path) -> Result<DistributedBeam, Failure> {
    let file = ArmFile::read(path)?;
    if file.beam_kind(path).map_err(lissom_io::Error::from)? == BeamKind::Lumped {
        let reason = "has point masses, but a place can only be found on a beam with mass along it"
            .to_owned();
        let hint = "give density or mass_per_length in [beam]";
        return Err(Failure::Model { arm: path.to_owned(), reason, hint });
    }
    Ok(file.distributed_beam(path).map_err(lissom_io::Error::from)?)
}

/// Refuses `--at` for unknown points, or twice for one point.
fn known(args: &EquivalentArgs, names: &[String]) -> Result<(), Failure> {
    for (i, (name, _)) in args.at.iter().enumerate() {
        if !names.contains(name) {
            let words =
                format!("--at {name}: there is no such point; the points are {}", names.join(", "));
            return Err(Failure::Asked(words, "give --at NAME=LENGTH once for each point"));
        }
        if args.at[..i].iter().any(|(other, _)| other == name) {
            let words = format!("--at {name}: is given twice");
            return Err(Failure::Asked(words, "give --at NAME=LENGTH once for each point"));
        }
    }
    Ok(())
}

/// A better place for one of two points that move alike, on a beam of known dimensions.
fn better_place(
    args: &EquivalentArgs,
    beam: Option<&DistributedBeam>,
    refusal: &EquivalentRefusal,
) -> Result<Option<String>, Failure> {
    let EquivalentRefusal::Beam { source, names, .. } = refusal else { return Ok(None) };
    let (EquivalentError::TooClose { first, second, .. }, Some(beam), Some(path)) =
        (source, beam, &args.arm)
    else {
        return Ok(None);
    };
    let mut points_m = Vec::new();
    for name in names {
        let Some((_, place)) = args.at.iter().find(|(n, _)| n == name) else {
            let words = format!("--at does not give the place of {name}");
            return Err(Failure::Asked(words, "give --at NAME=LENGTH once for each point"));
        };
        points_m.push(*place);
    }
    let mut best: Option<(usize, BestPoint)> = None;
    for moved in [*first, *second] {
        let found = beam.best_point(&points_m, moved).map_err(|source| Failure::Model {
            arm: path.clone(),
            reason: source.to_string(),
            hint: "give the points' distances from the axis with --at",
        })?;
        if best.is_none_or(|(_, b)| found.least > b.least) {
            best = Some((moved, found));
        }
    }
    Ok(best.map(|(moved, found)| {
        format!(
            "put {} at {:.4} m instead of {:.4} m: the smallest singular value of the gains is then {:.3} instead of {:.1e}",
            names[moved], found.position_m, points_m[moved], found.least, found.least_now
        )
    }))
}

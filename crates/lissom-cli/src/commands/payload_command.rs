//! `lissom payload CAMPAIGN`: an arm that was identified with one payload, predicted with others.

use std::path::Path;

use lissom::identify::{Identified, LoadedArm, OutputError};
use lissom::record::{Axis, Channels};
use lissom_io::write::{self, Batch};
use lissom_io::{PayloadFile, PayloadPrediction, PredictedPayload, read_campaign};
use lissom_views::payload_plot;

use crate::args::payload_args::PayloadArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::identification::{Asked, identified};
use crate::views::plot_file::Picture;
use crate::views::{finding_list, payload_table, printer};

/// Number of logarithmic steps in the frequencies of the responses.
const FREQUENCIES: i32 = 400;
/// Factor by which the responses extend beyond the modes on both sides.
const PLOTTED_BEYOND: f64 = 3.0;

pub(crate) fn run(args: &PayloadArgs) -> Result<ExitCode, Failure> {
    let json = args.json.as_deref();
    let json_file = json.filter(|path| *path != Path::new(STDOUT));
    output_guard::guard(json_file, None)?;
    let picture = args.plot.as_deref().map(Picture::of).transpose()?;
    let outputs = json_file.into_iter().chain(picture.as_ref().map(Picture::path));
    output_guard::ready(&outputs.collect::<Vec<_>>())?;
    let is_toml = args.campaign.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    if !is_toml && args.campaign.is_file() {
        let words = format!("{}: is not a campaign.toml", args.campaign.display());
        let hint = "give the campaign.toml that describes the columns and units of the logs";
        return Err(Failure::Asked(words, hint));
    }
    let file = read_campaign(&args.campaign)?;
    let place = PayloadPlace::of(args, &file.campaign.channels)?;
    let id = identified(&args.campaign, &file, Asked::default())?;
    let found = predicted(args, &file.campaign.channels, &place, &id)?;
    let mut batch = Batch::new();
    if let Some(path) = json_file {
        let value = PayloadFile::of(&found);
        batch.file(path, write::json_text(path, &value)?.as_bytes())?;
    }
    if let Some(picture) = &picture {
        picture.draw(&mut batch, &payload_plot::tip(&found))?;
    }
    batch.commit()?;
    if json.is_some() && json_file.is_none() {
        printer::json(&PayloadFile::of(&found))?;
    } else {
        payload_table::table(&found);
        finding_list::findings(&found.findings);
    }
    Ok(ExitCode::SUCCESS)
}

/// The place of the payload.
struct PayloadPlace {
    tip: usize,
    distance_m: Option<f64>,
}

impl PayloadPlace {
    fn of(args: &PayloadArgs, channels: &Channels) -> Result<Self, Failure> {
        let refused = |words: String, hint| Err(Failure::Asked(words, hint));
        let names: Vec<&str> = channels.tips.iter().map(|t| t.name.as_str()).collect();
        let Some(last) = names.len().checked_sub(1) else {
            let words = format!("{}: has no tip", args.campaign.display());
            return refused(words, "add the tip at which the payload is fixed to [signals]");
        };
        let named = |name: &String| names.iter().position(|n| n == name);
        let Some(tip) = args.tip.as_ref().map_or(Some(last), named) else {
            let words = format!("--tip is none of the tips of the campaign: {}", names.join(", "));
            return refused(words, "give one of these names");
        };
        match (channels.axis, args.at) {
            (Axis::Rotary, None) => refused(
                "the distance of the payload from the axis is not given".to_owned(),
                "add --at LENGTH: the payload's inertia is its mass times the square of this distance",
            ),
            (Axis::Linear, Some(_)) => refused(
                "--at is a distance from a rotary axis, but this axis is linear".to_owned(),
                "leave out --at",
            ),
            (_, distance_m) => Ok(Self { tip, distance_m }),
        }
    }

    /// What a mass adds to the inertia of the point \[kg·m²\], on a linear axis to its mass \[kg\].
    fn added(&self, mass_kg: f64) -> f64 {
        self.distance_m.map_or(mass_kg, |r| mass_kg * r * r)
    }
}

fn predicted(
    args: &PayloadArgs,
    channels: &Channels,
    place: &PayloadPlace,
    id: &Identified,
) -> Result<PayloadPrediction, Failure> {
    let refused = |words: String, hint| Failure::Asked(words, hint);
    let stands = |oe: &&OutputError| oe.stands() && channels.tips[place.tip].calibrated;
    let Some(oe) = id.output_error.as_ref().filter(stands) else {
        let words = format!("{}: no identified arm describes the runs", args.campaign.display());
        return Err(refused(words, "run `lissom identify` on this campaign and read its findings"));
    };
    let load = |to_kg: f64| -> Result<LoadedArm, Failure> {
        oe.with_load(place.tip, place.added(to_kg - args.mass)).ok_or_else(|| {
            let words = format!("{to_kg} kg instead of {} kg cannot be predicted", args.mass);
            refused(words, "check --mass and --at: the identified arm has less inertia at this point than they remove")
        })
    };
    let loaded = args.to.iter().map(|m| load(*m)).collect::<Result<Vec<_>, _>>()?;
    let omega = loaded.iter().flat_map(|l| l.modes.iter().map(|m| m.natural_frequency_rad_s.value));
    let (low, high) = omega.fold((f64::INFINITY, 0.0_f64), |(a, b), w| (a.min(w), b.max(w)));
    let (low, high) = (low / PLOTTED_BEYOND, high * PLOTTED_BEYOND);
    let step = |k: i32| low * (high / low).powf(f64::from(k) / f64::from(FREQUENCIES));
    let omega_rad_s: Vec<f64> = (0..=FREQUENCIES).map(step).collect();
    let mut payloads = Vec::new();
    for (mass_kg, loaded) in args.to.iter().copied().zip(loaded) {
        let at = (place.tip, loaded.added_kg_m2);
        let tip = oe.loaded_tip_response(at, place.tip, &omega_rad_s).ok_or_else(|| {
            refused(
                format!("the standard error of the response with {mass_kg} kg cannot be computed"),
                "add runs that excite the modes: the identified arm is too uncertain",
            )
        })?;
        payloads.push(PredictedPayload { mass_kg, loaded, tip });
    }
    let caveat = payloads.first().map(|p| p.loaded.caveat());
    Ok(PayloadPrediction {
        tip: channels.tips[place.tip].name.clone(),
        distance_m: place.distance_m,
        mass_kg: args.mass,
        omega_rad_s,
        payloads,
        findings: caveat.into_iter().chain(id.findings.iter().cloned()).collect(),
    })
}

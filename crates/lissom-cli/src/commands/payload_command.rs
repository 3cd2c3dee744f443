//! `lissom payload CAMPAIGN`: an arm that was identified with one payload, predicted with others.

use std::path::Path;

use lissom::{Payloads, predict_payload};
use lissom_io::write::{self, Batch};
use lissom_io::{PayloadFile, read_campaign};
use lissom_views::payload_plot;

use crate::args::payload_args::PayloadArgs;
use crate::args::stdout_name::STDOUT;
use crate::shared::exit_codes::ExitCode;
use crate::shared::failure::Failure;
use crate::shared::output_guard;
use crate::tasks::identification::{Asked, identified};
use crate::views::plot_file::Picture;
use crate::views::{finding_list, payload_table, printer};

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
    let asked = Payloads {
        mass_kg: args.mass,
        to_kg: args.to.clone(),
        at_m: args.at,
        tip: args.tip.clone(),
    };
    let refused = |source| Failure::Payload { campaign: args.campaign.clone(), source };
    asked.place(&file.campaign.channels).map_err(refused)?;
    let id = identified(&args.campaign, &file, Asked::default())?;
    let found = predict_payload(&file.campaign.channels, &id, &asked).map_err(refused)?;
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

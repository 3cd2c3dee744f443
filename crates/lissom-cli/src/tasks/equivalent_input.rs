//! Input of `lissom equivalent`: responses from a campaign or from tables.

use std::path::Path;

use lissom::identify::Effort;
use lissom::{EquivalentInput, EquivalentInputError};
use lissom_io::{read_campaign, read_responses};

use super::identification::{Asked, identified};
use crate::args::equivalent_args::EquivalentArgs;
use crate::shared::failure::Failure;

/// Reads the input.
pub(crate) fn read(args: &EquivalentArgs) -> Result<EquivalentInput, Failure> {
    let is_toml = |p: &Path| p.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    if args.inputs.iter().any(|p| is_toml(p)) {
        if args.inputs.len() > 1 {
            let words = "a campaign.toml cannot be combined with other inputs".to_owned();
            return Err(Failure::Asked(words, "give one campaign.toml, or tables only"));
        }
        if args.torque_constant.is_some() {
            let words =
                "--torque-constant is for tables, but the input is a campaign.toml".to_owned();
            let hint = "give torque_constant in the [drive] of the campaign.toml";
            return Err(Failure::Asked(words, hint));
        }
        return campaign(&args.inputs[0], args.quick);
    }
    let read = read_responses(&args.inputs).map_err(lissom_io::Error::from)?;
    EquivalentInput::of_responses(&read, args.torque_constant.as_deref()).map_err(|error| {
        let words = match &error {
            EquivalentInputError::TorqueConstant { reason } => {
                format!("--torque-constant: {reason}")
            }
            other => other.to_string(),
        };
        Failure::Asked(words, error.hint())
    })
}

fn campaign(path: &Path, quick: bool) -> Result<EquivalentInput, Failure> {
    let file = read_campaign(path)?;
    let effort = if quick { Effort::Quick } else { Effort::Normal };
    let id = identified(path, &file, Asked { effort, ..Asked::default() })?;
    EquivalentInput::of_campaign(&file.campaign, &id).map_err(|source| Failure::Equivalent {
        input: path.to_owned(),
        source: Box::new(source),
        place: None,
    })
}

//! Time stamps and samples of a log: what is wrong with them. What was done to them is in [`note`](crate::record::note).

use lissom_text::significant;

use crate::finding::Severity::Warning;
use crate::finding::findings;
use crate::finding::result_key as key;

findings! {
    /// A run has the same samples as an earlier one.
    "repeated-run" RepeatedRun { first: String }
        Warning, [key::RAW_RESPONSE],
        format!("all samples are equal to those of {first}: this run is not used"),
        "remove it from the campaign: a log that counts twice makes standard errors too small";

    /// Time stamps are not evenly spaced.
    "uneven-stamps" Jitter { rms_share: f64, max_share: f64 }
        Warning, [key::INERTIA, key::VISCOUS, key::RAW_RESPONSE],
        format!("time stamps differ from an even grid by {:.1} % of the sample time (rms; at most {:.0} %): samples are taken \
            as evenly spaced", 100.0 * rms_share, 100.0 * max_share),
        "use the clock of the controller for the time stamps";

    /// The sample time of a run is far from that of the other runs.
    "time-unit" SampleTimeUnlike { sample_time_s: f64, median_s: f64 }
        Warning, key::WHOLE_ARM,
        format!("the sample time of this run is {} s, that of the runs in general {} s: its time stamps may be in another \
            unit", significant(*sample_time_s, 3), significant(*median_s, 3)),
        "check the unit of time in this log; give a log with another unit in a campaign of its own";

    /// The samples are as far apart, or as close together, as no log of a drive has them.
    "time-unit" TimeUnit { sample_time_s: f64 }
        Warning, key::WHOLE_ARM,
        format!("the samples are {} s apart, which no log of a drive is: the time stamps are probably in another unit",
            significant(*sample_time_s, 3)),
        "check the unit of time; stamps that grow by 1 or 2 are often milliseconds, by 1000 or more microseconds";

    /// The command follows the motor as a position goal does.
    "command-follows-motor" CommandFollowsMotor { correlation: f64 }
        Warning, [key::INERTIA, key::VISCOUS, key::COULOMB],
        format!("the command follows the motor's angle (correlation {correlation:.4}): it looks like the position goal of a \
            servo. If it is one, all estimates are wrong"),
        "if the command is a position goal, give it `quantity = \"goal\"`; nothing to do if a spring or gravity holds the motor";
}

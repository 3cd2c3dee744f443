//! A campaign prepared for the methods: the kind of each run, and the runs that are used.

use std::borrow::Cow;

use rayon::prelude::*;

use crate::identify::findings::{Channel, Finding, rows};
use crate::identify::options::Options;
use crate::identify::prepare::log_check::{command_follows_motor, one_jitter_for_each_log};
use crate::identify::prepare::run_analysis::{RunAnalysis, analyse};
use crate::identify::prepare::run_noise::RunNoise;
use crate::identify::prepare::tip_zero::without_tip_zeros;
use crate::record::extent::range;
use crate::record::{Campaign, Run, Tip};

/// Accelerations are taken over this part of the shortest run.
const ACCELERATIONS_IN_RUN: f64 = 100.0;

/// A campaign prepared once for all methods.
///
/// Runs with a dead channel and repeated runs are left out. A tip that is dead in all runs counts as a tip that
/// measures no angle. Runs at constant velocity are used only if they accelerate more than all others.
#[derive(Debug, Clone)]
pub struct Prepared<'a> {
    campaign: &'a Campaign,
    runs: Vec<RunAnalysis>,
    kept: Vec<usize>,
    used: Cow<'a, Campaign>,
    noise: Vec<RunNoise>,
    /// By how much each tip is read later than the motor, which is taken out of the runs used \[s\]; empty if none is.
    tip_lags_s: Vec<f64>,
    findings: Vec<Finding>,
}

impl<'a> Prepared<'a> {
    /// Checks and analyses every run, several at a time. `progress` is called with the number of
    /// each run before it is analysed.
    pub fn new(campaign: &'a Campaign, options: &Options, mut progress: impl FnMut(usize)) -> Self {
        let mut findings = Vec::new();
        let mut runs = Vec::with_capacity(campaign.runs.len());
        let dead = dead_everywhere(campaign);
        let harmonics = options.highest_harmonic();
        let indices: Vec<usize> = (0..campaign.runs.len()).collect();
        for together in indices.chunks(4 * rayon::current_num_threads()) {
            for index in together {
                progress(*index);
            }
            let of_run = |&index: &usize| {
                let mut found = Vec::new();
                (analyse(campaign, index, harmonics, &dead, &mut found), found)
            };
            let analysed: Vec<_> = together.par_iter().with_max_len(1).map(of_run).collect();
            for (run, found) in analysed {
                runs.push(run);
                findings.extend(found);
            }
        }
        findings.extend(dead_tips(campaign, &dead));
        findings.extend(command_follows_motor(campaign, &runs));
        one_jitter_for_each_log(&mut findings);
        let kept = kept(campaign, &runs);
        let mut used = used_runs(campaign, &kept, &dead);
        if let Some((straight, found)) = without_tip_zeros(&used) {
            used = Cow::Owned(straight);
            findings.extend(found);
        }
        let noise = used.runs.par_iter().map(RunNoise::of).collect();
        Self { campaign, runs, kept, used, noise, tip_lags_s: Vec::new(), findings }
    }

    /// Prepares a campaign with default options and without progress.
    pub fn of(campaign: &'a Campaign) -> Self {
        Self::new(campaign, &Options::default(), |_run| ())
    }

    /// The campaign as it was logged.
    pub fn campaign(&self) -> &'a Campaign {
        self.campaign
    }

    /// Analysis of each run of the campaign.
    pub fn runs(&self) -> &[RunAnalysis] {
        &self.runs
    }

    /// The runs that the methods use.
    pub fn used(&self) -> &Campaign {
        &self.used
    }

    /// The same without one of the runs used, and with what was found in it.
    #[must_use]
    pub(crate) fn without(mut self, used: usize, finding: Finding) -> Self {
        let index = self.kept[used];
        self.runs[index].usable = false;
        self.kept.remove(used);
        self.noise.remove(used);
        self.used.to_mut().runs.remove(used);
        self.findings.push(finding);
        self
    }

    /// The same for methods that use other logs of these runs.
    #[must_use]
    pub(crate) fn using(&self, used: Campaign) -> Self {
        Self { used: Cow::Owned(used), ..self.clone() }
    }

    /// The same with the readings of a tip taken earlier, which are too late by `lag_s`.
    #[must_use]
    pub(crate) fn with_tip_taken_earlier(&self, tip: usize, lag_s: f64) -> Self {
        let used = self.used();
        let runs = used.runs.iter().map(|run| run.clone().with_tip_taken_earlier(tip, lag_s));
        let mut earlier = self.using(Campaign { runs: runs.collect(), ..used.clone() });
        earlier.tip_lags_s.resize(used.channels.tips.len(), 0.0);
        earlier.tip_lags_s[tip] += lag_s;
        earlier
    }

    /// By how much each tip is read later than the motor, which is taken out of the runs used \[s\]; empty if none is.
    pub(crate) fn tip_lags_s(&self) -> &[f64] {
        &self.tip_lags_s
    }

    /// Indices of the used runs in the campaign.
    pub fn kept(&self) -> &[usize] {
        &self.kept
    }

    /// Findings about the runs.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Noise of the sensors in each of the runs used.
    pub(crate) fn noise(&self) -> &[RunNoise] {
        &self.noise
    }

    /// Whether every usable run is at constant velocity.
    pub(crate) fn has_only_constant_velocities(&self) -> bool {
        !self.runs.iter().any(|r| r.usable && !r.is_constant_velocity())
    }

    /// Channels that are constant in some runs, and in how many.
    pub(crate) fn constant_channels(&self) -> Vec<(String, usize)> {
        constant_channels(self.campaign)
    }

    /// What each run of the campaign is.
    pub(crate) fn into_runs(self) -> Vec<RunAnalysis> {
        self.runs
    }
}

/// Channels that are constant in some runs, and in how many.
fn constant_channels(campaign: &Campaign) -> Vec<(String, usize)> {
    let count = |channel: &dyn Fn(&Run) -> &[f64]| {
        campaign.runs.iter().filter(|run| range(channel(run)) <= 0.0).count()
    };
    let mut constant = vec![
        ("motor".to_owned(), count(&Run::motor)),
        ("command".to_owned(), count(&Run::command)),
    ];
    constant.extend(campaign.channels.tips.iter().enumerate().map(|(i, tip)| {
        (format!("tip \"{}\"", tip.name), count(&|run: &Run| run.tips()[i].as_slice()))
    }));
    constant.retain(|(_, runs)| *runs > 0);
    constant
}

/// Which tips are constant in every run.
fn dead_everywhere(campaign: &Campaign) -> Vec<bool> {
    let dead = |i: usize| campaign.runs.iter().all(|run| range(&run.tips()[i]) <= 0.0);
    (0..campaign.channels.tips.len()).map(dead).collect()
}

/// Findings about tips that are dead in every run.
fn dead_tips(campaign: &Campaign, dead: &[bool]) -> Vec<Finding> {
    let tips = campaign.channels.tips.iter().zip(dead).filter(|(_, dead)| **dead);
    let found = |tip: &Tip| {
        let channel = Channel::Tip(tip.name.clone());
        Finding::new(rows::DeadTip { channel })
    };
    tips.map(|(tip, _)| found(tip)).collect()
}

/// Logs are long: they are copied only where something falls out.
fn used_runs<'a>(campaign: &'a Campaign, kept: &[usize], dead: &[bool]) -> Cow<'a, Campaign> {
    if kept.len() == campaign.runs.len() && !dead.iter().any(|d| *d) {
        return Cow::Borrowed(campaign);
    }
    let mut channels = campaign.channels.clone();
    for (tip, dead) in channels.tips.iter_mut().zip(dead) {
        tip.calibrated &= !dead;
    }
    let runs = kept.iter().map(|&i| campaign.runs[i].clone()).collect();
    let Campaign { gravity, mgl_nm, hold_assumed, .. } = *campaign;
    Cow::Owned(Campaign { channels, runs, gravity, mgl_nm, hold_assumed })
}

/// Runs that the regressions and the output error may use: those at constant velocity only if they accelerate more than all
/// others, as steps do. Their speeds may be outside the working range, where one viscous constant need not hold.
fn kept(campaign: &Campaign, runs: &[RunAnalysis]) -> Vec<usize> {
    let usable: Vec<usize> = (0..runs.len()).filter(|&i| runs[i].usable).collect();
    let lasts_s = |run: &Run| run.len() as f64 * run.sample_time_s();
    let all_s = usable.iter().map(|&i| lasts_s(&campaign.runs[i]));
    let over_s = all_s.fold(f64::INFINITY, f64::min) / ACCELERATIONS_IN_RUN;
    let acceleration = |i: &usize| largest_acceleration(&campaign.runs[*i], over_s);
    let others = usable.iter().filter(|&&i| !runs[i].is_constant_velocity());
    let most = others.map(acceleration).fold(0.0, f64::max);
    let used = |i: &usize| !runs[*i].is_constant_velocity() || acceleration(i) > most;
    usable.into_iter().filter(used).collect()
}

/// Largest acceleration of the motor, by angles so much time apart.
fn largest_acceleration(run: &Run, over_s: f64) -> f64 {
    let reach = ((over_s / run.sample_time_s()) as usize).max(1);
    let bend = run.motor().windows(2 * reach + 1).map(|w| w[2 * reach] - 2.0 * w[reach] + w[0]);
    bend.fold(0.0, |most: f64, b| most.max(b.abs())) / (reach as f64 * run.sample_time_s()).powi(2)
}

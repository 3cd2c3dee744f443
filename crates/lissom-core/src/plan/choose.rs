//! Chooses the runs and their lengths: the shortest total time that reaches the requested precision.

use nalgebra::{DMatrix, DVector};

use crate::plan::thresholds::GAIN_LEAST;

/// Information before any run: a standard error of 100 times the scale of each parameter, so that it stays finite for a
/// parameter that no run shows.
const BEFORE: f64 = 1e-4;
/// Largest number of steps.
const STEPS: usize = 200;
/// Largest number of rounds of exchanges.
const ROUNDS: usize = 20;

/// A run that can be chosen: information and time after one, two, … stretches.
#[derive(Debug, Clone)]
pub(super) struct Choice {
    pub(super) information: Vec<DMatrix<f64>>,
    pub(super) time_s: Vec<f64>,
    /// Whether it counts as a pair of sines.
    pub(super) pair: bool,
}

/// The goal: directions in the scaled parameters, and the requested standard error along each.
#[derive(Debug, Clone)]
pub(super) struct Goal {
    pub(super) wanted: Vec<(DVector<f64>, f64)>,
    pub(super) within_s: f64,
    pub(super) pair: bool,
}

/// Number of stretches of each choice; zero leaves it out.
pub(super) type Chosen = Vec<usize>;

impl Goal {
    /// Standard error of each parameter relative to the requested one.
    pub(super) fn ratios(&self, information: &DMatrix<f64>) -> Vec<f64> {
        let n = information.nrows();
        let with = information + DMatrix::identity(n, n) * BEFORE;
        let scale = with.diagonal().map(|d| 1.0 / d.sqrt());
        let scaled = DMatrix::from_fn(n, n, |i, j| with[(i, j)] * scale[i] * scale[j]);
        let Some(cholesky) = scaled.cholesky() else {
            return vec![f64::INFINITY; self.wanted.len()];
        };
        let ratio = |(along, wanted): &(DVector<f64>, f64)| {
            let along = along.component_mul(&scale);
            cholesky.solve(&along).dot(&along).max(0.0).sqrt() / wanted
        };
        self.wanted.iter().map(ratio).collect()
    }

    /// Sum of squares of the ratios; ratios below one count as one.
    fn distance(&self, information: &DMatrix<f64>) -> f64 {
        self.ratios(information).iter().map(|r| r.max(1.0).powi(2)).sum()
    }

    fn is_reached(&self, information: &DMatrix<f64>) -> bool {
        self.ratios(information).iter().all(|r| *r <= 1.0)
    }
}

/// Information of all chosen runs together.
pub(super) fn information(choices: &[Choice], chosen: &Chosen, size: usize) -> DMatrix<f64> {
    choices
        .iter()
        .zip(chosen)
        .filter(|(_, k)| **k > 0)
        .fold(DMatrix::zeros(size, size), |sum, (c, k)| sum + &c.information[k - 1])
}

/// Time of all chosen runs \[s\].
pub(super) fn time_s(choices: &[Choice], chosen: &Chosen) -> f64 {
    choices.iter().zip(chosen).filter(|(_, k)| **k > 0).map(|(c, k)| c.time_s[k - 1]).sum()
}

/// Adds one run or stretch at a time, each time the one that comes closest to the goal for its time. Then runs that have
/// become unnecessary are removed, and runs are exchanged for others that reach the same in less time. Finally the
/// choice is repeated without each of the chosen runs in turn.
pub(super) fn choose(choices: &[Choice], goal: &Goal) -> Chosen {
    let size = goal.wanted.first().map_or(0, |(along, _)| along.len());
    let search = MotionSearch { choices, goal, size, barred: None };
    let mut chosen = vec![0; choices.len()];
    if goal.pair
        && let Some(pair) = search.best_pair()
    {
        chosen[pair] = 1;
    }
    search.settle(&mut chosen);
    for _ in 0..ROUNDS {
        let Some(better) = search.without_one(&chosen) else { break };
        chosen = better;
    }
    chosen
}

struct MotionSearch<'a> {
    choices: &'a [Choice],
    goal: &'a Goal,
    size: usize,
    /// A choice that is not to be taken.
    barred: Option<usize>,
}

impl MotionSearch<'_> {
    fn information(&self, chosen: &Chosen) -> DMatrix<f64> {
        information(self.choices, chosen, self.size)
    }

    /// Whether a choice meets the conditions other than precision: total time, and a pair of sines.
    fn fits(&self, chosen: &Chosen) -> bool {
        let pairs = self.choices.iter().zip(chosen).any(|(c, k)| c.pair && *k > 0);
        let needs = self.goal.pair && self.choices.iter().any(|c| c.pair);
        time_s(self.choices, chosen) <= self.goal.within_s && (pairs || !needs)
    }

    /// The pair of sines with the most information for its time.
    fn best_pair(&self) -> Option<usize> {
        let none = self.goal.distance(&DMatrix::zeros(self.size, self.size));
        let worth = |c: &Choice| (none / self.goal.distance(&c.information[0])).ln() / c.time_s[0];
        let pairs = self.choices.iter().enumerate().filter(|(_, c)| c.pair);
        let in_time = pairs.filter(|(_, c)| c.time_s[0] <= self.goal.within_s);
        in_time.max_by(|a, b| worth(a.1).total_cmp(&worth(b.1))).map(|(i, _)| i)
    }

    fn settle(&self, chosen: &mut Chosen) {
        self.grow(chosen);
        for _ in 0..ROUNDS {
            let before = chosen.clone();
            self.shorten(chosen);
            self.exchange(chosen);
            if *chosen == before {
                break;
            }
        }
    }

    /// Removes a run if the choice is as good without it and takes less time.
    fn without_one(&self, chosen: &Chosen) -> Option<Chosen> {
        let now = self.goal.distance(&self.information(chosen));
        let time = time_s(self.choices, chosen);
        let taken = (0..chosen.len()).filter(|i| chosen[*i] > 0);
        let others = taken.map(|i| {
            let mut other = chosen.clone();
            other[i] = 0;
            Self { barred: Some(i), ..*self }.settle(&mut other);
            other
        });
        let better = others.filter(|other| {
            time_s(self.choices, other) < time * (1.0 - GAIN_LEAST) && self.as_good(other, now)
        });
        better.min_by(|a, b| time_s(self.choices, a).total_cmp(&time_s(self.choices, b)))
    }

    /// The choices that may be taken.
    fn open(&self) -> impl Iterator<Item = (usize, &Choice)> {
        self.choices.iter().enumerate().filter(|(i, _)| self.barred != Some(*i))
    }

    fn grow(&self, chosen: &mut Chosen) {
        for _ in 0..STEPS {
            let information = self.information(chosen);
            if self.goal.is_reached(&information) {
                return;
            }
            let now = self.goal.distance(&information);
            let spent = time_s(self.choices, chosen);
            let mut best: Option<(f64, usize, usize)> = None;
            for (i, choice) in self.open() {
                let had = chosen[i];
                let (without, time) = match had {
                    0 => (information.clone(), 0.0),
                    k => (&information - &choice.information[k - 1], choice.time_s[k - 1]),
                };
                for k in had + 1..=choice.information.len() {
                    let more = choice.time_s[k - 1] - time;
                    if spent + more > self.goal.within_s {
                        continue;
                    }
                    let then = self.goal.distance(&(&without + &choice.information[k - 1]));
                    let worth = (now / then).ln() / more;
                    if now > (1.0 + GAIN_LEAST) * then && best.is_none_or(|b| worth > b.0) {
                        best = Some((worth, i, k));
                    }
                }
            }
            let Some((_, i, k)) = best else { return };
            chosen[i] = k;
        }
    }

    /// Whether `other` is as good as a choice whose distance is `now`.
    fn as_good(&self, other: &Chosen, now: f64) -> bool {
        self.fits(other) && self.goal.distance(&self.information(other)) <= now
    }

    fn shorten(&self, chosen: &mut Chosen) {
        let now = self.goal.distance(&self.information(chosen));
        for i in 0..chosen.len() {
            for k in 0..chosen[i] {
                let mut other = chosen.clone();
                other[i] = k;
                if self.as_good(&other, now) {
                    *chosen = other;
                    break;
                }
            }
        }
    }

    /// Exchanges each chosen run, or its last stretches, for more of any other run if this takes less time.
    fn exchange(&self, chosen: &mut Chosen) {
        let now = self.goal.distance(&self.information(chosen));
        for i in 0..chosen.len() {
            let mut best = (time_s(self.choices, chosen), chosen.clone());
            for left in 0..chosen[i] {
                for (j, choice) in self.open().filter(|(j, _)| *j != i) {
                    for k in chosen[j] + 1..=choice.information.len() {
                        let mut other = chosen.clone();
                        (other[i], other[j]) = (left, k);
                        let time = time_s(self.choices, &other);
                        if time < best.0 && self.as_good(&other, now) {
                            best = (time, other);
                        }
                    }
                }
            }
            *chosen = best.1;
        }
    }
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution as _, StandardUniform};
    use rand_xoshiro::Xoshiro256PlusPlus;
    use rand_xoshiro::rand_core::SeedableRng as _;

    use super::*;

    fn choice(a: f64, b: f64, time_s: f64) -> Choice {
        let one = DMatrix::from_diagonal(&DVector::from_vec(vec![a, b]));
        Choice {
            information: vec![one.clone(), one * 2.0],
            time_s: vec![time_s, 2.0 * time_s],
            pair: false,
        }
    }

    fn goal(within_s: f64) -> Goal {
        let along = |i: usize| DVector::from_fn(2, |j, _| f64::from(i == j));
        Goal { wanted: vec![(along(0), 0.1), (along(1), 0.1)], within_s, pair: false }
    }

    /// Each parameter needs 100: two runs that show one parameter each beat one that shows both slowly.
    #[test]
    fn the_least_time_is_chosen() {
        let choices = [choice(100.0, 0.0, 1.0), choice(0.0, 100.0, 1.0), choice(60.0, 60.0, 4.0)];
        assert_eq!(choose(&choices, &goal(100.0)), [1, 1, 0]);
        assert_eq!(choose(&choices[2..], &goal(100.0)), [2]);
        // One that does all is better than both.
        let all = [choices[0].clone(), choices[1].clone(), choice(101.0, 101.0, 1.5)];
        assert_eq!(choose(&all, &goal(100.0)), [0, 0, 1]);
    }

    /// Against every choice that there is, of sets drawn at random: each run shows a direction or two of
    /// three parameters, and takes its time.
    #[test]
    fn little_time_is_lost_beside_the_best_of_all() {
        let mut next = uniform();
        let mut lost: Vec<f64> = Vec::new();
        while lost.len() < 100 {
            let choices: Vec<Choice> = (0..5).map(|_| drawn(&mut next)).collect();
            let along = |i: usize| DVector::from_fn(3, |j, _| f64::from(i == j));
            let goal = Goal {
                wanted: (0..3).map(|i| (along(i), 0.1)).collect(),
                within_s: 100.0,
                pair: false,
            };
            let Some(least_s) = least_s(&choices, &goal) else { continue };
            let chosen = choose(&choices, &goal);
            assert!(goal.is_reached(&information(&choices, &chosen, 3)), "{chosen:?}");
            lost.push(time_s(&choices, &chosen) / least_s);
        }
        lost.sort_by(f64::total_cmp);
        assert!(lost[0] > 1.0 - 1e-12, "the least of all is not the least: {}", lost[0]);
        assert!(lost[80] < 1.001 && lost[95] < 1.05 && lost[99] < 1.15, "{:?}", &lost[80..]);
    }

    fn drawn(next: &mut impl FnMut() -> f64) -> Choice {
        let directions = if next() < 0.5 { 1 } else { 2 };
        let mut one = DMatrix::zeros(3, 3);
        for _ in 0..directions {
            let along = DVector::from_fn(3, |_, _| next() - 0.5);
            one.ger(60.0 + 200.0 * next(), &along, &along, 1.0);
        }
        let (wait_s, stretch_s) = (0.5 * next(), 0.5 + next());
        let lengths = 1..=3_u32;
        Choice {
            information: lengths.clone().map(|k| &one * f64::from(k)).collect(),
            time_s: lengths.map(|k| wait_s + stretch_s * f64::from(k)).collect(),
            pair: false,
        }
    }

    /// The least time of all combinations that reach the goal.
    fn least_s(choices: &[Choice], goal: &Goal) -> Option<f64> {
        let lengths = 4_usize;
        let all = (0..lengths.pow(choices.len() as u32)).map(|code| {
            (0..choices.len() as u32).map(|i| code / lengths.pow(i) % lengths).collect::<Chosen>()
        });
        let reaching = all.filter(|chosen| goal.is_reached(&information(choices, chosen, 3)));
        reaching.map(|chosen| time_s(choices, &chosen)).min_by(f64::total_cmp)
    }

    /// Numbers between 0 and 1.
    fn uniform() -> impl FnMut() -> f64 {
        let mut source = Xoshiro256PlusPlus::seed_from_u64(7);
        move || StandardUniform.sample(&mut source)
    }

    #[test]
    fn time_bounds_the_choice() {
        let choices = [choice(10.0, 0.0, 1.0), choice(0.0, 100.0, 1.0)];
        let chosen = choose(&choices, &goal(2.5));
        assert!(time_s(&choices, &chosen) <= 2.5 && chosen[0] > 0);
    }

    #[test]
    fn a_pair_is_kept_where_one_is_asked_for() {
        let mut pair = choice(1.0, 1.0, 5.0);
        pair.pair = true;
        let choices = [choice(101.0, 101.0, 1.0), pair];
        let goal = Goal { pair: true, ..goal(100.0) };
        assert_eq!(choose(&choices, &goal), [1, 1]);
    }
}

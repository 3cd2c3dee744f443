//! Solutions of the motor's equation in windows of many lengths.

use std::cell::RefCell;
use std::rc::Rc;

use crate::identify::methods::regression::left_torque::LeftTorque;
use crate::identify::methods::regression::mode_window::ModeShape;
use crate::identify::methods::regression::motor_columns::{DRY, PLACE_OFFSET};
use crate::identify::methods::regression::motor_rows::MotorRows;
use crate::identify::methods::regression::normal::{Cluster, Solution, Term, solve, values};
use crate::identify::methods::regression::scan::{Candidate, Scan, scan};
use crate::record::Hold;

/// Two lengths of windows are one if they differ by less than this share.
const SAME_LENGTH: f64 = 1e-9;
/// With fewer rows for each term the residual may be small by chance.
const ROWS_PER_TERM: usize = 20;

/// Sums of the equation's rows in windows of the lengths asked for, each found once.
pub(super) struct SumsByLength<'a> {
    pub(super) equation: &'a MotorRows<'a>,
    /// The same equation with modes a standard error from the one that it counts, in independent directions.
    beside: Vec<MotorRows<'a>>,
    found: RefCell<Vec<(f64, Rc<Vec<Cluster>>)>>,
}

impl<'a> SumsByLength<'a> {
    pub(super) fn of(equation: &'a MotorRows<'a>) -> Self {
        Self { equation, beside: Vec::new(), found: RefCell::default() }
    }

    /// Adds the uncertainty of the mode to the covariance of each solution: `shapes` are modes one standard error away, along
    /// independent directions.
    pub(super) fn of_mode(equation: &'a MotorRows<'a>, shapes: Vec<ModeShape>) -> Self {
        let beside = shapes.into_iter().map(|shape| equation.with_mode(shape));
        Self { beside: beside.collect(), ..Self::of(equation) }
    }

    /// Returns by which factor the noise that the command's samples show must be reduced, so that it explains no more than the
    /// residual at each scanned window length.
    pub(super) fn command_noise_factor(&self, scanned: &Scan) -> f64 {
        if self.equation.campaign.channels.command.hold == Hold::Sampled {
            return 1.0;
        }
        let terms = self.equation.columns.terms(Term::Signed(DRY));
        let by_command = |candidate: &Candidate| {
            let length = candidate.window_s;
            let solution = self.solved(length, &terms)?;
            let many = solution.rows > ROWS_PER_TERM * terms.len();
            many.then(|| LeftTorque::of(&self.clusters(length), &terms, &solution).by_command)
        };
        let most = scanned.candidates.iter().filter_map(by_command).fold(1.0, f64::max);
        most.sqrt().recip()
    }

    /// These sums with the command noise of `equation`, smaller by `factor`.
    pub(super) fn with_command_noise(&self, equation: &'a MotorRows<'a>, factor: f64) -> Self {
        let found = self.found.borrow();
        let less = found.iter().map(|(length, clusters)| {
            if factor >= 1.0 {
                return (*length, Rc::clone(clusters));
            }
            let mut clusters = Vec::clone(clusters);
            for cluster in &mut clusters {
                let right = cluster.noise.ncols() - 1;
                cluster.noise[(right, right)] *= factor * factor;
            }
            (*length, Rc::new(clusters))
        });
        Self { equation, beside: Vec::new(), found: RefCell::new(less.collect()) }
    }

    pub(super) fn clusters(&self, length_s: f64) -> Rc<Vec<Cluster>> {
        let same = |(length, _): &&(f64, _)| (length / length_s - 1.0).abs() < SAME_LENGTH;
        let known = self.found.borrow().iter().find(same).map(|(_, sums)| Rc::clone(sums));
        known.unwrap_or_else(|| {
            let sums = Rc::new(self.equation.clusters(length_s));
            self.found.borrow_mut().push((length_s, Rc::clone(&sums)));
            sums
        })
    }

    pub(super) fn solved(&self, length_s: f64, terms: &[Term]) -> Option<Solution> {
        let mut solution = solve(&self.clusters(length_s), terms)?;
        for other in &self.beside {
            let moved = values(&other.clusters(length_s), terms)? - &solution.value;
            solution.covariance += &moved * moved.transpose();
        }
        Some(solution)
    }

    /// Windows of the given lengths, or of the length about which the parameters are best known.
    pub(super) fn scan(&self, sample_time_s: f64, window_s: &[f64]) -> Option<Scan> {
        let columns = &self.equation.columns;
        let terms = columns.terms(Term::Signed(DRY));
        // The offset is small by nature: it does not take part in the choice of the window.
        let counts: Vec<bool> = (0..terms.len()).map(|i| i != PLACE_OFFSET).collect();
        scan(sample_time_s, window_s, &counts, |length| self.solved(length, &terms))
    }
}

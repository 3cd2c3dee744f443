//! Polynomials through four samples at any times.

/// Weights of four samples at the times `x` for the cubic polynomial's value at `at`.
pub(super) fn weights(x: [f64; 4], at: f64) -> [f64; 4] {
    let mut weights = [1.0; 4];
    for i in 0..4 {
        for j in 0..4 {
            if i != j {
                weights[i] *= (at - x[j]) / (x[i] - x[j]);
            }
        }
    }
    weights
}

/// The sum of the products of weights and values.
pub(super) fn value(weights: [f64; 4], y: [f64; 4]) -> f64 {
    weights.iter().zip(y).map(|(w, y)| w * y).sum()
}

/// The error of the sample at `k` as its neighbours at the distances `nodes` predict it, and the sum
/// of the squared weights.
pub(super) fn left_out(time: &[f64], y: &[f64], k: usize, nodes: [isize; 4]) -> Option<(f64, f64)> {
    let mut index = [0; 4];
    for (index, node) in index.iter_mut().zip(nodes) {
        *index = k.checked_add_signed(node).filter(|&i| i < y.len())?;
    }
    let weights = weights(index.map(|i| time[i]), time[k]);
    let squares = weights.iter().map(|w| w * w).sum::<f64>();
    let error = y[k] - value(weights, index.map(|i| y[i]));
    (squares.is_finite() && error.is_finite()).then_some((error, squares))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_predicted_exactly() {
        let time = [0.0, 1.3, 2.0, 3.4, 5.0];
        let cubic = time.map(|t: f64| 1.0 - t + 0.5 * t * t * t);
        let (error, _) = left_out(&time, &cubic, 2, [-2, -1, 1, 2]).unwrap();
        assert!(error.abs() < 1e-13, "{error}");
        assert!(left_out(&time, &cubic, 1, [-2, -1, 1, 2]).is_none());
        assert!(left_out(&[0.0; 5], &cubic, 2, [-2, -1, 1, 2]).is_none());
    }
}

//! Polynomials in s, with coefficients in descending powers.

/// Product of two polynomials, coefficients in descending powers.
pub fn multiply(a: &[f64], b: &[f64]) -> Vec<f64> {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let mut out = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            out[i + j] += x * y;
        }
    }
    out
}

/// Sum of two polynomials, coefficients in descending powers; they are aligned at the constant term.
pub fn add(a: &[f64], b: &[f64]) -> Vec<f64> {
    let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
    let mut out = long.to_vec();
    let offset = long.len() - short.len();
    out[offset..].iter_mut().zip(short).for_each(|(o, s)| *o += s);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn product_and_sum() {
        assert_eq!(multiply(&[1.0, 2.0], &[1.0, -2.0]), [1.0, 0.0, -4.0]);
        assert_eq!(add(&[1.0, 0.0, 0.0], &[3.0]), [1.0, 0.0, 3.0]);
        assert!(multiply(&[], &[1.0]).is_empty());
    }
}

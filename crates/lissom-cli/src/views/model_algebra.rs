//! Matrices and transfer functions of a few masses as text.

use lissom::beam::BeamMatrices;
use lissom_io::model::{Function, Model};
use lissom_views::digits::shown;

use super::printer;

/// Significant digits.
const DIGITS: usize = 6;
/// Length of the longest line.
const WIDE: usize = 100;

pub(crate) fn print(model: &Model) {
    if let Some(matrices) = &model.matrices {
        printer::line("");
        print_matrices(matrices);
    }
    let functions: Vec<String> =
        model.functions.iter().filter(|f| !f.lowest).flat_map(lines).collect();
    if !functions.is_empty() {
        printer::line("");
        for line in &functions {
            printer::line(line);
        }
    }
}

fn print_matrices(m: &BeamMatrices) {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut add = |name: &str, values: &mut dyn Iterator<Item = f64>| {
        let cells = values.map(|v| shown(v, DIGITS));
        rows.push(std::iter::once(name.to_owned()).chain(cells).collect());
    };
    for (i, row) in m.ei_a.row_iter().enumerate() {
        add(if i == 0 { "EI·A [N/m]" } else { "" }, &mut row.iter().copied());
    }
    add("EI·B [N/m]", &mut m.ei_b.iter().copied());
    add("P [1/m²]", &mut m.p.iter().copied());
    add("Q [1/m]", &mut m.q.iter().copied());
    add("H [N·m/rad]", &mut m.h.iter().copied());
    add("h_motor [N·m/rad]", &mut std::iter::once(m.h_motor));
    add("h_torque [1]", &mut std::iter::once(m.h_torque));
    printer::table(&rows);
}

/// `θ_1/θ_m = (…) / (…)`, on two lines if it is long.
fn lines(f: &Function) -> Vec<String> {
    let name = |end: &str| match end.strip_prefix("theta_") {
        Some(mass) => format!("θ_{mass}"),
        None => match end {
            "motor" => "θ_m".to_owned(),
            "current" => "i".to_owned(),
            _ => "C_t".to_owned(),
        },
    };
    let left = format!("{}/{}", name(&f.to), name(f.from));
    let Some(g) = f.roots.transfer_function() else {
        return vec![format!("{left}: no polynomials, see the warnings")];
    };
    let (num, den) = (polynomial(&g.num), polynomial(&g.den));
    let whole = format!("{left} = ({num}) / ({den})");
    if whole.chars().count() <= WIDE {
        return vec![whole];
    }
    vec![format!("{left} = ({num})"), format!("{} / ({den})", " ".repeat(left.chars().count()))]
}

/// Coefficients in descending powers as `2.5 s⁴ + 3 s² + 1`.
fn polynomial(coefficients: &[f64]) -> String {
    let degree = coefficients.len().saturating_sub(1);
    let mut text = String::new();
    for (k, c) in coefficients.iter().enumerate().filter(|(_, c)| **c != 0.0) {
        let size = c.abs();
        text.push_str(match (text.is_empty(), *c < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        let power = power(degree - k);
        #[expect(clippy::float_cmp, reason = "a monic polynomial's one is exact")]
        if size == 1.0 && !power.is_empty() {
            text.push_str(&power);
        } else {
            text.push_str(&shown(size, DIGITS));
            text.push_str(if power.is_empty() { "" } else { " " });
            text.push_str(&power);
        }
    }
    if text.is_empty() { "0".to_owned() } else { text }
}

fn power(exponent: usize) -> String {
    match exponent {
        0 => String::new(),
        1 => "s".to_owned(),
        _ => {
            let digits = exponent.to_string();
            let raised = digits.chars().filter_map(|c| c.to_digit(10));
            let raised = raised.filter_map(|d| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(d as usize));
            format!("s{}", raised.collect::<String>())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::polynomial;

    #[test]
    fn polynomials_read_as_they_are_written() {
        assert_eq!(polynomial(&[1.0, 0.0, -2.5]), "s² - 2.50000");
        assert_eq!(polynomial(&[-1.0, 3.0, 0.0]), "-s² + 3.00000 s");
        let mut long = vec![0.0; 13];
        long[0] = 1.0;
        long[12] = 1.0;
        assert_eq!(polynomial(&long), "s¹² + 1.00000");
        assert_eq!(polynomial(&[0.0]), "0");
    }
}

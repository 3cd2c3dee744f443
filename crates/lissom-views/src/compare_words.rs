//! Results side by side: rows of a table, and the differences in words.

use std::f64::consts::PI;

use lissom::identify::Method;
use lissom_io::ComparedFile;
use lissom_io::result::{
    ComparedParameterEntry, ComparedResultEntry, EstimateEntry, LawTermName, PHASE_KEY,
    ParameterDifferenceEntry,
};
use lissom_report::{significant, with_uncertainty};

use crate::digits::{counted, signed_percent};

/// Indent of a name that belongs to the row above.
const INDENT: &str = "  ";
/// Relative difference up to which torque constants count as equal.
const SAME_CONSTANT: f64 = 1e-5;
/// Cell of a missing value.
const DASH: &str = "—";

/// The results, each with its letter, its file and its method.
pub fn results(found: &ComparedFile) -> Vec<String> {
    let words = |(k, result): (usize, &ComparedResultEntry)| {
        format!("{}  {}: {}", letter(k), result.file, method(result))
    };
    found.results.iter().enumerate().map(words).collect()
}

/// The differences in words: which parameters differ clearly, then what makes the comparison doubtful.
pub fn sentences(found: &ComparedFile) -> Vec<String> {
    let clear = (1..found.results.len()).map(|k| differing(found, k));
    let doubts = [
        warnings(found),
        methods(found),
        friction_laws(found),
        torque_constants(found),
        modes(found),
    ];
    clear.chain(doubts.into_iter().flatten()).collect()
}

/// Name of a result in the table: A to Z, then numbers.
pub(crate) fn letter(k: usize) -> String {
    let letter = u8::try_from(k).ok().filter(|k| *k < 26).map(|k| char::from(b'A' + k));
    letter.map_or_else(|| format!("#{}", k + 1), String::from)
}

/// The table of the parameters: a heading, then a row for each parameter.
pub fn rows(found: &ComparedFile) -> Vec<Vec<String>> {
    let count = found.results.len();
    let marked = found.parameters.iter().any(is_marked);
    let mut heading = vec!["parameter".to_owned(), "unit".to_owned(), letter(0)];
    for k in 1..count {
        heading.extend([letter(k), format!("{} − A", letter(k)), "[s.e.]".to_owned()]);
    }
    heading.extend(marked.then(|| "warning".to_owned()));
    let mut rows = vec![heading];
    let mut base = "";
    for p in &found.parameters {
        let (name, indented) = match p.name.strip_prefix(base).and_then(|n| n.strip_prefix(' ')) {
            Some(rest) if !base.is_empty() => (rest, INDENT),
            _ => {
                base = &p.name;
                (p.name.as_str(), "")
            }
        };
        let (unit, factor) = shown_unit(p);
        let value = |value: &Option<EstimateEntry>| {
            let shown = value.as_ref().map(|e| with_uncertainty(e.value * factor, e.std * factor));
            shown.unwrap_or_else(|| DASH.to_owned())
        };
        let mut row = vec![format!("{indented}{name}"), unit.to_owned()];
        row.extend(p.values.first().map(value));
        for (estimate, difference) in p.values.iter().skip(1).zip(&p.differences) {
            let [change, errors] = changes(p, difference.as_ref());
            row.extend([value(estimate), change, errors]);
        }
        row.extend(marked.then(|| marks(p)));
        rows.push(row);
    }
    rows
}

/// The unit in the table and the factor to it: phases are in degrees.
pub(crate) fn shown_unit(p: &ComparedParameterEntry) -> (&str, f64) {
    if p.key == PHASE_KEY { ("deg", 180.0 / PI) } else { (&p.unit, 1.0) }
}

/// A difference in percent (for a phase in degrees), and in standard errors.
fn changes(
    p: &ComparedParameterEntry,
    difference: Option<&ParameterDifferenceEntry>,
) -> [String; 2] {
    let Some(d) = difference else { return [DASH, DASH].map(str::to_owned) };
    let dash = || DASH.to_owned();
    [change(p, d).unwrap_or_else(dash), d.standard_errors.map_or_else(dash, errors)]
}

fn change(p: &ComparedParameterEntry, d: &ParameterDifferenceEntry) -> Option<String> {
    if p.key == PHASE_KEY {
        let degrees = d.value.to_degrees();
        return Some(if degrees.abs() < 0.005 {
            "0 deg".to_owned()
        } else {
            format!("{degrees:+.2} deg")
        });
    }
    d.relative.map(signed_percent)
}

/// A number of standard errors, with a decimal if there are less than a hundred.
fn errors(number: f64) -> String {
    match number.abs() {
        ..0.05 => "0.0".to_owned(),
        ..99.95 => format!("{number:+.1}"),
        _ => format!("{number:+.0}"),
    }
}

/// Whether a warning affects one of the values.
fn is_marked(p: &ComparedParameterEntry) -> bool {
    p.values.iter().zip(&p.warnings).any(|(value, codes)| value.is_some() && !codes.is_empty())
}

/// Letters of the results in which a warning affects the value.
fn marks(p: &ComparedParameterEntry) -> String {
    let marked = p.values.iter().zip(&p.warnings).enumerate();
    let marked = marked.filter(|(_, (value, codes))| value.is_some() && !codes.is_empty());
    marked.map(|(k, _)| letter(k)).collect::<Vec<_>>().join(", ")
}

/// Whether a warning affects the difference between result `k` and the first one.
fn is_doubtful(p: &ComparedParameterEntry, k: usize) -> bool {
    [0, k].iter().any(|k| p.warnings.get(*k).is_some_and(|codes| !codes.is_empty()))
}

/// Which parameters of result `k` differ clearly from the first result.
fn differing(found: &ComparedFile, k: usize) -> String {
    let by = format!(
        "by more than {} standard errors of the difference (s.e.)",
        significant(found.clear_standard_errors, 1)
    );
    let mut told: Vec<String> = Vec::new();
    let mut compared = 0;
    for p in &found.parameters {
        let Some(Some(d)) = p.differences.get(k - 1) else { continue };
        compared += 1;
        let shown = change(p, d);
        // Coulomb friction in A and in N·m changes by the same percentage unless the torque constants differ.
        let twin = found.parameters.iter().find(|other| other.name == p.name && other.key != p.key);
        let other = twin.and_then(|twin| change(twin, twin.differences.get(k - 1)?.as_ref()?));
        let unit = if other.is_some() && other != shown {
            format!(" [{}]", p.unit)
        } else {
            String::new()
        };
        let change = shown.map_or_else(String::new, |change| format!(" {change}"));
        let doubtful = if is_doubtful(p, k) { " (doubtful)" } else { "" };
        let words = format!("{}{unit}{change}{doubtful}", p.name);
        if d.clear && !told.contains(&words) {
            told.push(words);
        }
    }
    let (first, other) = (letter(0), letter(k));
    if compared == 0 {
        format!("{first} and {other} have no parameter in common.")
    } else if told.is_empty() {
        format!("No parameter of {other} differs clearly from {first}, {by}.")
    } else {
        format!("{other} differs clearly from {first}, {by}, in {}.", told.join(", "))
    }
}

/// The warnings that make parameters doubtful.
fn warnings(found: &ComparedFile) -> Option<String> {
    let mut told: Vec<(&str, Vec<usize>)> = Vec::new();
    for p in &found.parameters {
        for (k, (value, codes)) in p.values.iter().zip(&p.warnings).enumerate() {
            for code in codes.iter().filter(|_| value.is_some()) {
                match told.iter_mut().find(|(known, _)| known == code) {
                    Some((_, of)) if of.contains(&k) => {}
                    Some((_, of)) => of.push(k),
                    None => told.push((code, vec![k])),
                }
            }
        }
    }
    if told.is_empty() {
        return None;
    }
    let told = told.iter().map(|(code, of)| {
        let letters: Vec<String> = of.iter().map(|k| letter(*k)).collect();
        format!("{code} ({})", letters.join(", "))
    });
    Some(format!(
        "Parameters marked in the last column are doubtful: a warning affects them, and their standard errors \
         may be too small. The warnings are {}. Read them under `findings` in the files.",
        told.collect::<Vec<_>>().join(", ")
    ))
}

/// Whether a property of a result is not the same in all of them.
fn differs<T: PartialEq>(found: &ComparedFile, of: impl Fn(&ComparedResultEntry) -> T) -> bool {
    found.results.windows(2).any(|pair| of(&pair[0]) != of(&pair[1]))
}

/// "A ..., B ..." by a property of each result.
fn each(found: &ComparedFile, words: impl Fn(&ComparedResultEntry) -> String) -> String {
    let parts = found.results.iter().enumerate();
    parts.map(|(k, r)| format!("{} {}", letter(k), words(r))).collect::<Vec<_>>().join(", ")
}

fn methods(found: &ComparedFile) -> Option<String> {
    differs(found, |r| r.from).then(|| {
        "The methods differ (see above), which may cause a part of the differences. Compare results of the same method if \
         you can."
            .to_owned()
    })
}

fn friction_laws(found: &ComparedFile) -> Option<String> {
    if !differs(found, |r| r.friction_terms.clone()) {
        return None;
    }
    // Viscous friction by direction hardly changes the meaning of Coulomb friction.
    let beyond_viscous = |r: &ComparedResultEntry| {
        let terms = r.friction_terms.iter().filter(|t| **t != LawTermName::ViscousByDirection);
        terms.copied().collect::<Vec<_>>()
    };
    let meaning = if differs(found, beyond_viscous) {
        "Coulomb friction then has different meanings. Compare `friction.curve` of the files at the speed of \
         interest."
    } else {
        "The offset of Coulomb friction then has different meanings, and one viscous coefficient is compared with \
         the mean of two. Compare `friction.curve` of the files at the speed of interest."
    };
    let laws = each(found, |r| format!("has {}", law(&r.friction_terms)));
    Some(format!("The friction laws differ: {laws}. {meaning}"))
}

fn torque_constants(found: &ComparedFile) -> Option<String> {
    let constants: Vec<f64> = found.results.iter().filter_map(|r| r.torque_per_command).collect();
    let first = constants.first()?;
    if constants.iter().all(|k| (k - first).abs() <= SAME_CONSTANT * first.abs()) {
        return None;
    }
    let told = each(found, |r| {
        r.torque_per_command.map_or(DASH.to_owned(), |constant| significant(constant, 4))
    });
    Some(format!(
        "The torque constants differ (in SI units {told}). Inertia, friction and coupling differ by the same factor. \
         If the drive is the same, give the same constant in both campaigns and identify again."
    ))
}

fn modes(found: &ComparedFile) -> Option<String> {
    differs(found, |r| r.modes).then(|| {
        format!(
            "The numbers of modes differ: {}. Modes are compared in ascending order of frequency: check that they \
             are the same modes.",
            each(found, |r| format!("has {}", counted(r.modes, "mode")))
        )
    })
}

pub(crate) fn method(result: &ComparedResultEntry) -> &'static str {
    match result.from {
        Some(Method::OutputError) => "output-error method",
        Some(Method::FrictionLaw) => "regression with further terms",
        Some(Method::Regression) => "regression",
        Some(Method::LeastSquares) => "least squares",
        Some(Method::FrequencyResponse) => "frequency response",
        Some(Method::ThirdHarmonic) => "third harmonic",
        Some(Method::ConstantVelocity) => "constant velocities",
        // The comparison names every method that the library has.
        Some(_) | None => "no method gives friction and inertia",
    }
}

/// A friction law in words.
fn law(terms: &[LawTermName]) -> String {
    if terms.is_empty() {
        return "Coulomb and viscous friction only".to_owned();
    }
    let words = |term: &LawTermName| match term {
        LawTermName::ViscousByDirection => "viscous friction by direction",
        LawTermName::NearRest => "a change near standstill",
        LawTermName::TorqueRipple => "torque ripple",
        LawTermName::Root => "a term with the square root of speed",
        LawTermName::WithLoad => "growth with the load",
        LawTermName::Ripple => "a ripple over the travel",
        LawTermName::CommandLag => "a lag of the command",
        other => other.name(),
    };
    terms.iter().map(words).collect::<Vec<_>>().join(" and ")
}

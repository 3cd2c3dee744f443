//! The valid name that is most similar to a wrong one.

/// Largest number of characters that are compared, because the time grows with the length.
const LONGEST: usize = 64;

/// The candidate most similar to `wanted`, if it is similar enough for a hint.
pub fn nearest<'a>(wanted: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let length = wanted.chars().count();
    if length > LONGEST {
        return None;
    }
    let lower = wanted.to_lowercase();
    candidates
        .into_iter()
        .filter(|name| name.len() <= 4 * LONGEST)
        .map(|name| (strsim::osa_distance(&lower, &name.to_lowercase()), name))
        .filter(|&(distance, name)| distance <= (length.max(name.chars().count()) / 3).max(1))
        .filter(|&(distance, name)| distance < name.chars().count())
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, name)| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_slips_of_the_pen_and_no_more() {
        let names = ["theta_m", "theta_t", "current"];
        assert_eq!(nearest("thetam", names).as_deref(), Some("theta_m"));
        assert_eq!(nearest("Current", names).as_deref(), Some("current"));
        assert_eq!(nearest("voltage", names), None);
        assert_eq!(nearest("", ["s"]), None);
        assert_eq!(nearest(&"a".repeat(65), [&*"a".repeat(64)]), None);
    }
}

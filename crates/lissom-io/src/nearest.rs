//! The valid name that a wrong one probably meant.

/// Characters of the longest text that is looked at: the time goes with its length.
const LONGEST: usize = 64;

/// The candidate nearest to `wanted`, if one is near enough to be worth naming.
pub(crate) fn nearest<'a>(
    wanted: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<String> {
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

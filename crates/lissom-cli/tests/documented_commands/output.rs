//! What a command prints compared with what a page shows of it.

/// Stands for any number of lines.
const ANY: &str = "...";

/// Whether `printed` is what a page shows.
pub(crate) fn matches(shown: &[&str], printed: &str) -> bool {
    let printed: Vec<&str> = printed.lines().map(str::trim_end).collect();
    let shown: Vec<&str> = shown.iter().map(|l| l.trim_end()).collect();
    fits(&shown, &printed)
}

fn fits(shown: &[&str], printed: &[&str]) -> bool {
    match shown.split_first() {
        None => printed.iter().all(|line| line.is_empty()),
        Some((&ANY, rest)) => (0..=printed.len()).any(|skipped| fits(rest, &printed[skipped..])),
        Some((line, rest)) => {
            printed.split_first().is_some_and(|(p, left)| p == line && fits(rest, left))
        }
    }
}

/// What the page should show: the printed lines that are most like those that it shows, in parts between `...`.
pub(crate) fn refreshed(shown: &[&str], printed: &str) -> Vec<String> {
    let printed: Vec<&str> = printed.lines().map(str::trim_end).collect();
    if !shown.iter().any(|l| l.trim() == ANY) {
        return printed.iter().map(|&l| l.to_owned()).collect();
    }
    let mut text: Vec<String> = Vec::new();
    let mut from = 0;
    for (k, part) in shown.split(|l| l.trim() == ANY).enumerate() {
        if k > 0 {
            text.push(ANY.to_owned());
        }
        let most = printed.len().saturating_sub(part.len());
        let like = |at: usize| -> f64 {
            let lines = part.iter().zip(&printed[at..]);
            lines.map(|(shown, printed)| strsim::normalized_levenshtein(shown, printed)).sum()
        };
        let best = if k == 0 {
            0
        } else {
            (from..=most.max(from)).max_by(|a, b| like(*a).total_cmp(&like(*b))).unwrap_or(from)
        };
        let end = (best + part.len()).min(printed.len());
        text.extend(printed[best.min(end)..end].iter().map(|&l| l.to_owned()));
        from = end;
    }
    text
}

//! Contribution of sensor noise to the products of a row's columns.

use nalgebra::DMatrix;

use crate::identify::prepare::window::dot;

/// A column's weights on the samples of a channel, and their sign.
pub(super) type ChannelPart<'a> = (usize, &'a [f64], f64);

/// Expected products of `columns` columns, each channel given by its noise's deviation and its parts.
pub(super) fn products<'a>(
    columns: usize,
    channels: impl IntoIterator<Item = (f64, Vec<ChannelPart<'a>>)>,
) -> DMatrix<f64> {
    let mut sum = DMatrix::zeros(columns, columns);
    for (std, parts) in channels {
        for (place, (i, a, left)) in parts.iter().enumerate() {
            sum[(*i, *i)] += std * std * left * left * dot(a, a);
            for (j, b, right) in &parts[..place] {
                let product = std * std * left * right * dot(a, b);
                sum[(*i, *j)] += product;
                sum[(*j, *i)] += product;
            }
        }
    }
    sum
}

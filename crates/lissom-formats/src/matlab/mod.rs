//! MATLAB files (`.mat`) of versions 4, 5, 6, 7 and, with the feature `hdf5`, 7.3.
//!
//! A variable is a channel, a matrix several: its longer side counts the samples. Fields of structs are `log/theta`, of
//! struct arrays `run[3]/theta`, cells are `c[2]`.

#[cfg(feature = "hdf5")]
mod attributes;
mod elements;
mod left_out;
mod matrix;
mod v4;
mod v5;
#[cfg(feature = "hdf5")]
mod v73;
mod value;

pub(crate) use v4::{begins as begins_v4, read as read_v4};
pub(crate) use v5::{begins as begins_v5, read as read_v5};
#[cfg(feature = "hdf5")]
pub(crate) use v73::{MATLAB_73, read as read_v73};

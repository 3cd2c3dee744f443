//! Who may ask: whoever was given the one-time token.
//!
//! Any program of the machine and any page in the browser can reach the port. A page that is opened with the token in the
//! fragment of its address, which no server and no log sees, exchanges it for a key, and sends the key as a header: unlike a
//! cookie it does not go to other ports.

use std::sync::{Mutex, PoisonError};

use subtle::ConstantTimeEq as _;

use crate::problem::Problem;
use crate::studio_error::StudioError;

const RANDOM_BYTES: usize = 32;
/// Most pages that may be open: the oldest key then ends.
const KEYS_MOST: usize = 32;
/// What to do without a key.
pub(crate) const NEW_ADDRESS: &str =
    "open the address that the command prints, or its file `open.html`";

/// Token and keys.
#[derive(Debug, Default)]
pub(crate) struct Access {
    /// The token that is not used yet.
    token: Mutex<String>,
    keys: Mutex<Vec<String>>,
}

impl Access {
    /// Makes a new token, and returns it; the one before ends.
    pub(crate) fn new_token(&self) -> Result<String, StudioError> {
        let token = random()?;
        self.token.lock().unwrap_or_else(PoisonError::into_inner).clone_from(&token);
        Ok(token)
    }

    /// Exchanges the token for a key. The token is then used up.
    pub(crate) fn exchange(&self, token: &str) -> Result<String, Problem> {
        let mut known = self.token.lock().unwrap_or_else(PoisonError::into_inner);
        if known.is_empty() || !same(&known, token) {
            return Err(Problem::forbidden("this address has been used", Some(NEW_ADDRESS)));
        }
        known.clear();
        let key = random().map_err(Problem::internal)?;
        let mut keys = self.keys.lock().unwrap_or_else(PoisonError::into_inner);
        if keys.len() == KEYS_MOST {
            keys.remove(0);
        }
        keys.push(key.clone());
        Ok(key)
    }

    /// Whether a page has this key.
    pub(crate) fn knows(&self, key: &str) -> bool {
        let keys = self.keys.lock().unwrap_or_else(PoisonError::into_inner);
        keys.iter().fold(false, |found, known| found | same(known, key))
    }
}

fn same(a: &str, b: &str) -> bool {
    a.as_bytes().ct_eq(b.as_bytes()).into()
}

fn random() -> Result<String, StudioError> {
    let mut bytes = [0; RANDOM_BYTES];
    getrandom::fill(&mut bytes).map_err(|_| StudioError::NoRandom)?;
    Ok(hex(&bytes))
}

/// Bytes as hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    let digit = |half: u8| char::from_digit(u32::from(half), 16).unwrap_or('0');
    bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
}

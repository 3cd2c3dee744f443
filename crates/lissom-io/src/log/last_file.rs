//! The file that was read last.

use std::path::PathBuf;
use std::sync::Arc;

use lissom_formats::{LogData, ReadOptions};

use super::{LogError, LogPath};

/// Reads files, and keeps the last one: of a file with several runs each run is a log, and the file is read once.
#[derive(Debug, Default)]
pub struct LastFile {
    known: Option<(PathBuf, ReadOptions, Arc<LogData>)>,
}

impl LastFile {
    /// The content of the file of a log.
    ///
    /// # Errors
    /// As [`LogPath::read`].
    pub fn content(
        &mut self,
        log: &LogPath,
        options: &ReadOptions,
    ) -> Result<Arc<LogData>, LogError> {
        if let Some((file, known, content)) = &self.known
            && *file == log.file
            && known == options
        {
            return Ok(Arc::clone(content));
        }
        // Two files are not kept while the second one is read.
        self.known = None;
        let content = log.read(options)?;
        self.known = Some((log.file.clone(), *options, Arc::clone(&content)));
        Ok(content)
    }
}

//! Watch on a run: what passes its rows on to the files and to the progress shown.

use super::Options;
use crate::Result;
use crate::bed::measures::series::Row;
use crate::bed::record::Record;
use crate::bed::scene::{Scene, Stage};
use crate::bed::stages::Observer;
use crate::dem::dynamics::any::AnyBed;
use crate::tape::keep_fields;
use crate::view::film::Frame;
use std::path::Path;

/// Passes rows on to the files and to the progress shown, and keeps what the picture shows.
pub struct Watch<'a> {
    name: String,
    /// Files.
    pub record: Record,
    /// The bed at the end of the last compression.
    pub deepest: Option<Frame>,
    progress: &'a (dyn Fn(&str, &Row) + Sync),
}
keep_fields!(impl [] Watch<'_>: record, deepest; rebuilt name, progress);

impl<'a> Watch<'a> {
    /// Watch on the run called `name`, whose files go into `folder`.
    #[must_use]
    pub fn new(name: &str, folder: &Path, scene: &Scene, options: &Options<'a>) -> Self {
        Self {
            name: name.to_owned(),
            record: Record::new(
                folder,
                options.provenance,
                scene.output,
                super::names(scene),
            ),
            deepest: None,
            progress: options.progress,
        }
    }
}

impl Observer for Watch<'_> {
    fn row(&mut self, bed: &dyn AnyBed, row: &Row, last: bool) -> Result<()> {
        (self.progress)(&self.name, row);
        self.record.row(bed, row, last)
    }

    fn stage_ended(&mut self, bed: &dyn AnyBed, stage: &Stage) {
        if matches!(stage, Stage::Compress { .. }) {
            self.deepest = Some(Frame::of(bed, stage.name()));
        }
    }
}

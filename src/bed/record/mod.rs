//! Record: the files of one run that grow as it goes, and those made from them at its end.

pub(crate) mod bodies;
mod contacts;
pub mod dump;
pub(crate) mod oedometer;
pub(crate) mod paraview;
pub mod summary;

use self::bodies::{BodyRow, body_rows};
use self::contacts::Written;
use self::paraview::Frames;
use crate::bed::measures::fabric::{Fabric, FabricRow};
use crate::bed::measures::series::Row;
use crate::bed::scene::OutputTable;
use crate::dem::dynamics::any::AnyBed;
use crate::dem::dynamics::contact::ContactRow;
use crate::files::{write_atomic, write_rows};
use crate::tape::keep_fields;
use crate::view::film::{Film, Frame};
use crate::view::kinds::Names;
use crate::view::page::{Words, shows_most, write_page};
use crate::view::picture::write_animation;
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// Grains of a bed whose film takes every frame it is asked for; larger beds take fewer.
const FILM_GRAINS: usize = 50_000;

/// Files of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    folder: PathBuf,
    provenance: String,
    settings: OutputTable,
    names: Names,
    stage: String,
    /// Rows of the stage so far.
    rows: usize,
    frames: Frames,
    film: Film,
    stress: Vec<FabricRow>,
    bodies: Vec<BodyRow>,
    /// Frames of the dump so far.
    dumped: usize,
}
keep_fields!(Record: stage, rows, frames, film, stress, bodies, dumped;
    rebuilt folder, provenance, settings, names);

impl Record {
    /// Nothing yet; files will be in `folder` and CSV files begin with `provenance`.
    #[must_use]
    pub fn new(folder: &Path, provenance: &str, settings: OutputTable, names: Names) -> Self {
        Self {
            folder: folder.to_owned(),
            provenance: provenance.to_owned(),
            settings,
            names,
            stage: String::new(),
            rows: 0,
            frames: Frames::new(&folder.join("vtp")),
            film: Film::new(&folder.join("film")),
            stress: Vec::new(),
            bodies: Vec::new(),
            dumped: 0,
        }
    }

    /// Takes a row and writes the frames that are due with it; those of a stage hold its first row and its `last`.
    ///
    /// # Errors
    /// [`Error::File`] when a file cannot be written.
    pub fn row(&mut self, bed: &dyn AnyBed, row: &Row, last: bool) -> Result<()> {
        if self.stage != row.stage {
            (self.stage, self.rows) = (row.stage.clone(), 0);
        }
        let contacts = bed.contact_rows();
        let volume = match row.solid_fraction > 0.0 {
            true => bed.grains().volume() / row.solid_fraction,
            false => 0.0,
        };
        let fabric = Fabric::of(&contacts, bed.grains());
        self.stress
            .push(FabricRow::new(&row.stage, row.time_s, volume, &fabric));
        self.bodies.extend(body_rows(bed, &row.stage));
        if self.is_due(self.settings.frames, last) {
            self.frame(bed, &contacts)?;
        }
        let sparser = 1 + bed.grains().len() / FILM_GRAINS;
        if self.is_due(self.settings.film / sparser, last) {
            self.film.keep(&Frame::of(bed, &row.stage))?;
        }
        self.rows += 1;
        Ok(())
    }

    /// Whether this row is one of `frames` in a stage, or the `last`.
    fn is_due(&self, frames: usize, last: bool) -> bool {
        match self.settings.rows.checked_div(frames) {
            Some(every) => last || self.rows.is_multiple_of(every.max(1)),
            None => false,
        }
    }

    fn frame(&mut self, bed: &dyn AnyBed, contacts: &[ContactRow]) -> Result<()> {
        if self.settings.contacts {
            let file = format!("contacts/contacts_{:04}.csv", self.frames.len());
            let rows: Vec<Written> = contacts
                .iter()
                .map(|row| Written::of(row, bed.machine()))
                .collect();
            write_rows(&self.folder.join(file), &self.provenance, &rows)?;
        }
        if self.settings.dump {
            let text = dump::frame(bed.grains(), bed.machine(), bed.clock().2);
            write_atomic(&self.piece(self.dumped), text.as_bytes())?;
            self.dumped += 1;
        }
        self.frames.write(bed, contacts)
    }

    /// A frame of the dump on its own, until the run has ended.
    fn piece(&self, number: usize) -> PathBuf {
        self.folder.join(format!("film/{number:05}.lammpstrj"))
    }

    /// Writes what is made at the end: `stress.csv`, `bodies.csv`, the dump, the page and the animation.
    ///
    /// # Errors
    /// [`Error::File`] when a file cannot be read or written.
    pub fn finish(
        &self,
        bed: &dyn AnyBed,
        title: &str,
        summary: &str,
        warnings: &[String],
    ) -> Result<()> {
        let path = |name: &str| self.folder.join(name);
        write_rows(&path("stress.csv"), &self.provenance, &self.stress)?;
        write_rows(&path("bodies.csv"), &self.provenance, &self.bodies)?;
        if self.dumped > 0 {
            let mut whole = Vec::new();
            for number in 0..self.dumped {
                let piece = self.piece(number);
                whole.extend(std::fs::read(&piece).map_err(Error::file("read", &piece))?);
            }
            write_atomic(&path("dump.lammpstrj"), &whole)?;
        }
        if !self.film.is_empty() {
            let film = (&self.film, &self.names);
            let words = Words {
                title,
                summary,
                warnings,
            };
            write_page(&path("bed.html"), words, film, bed)?;
            if self.settings.animation > 0 {
                let most = self.settings.animation;
                write_animation(&path("animation.png"), title, film, bed, most)?;
            }
        }
        Ok(())
    }

    /// The frame of the film that shows most; none without a film.
    ///
    /// # Errors
    /// [`Error::File`] when a frame cannot be read.
    pub fn best_frame(&self) -> Result<Option<Frame>> {
        let mut frames = self.film.spread(usize::MAX)?;
        let best = shows_most(&frames);
        Ok((best < frames.len()).then(|| frames.swap_remove(best)))
    }

    /// Removes the frames that the page, the animation and the dump were made from.
    pub fn discard(&self) {
        for number in 0..self.dumped {
            // a piece that stays does no harm: a new run writes over it
            let _ = std::fs::remove_file(self.piece(number));
        }
        self.film.discard();
    }
}

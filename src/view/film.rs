//! Film: frames of a run kept on disk as it goes, for the animation and the page made at its end.

use crate::dem::dynamics::any::AnyBed;
use crate::files::write_atomic;
use crate::tape::{Keep, VERSION, keep_fields, sealed, unsealed};
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// One frame, single precision: for looking at. Grains stand in the order of their names.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frame {
    /// Time, s.
    pub time: f64,
    /// Stage.
    pub stage: String,
    /// Names of the grains.
    pub ids: Vec<u32>,
    /// Centres, m.
    pub centres: Vec<[f32; 3]>,
    /// Radii, m.
    pub radii: Vec<f32>,
    /// Materials, as indices.
    pub materials: Vec<u8>,
    /// Groups, as indices.
    pub groups: Vec<u32>,
    /// Speeds, m/s.
    pub speed: Vec<f32>,
    /// Energy dissipated by plastic flow in the contacts of each grain, J.
    pub plastic: Vec<f32>,
    /// Sum of the contact forces on each grain, as magnitudes, N.
    pub squeeze: Vec<f32>,
    /// Place (m) and orientation (x, y, z, w) of each body.
    pub poses: Vec<[f32; 7]>,
    /// Bodies that have been taken out.
    pub gone: Vec<usize>,
}
keep_fields!(Frame: time, stage, ids, centres, radii, materials, groups, speed, plastic, squeeze, poses, gone);

impl Frame {
    /// The bed as it is.
    #[must_use]
    pub fn of(bed: &dyn AnyBed, stage: &str) -> Self {
        let (grains, machine) = (bed.grains(), bed.machine());
        let mut order: Vec<usize> = (0..grains.len()).collect();
        order.sort_unstable_by_key(|&grain| grains.ids[grain]);
        let (plastic, squeeze) = (bed.plastic_by_grain(), bed.squeeze());
        let pick = |value: &dyn Fn(usize) -> f64| order.iter().map(|&i| value(i) as f32).collect();
        let single = |v: parry3d::math::Vector| v.to_array().map(|x| x as f32);
        Self {
            time: bed.clock().1,
            stage: stage.to_owned(),
            ids: order.iter().map(|&i| grains.ids[i]).collect(),
            materials: order.iter().map(|&i| grains.material(i)).collect(),
            groups: order.iter().map(|&i| grains.groups[i]).collect(),
            radii: pick(&|i| grains.spheres[i].radius),
            centres: order
                .iter()
                .map(|&i| single(grains.spheres[i].centre))
                .collect(),
            speed: pick(&|i| grains.motions[i].velocity.length()),
            plastic: pick(&|i| plastic[i]),
            squeeze: pick(&|i| squeeze[i]),
            poses: machine
                .surfaces
                .iter()
                .map(|surface| {
                    let [x, y, z] = single(surface.pose.translation * machine.unit);
                    let turn = surface.pose.rotation.to_array().map(|q| q as f32);
                    [x, y, z, turn[0], turn[1], turn[2], turn[3]]
                })
                .collect(),
            gone: (0..machine.surfaces.len())
                .filter(|&body| machine.surfaces[body].removed)
                .collect(),
        }
    }
}

/// Frames kept so far.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Film {
    folder: PathBuf,
    count: usize,
    /// Most grains in a frame.
    most: usize,
}
keep_fields!(Film: count, most; rebuilt folder);

impl Film {
    /// No frames yet; they will be files in `folder`.
    #[must_use]
    pub fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            count: 0,
            most: 0,
        }
    }

    fn file(&self, number: usize) -> PathBuf {
        self.folder.join(format!("{number:05}.bin"))
    }

    /// Keeps one frame more.
    ///
    /// # Errors
    /// [`Error::File`] when it cannot be written.
    pub fn keep(&mut self, frame: &Frame) -> Result<()> {
        let tape = sealed(VERSION, |tape| frame.save(tape));
        write_atomic(&self.file(self.count), tape.as_bytes())?;
        self.count += 1;
        self.most = self.most.max(frame.centres.len());
        Ok(())
    }

    /// Number of frames.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Most grains in a frame.
    #[must_use]
    pub fn most_grains(&self) -> usize {
        self.most
    }

    /// Whether there is no frame.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// A frame by its number.
    ///
    /// # Errors
    /// [`Error::File`] when its file cannot be read or is damaged.
    pub fn frame(&self, number: usize) -> Result<Frame> {
        let path = self.file(number);
        let bytes = std::fs::read(&path).map_err(Error::file("read", &path))?;
        let load = || {
            let mut tape = unsealed(bytes)?;
            let (mut version, mut frame) = (0, Frame::default());
            version.load(&mut tape)?;
            (version == VERSION).then_some(())?;
            frame.load(&mut tape)?;
            tape.is_at_end().then_some(frame)
        };
        load().ok_or_else(|| {
            let damaged = "it is damaged; remove the folder of the run to start anew";
            let damaged = std::io::Error::new(std::io::ErrorKind::InvalidData, damaged);
            Error::file("read", &path)(damaged)
        })
    }

    /// At most `most` frames, evenly spread, the first and the last among them.
    ///
    /// # Errors
    /// As [`Film::frame`].
    pub fn spread(&self, most: usize) -> Result<Vec<Frame>> {
        chosen(self.count, most)
            .into_iter()
            .map(|number| self.frame(number))
            .collect()
    }

    /// Removes the files: what was made from them stands.
    pub fn discard(&self) {
        // files that stay do no harm: a new run writes over them
        for number in 0..self.count {
            let _ = std::fs::remove_file(self.file(number));
        }
        let _ = std::fs::remove_dir(&self.folder);
    }
}

/// At most `most` numbers below `count`, evenly spread, first and last among them.
fn chosen(count: usize, most: usize) -> Vec<usize> {
    let take = count.min(most.max(2));
    if take < 2 {
        return (0..take).collect();
    }
    (0..take)
        .map(|k| (k * (count - 1) + (take - 1) / 2) / (take - 1))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_film_is_thinned_evenly_from_its_first_to_its_last_frame() {
        assert!(chosen(0, 9).is_empty());
        assert_eq!(chosen(1, 9), [0]);
        assert_eq!(chosen(5, 9), [0, 1, 2, 3, 4]);
        assert_eq!(chosen(101, 5), [0, 25, 50, 75, 100]);
        assert_eq!(chosen(100, 1), [0, 99]);
    }

    #[test]
    fn frames_come_back_as_they_were_kept() {
        let folder = tempfile::tempdir().unwrap();
        let mut film = Film::new(&folder.path().join("film"));
        for time in [0.5, 1.5] {
            let frame = Frame {
                time,
                stage: "settle".to_owned(),
                centres: vec![[1.0, -2.0, 3.5]],
                poses: vec![[0.0; 7]],
                ..Frame::default()
            };
            film.keep(&frame).unwrap();
        }
        let frames = film.spread(9).unwrap();
        assert_eq!(frames.len(), 2);
        assert_eq!((frames[1].time, frames[1].centres[0][2]), (1.5, 3.5));
        film.discard();
        assert!(!folder.path().join("film").exists());
        assert!(film.frame(0).is_err());
    }
}

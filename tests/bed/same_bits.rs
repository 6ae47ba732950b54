//! The same bytes in every file: for 1, 2 and 3 threads, and for a run that was stopped and resumed.

use crate::resume::{WHOLE, files, run};

/// Runs a scene whole on 1 and 3 threads, and on 2 stopped before the row number `stop` of the run named and resumed.
pub fn assert_same_bits(text: &str, stop: (&str, usize)) {
    let on = |threads: usize, stops: &[(&str, usize)]| {
        let folder = tempfile::tempdir().unwrap();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().unwrap().install(|| {
            for &at in stops {
                assert!(!run(text, folder.path(), at), "not stopped at {at:?}");
            }
            assert!(run(text, folder.path(), WHOLE));
        });
        files(folder.path())
    };
    let one = on(1, &[]);
    for (what, other) in [
        ("3 threads", on(3, &[])),
        ("2 threads, resumed", on(2, &[stop])),
    ] {
        assert!(one.keys().eq(other.keys()), "{what}");
        for (name, bytes) in &one {
            assert!(other[name] == *bytes, "{what}: {name} differs");
        }
    }
}

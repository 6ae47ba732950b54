//! Guide: how to use the program, what it solves and what was measured, one module a chapter.
//!
//! The chapters are Markdown files beside this one. `mdbook build src/guide` makes a book of the same files
//! (`SUMMARY.md` is its table of contents). Shell blocks and results are held to the program by `tests/cli/guide.rs`, the
//! two references to what the readers accept and the writers write by `tests/cli/reference.rs`.

/// Makes a module of each chapter; its text is read for the documentation alone, so that no build waits for prose.
macro_rules! chapters {
    ($($name:ident, $file:literal;)+) => {$(
        #[cfg_attr(doc, doc = include_str!($file))]
        #[cfg_attr(not(doc), doc = $file)]
        pub mod $name {}
    )+};
}

chapters! {
    first_case, "first-case.md";
    theories, "theories.md";
    bed, "bed.md";
    study, "study.md";
    discover, "discover.md";
    atlas, "atlas.md";
    explorer, "explorer.md";
    inverse, "inverse.md";
    python, "python.md";
    accuracy, "accuracy.md";
    solver, "solver.md";
    measured, "measured.md";
    gallery, "gallery.md";
    keys, "keys.md";
    columns, "columns.md";
}

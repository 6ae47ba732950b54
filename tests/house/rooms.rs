//! Rooms: data go one way. Each module of `src` may use those before it in the order below, never one after it; the wings
//! of a room are held to an order of their own, and no file is in a circle of imports.

use crate::sources::sources;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::LazyLock;
use syn::visit::{self, Visit};

/// Rooms that may use those of earlier lines only.
type Order = &'static [&'static [&'static str]];

/// The order of the rooms.
const ROOMS: Order = &[
    &["error"],
    &["files", "unit", "lanes"],
    &["tape"],
    &["document", "scheme", "space", "table"],
    &["material", "shape"],
    &["case", "contact", "curve"],
    &["plan", "study"],
    &["impact"],
    &["theory"],
    &["fit"],
    &["atlas"],
    &["law"],
    &["compare", "cost", "discover"],
    &["inverse", "tester", "thesis"],
    &["validate"],
    &["dem"],
    &["listing", "view"],
    &["bed"],
    &["export"],
    &["report", "prelude"],
    &["explore"],
    &["command"],
    &["cli"],
    &["guide"],
];

/// The order of the wings of each room that has some. The room's own file, which shows them, comes after all.
const WINGS: &[(&str, Order)] = &[
    (
        "impact",
        &[
            &["points", "kernel"],
            &["grid", "wall"],
            &["stepping", "model"],
            &["run"],
            &["updated", "pair"],
            &["choice"],
        ],
    ),
    (
        "dem",
        &[
            &["grains", "bodies", "force"],
            &["contacts", "adapter"],
            &["dynamics"],
        ],
    ),
    (
        "bed",
        &[
            &["scene"],
            &["filling", "measures"],
            &["record", "stages"],
            &["run"],
        ],
    ),
    (
        "export",
        &[
            &["source"],
            &["c"],
            &[
                "deck",
                "deme",
                "lammps",
                "liggghts",
                "mercurydpm",
                "native",
                "table",
            ],
            &["scene", "check"],
        ],
    ),
];

/// Most lines of a file: past this it wants to be two.
const LONGEST_FILE: usize = 500;
/// Largest share of the lines of `src` that one room may have, in per cent.
const LARGEST_ROOM: usize = 20;

/// Path of a module below the crate's root: `["dem", "force", "friction"]`.
type ModulePath = Vec<String>;

/// A file of `src` and what it imports.
struct Module {
    file: PathBuf,
    text: String,
    uses: BTreeSet<ModulePath>,
}

/// Paths a file names outside its tests.
#[derive(Default)]
struct Paths(Vec<ModulePath>);

impl Paths {
    fn tree(&mut self, before: &[String], tree: &syn::UseTree) {
        let with = |ident: &syn::Ident| [before, &[ident.to_string()]].concat();
        match tree {
            syn::UseTree::Path(path) => self.tree(&with(&path.ident), &path.tree),
            syn::UseTree::Group(group) => group.items.iter().for_each(|t| self.tree(before, t)),
            syn::UseTree::Name(name) => self.0.push(with(&name.ident)),
            syn::UseTree::Rename(rename) => self.0.push(with(&rename.ident)),
            _ => self.0.push(before.to_vec()),
        }
    }
}

impl<'ast> Visit<'ast> for Paths {
    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        self.tree(&[], &item.tree);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let segments = path.segments.iter().map(|s| s.ident.to_string());
        self.0.push(segments.collect());
        visit::visit_path(self, path);
    }

    /// `pub(in crate::dem)` imports nothing.
    fn visit_vis_restricted(&mut self, _: &'ast syn::VisRestricted) {}

    fn visit_item(&mut self, item: &'ast syn::Item) {
        if !attributes(item).iter().any(is_for_tests) {
            visit::visit_item(self, item);
        }
    }
}

fn attributes(item: &syn::Item) -> &[syn::Attribute] {
    match item {
        syn::Item::Mod(item) => &item.attrs,
        syn::Item::Fn(item) => &item.attrs,
        syn::Item::Use(item) => &item.attrs,
        syn::Item::Impl(item) => &item.attrs,
        _ => &[],
    }
}

fn is_for_tests(attribute: &syn::Attribute) -> bool {
    attribute.path().is_ident("cfg")
        && attribute
            .parse_args::<syn::Path>()
            .is_ok_and(|condition| condition.is_ident("test"))
}

/// `path` as named in the module `here`, from the crate's root; as it is where it starts with a name of its own.
fn from_root(path: &[String], here: &[String]) -> ModulePath {
    match path.first().map(String::as_str) {
        Some("crate") => path[1..].to_vec(),
        Some("self") => [here, &path[1..]].concat(),
        Some("super") => {
            let up = path.iter().take_while(|name| *name == "super").count();
            [&here[..here.len().saturating_sub(up)], &path[up..]].concat()
        }
        _ => [here, path].concat(),
    }
}

/// Every module of the library, by its path, with the modules it uses; all files are parsed once.
fn modules() -> &'static BTreeMap<ModulePath, Module> {
    static MODULES: LazyLock<BTreeMap<ModulePath, Module>> = LazyLock::new(read_modules);
    &MODULES
}

fn read_modules() -> BTreeMap<ModulePath, Module> {
    let mut modules = BTreeMap::new();
    for (file, text) in sources() {
        let mut path: ModulePath = file
            .with_extension("")
            .iter()
            .map(|part| part.to_string_lossy().into_owned())
            .collect();
        path.pop_if(|last| last == "mod");
        let module = Module {
            file,
            text,
            uses: BTreeSet::new(),
        };
        modules.insert(path, module);
    }
    let known: BTreeSet<ModulePath> = modules.keys().cloned().collect();
    for (path, module) in &mut modules {
        module.uses = uses(&module.text, path, &known);
    }
    modules
}

/// Modules among those `known` that the text of the module `here` names.
fn uses(text: &str, here: &[String], known: &BTreeSet<ModulePath>) -> BTreeSet<ModulePath> {
    let mut paths = Paths::default();
    paths.visit_file(&syn::parse_file(text).unwrap());
    let named = paths.0.iter().filter_map(|path| {
        let path = from_root(path, here);
        let longest = (1..=path.len()).rev().map(|length| path[..length].to_vec());
        longest.into_iter().find(|module| known.contains(module))
    });
    named.filter(|module| *module != here).collect()
}

fn rank(order: Order, name: &str) -> usize {
    order
        .iter()
        .position(|names| names.contains(&name))
        .unwrap_or_else(|| panic!("{name} has no place in the order"))
}

#[test]
fn no_room_uses_one_to_its_right() {
    let mut wrong = Vec::new();
    for (path, module) in modules() {
        for used in &module.uses {
            if used[0] != path[0] && rank(ROOMS, &used[0]) >= rank(ROOMS, &path[0]) {
                wrong.push(format!(
                    "{} uses {}",
                    module.file.display(),
                    used.join("::")
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn no_wing_uses_one_to_its_right() {
    let modules = modules();
    let mut wrong = Vec::new();
    for (room, order) in WINGS {
        let place = |path: &ModulePath| path.get(1).map_or(order.len(), |wing| rank(order, wing));
        for (path, module) in modules.iter().filter(|(path, _)| path[0] == *room) {
            for used in module.uses.iter().filter(|used| used[0] == *room) {
                if used.get(1) != path.get(1) && place(used) >= place(path) {
                    wrong.push(format!(
                        "{} uses {}",
                        module.file.display(),
                        used.join("::")
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A module may use the one it is declared in, which shows it; every other way back is a circle.
#[test]
fn no_file_is_in_a_circle_of_imports() {
    let modules = modules();
    let arrows: BTreeMap<&ModulePath, Vec<&ModulePath>> = modules
        .iter()
        .map(|(path, module)| {
            let below = module.uses.iter().filter(|used| !path.starts_with(used));
            (path, below.collect())
        })
        .collect();
    assert_eq!(circle(&arrows), None);
}

/// Modules that lead back to themselves, if there are any: what is left when those that use nothing left are taken away.
fn circle(arrows: &BTreeMap<&ModulePath, Vec<&ModulePath>>) -> Option<Vec<String>> {
    let mut left: BTreeSet<&ModulePath> = arrows.keys().copied().collect();
    loop {
        let ends: Vec<&ModulePath> = left
            .iter()
            .copied()
            .filter(|path| arrows[path].iter().all(|used| !left.contains(used)))
            .collect();
        if ends.is_empty() {
            let names = left.iter().map(|path| path.join("::"));
            return (!left.is_empty()).then(|| names.collect());
        }
        ends.iter().for_each(|path| {
            left.remove(path);
        });
    }
}

#[test]
fn circles_are_found() {
    let name = |text: &str| vec![text.to_owned()];
    let [a, b, c] = ["a", "b", "c"].map(name);
    let mut arrows = BTreeMap::from([(&a, vec![&b]), (&b, vec![&c]), (&c, vec![])]);
    assert_eq!(circle(&arrows), None);
    arrows.insert(&c, vec![&b]);
    let found = circle(&arrows).unwrap();
    assert!(found.contains(&"b".to_owned()) && found.contains(&"c".to_owned()));
}

#[test]
fn imports_are_seen_wherever_they_are_named() {
    let text = "use crate::{bed::{run, view as v}, Error};\nuse super::force;\n// crate::fit\n\
        pub(in crate::law) fn f() -> crate::report::X { self::inner::g::<crate::plan::P>() }\n\
        #[cfg(test)]\nmod tests { use crate::cli::Cli; }\n";
    let module = |path: &str| path.split("::").map(str::to_owned).collect::<ModulePath>();
    let all = "bed::run bed::view dem::force dem::near::inner report plan cli law fit error";
    let known = all.split(' ').map(module).collect();
    let found = uses(text, &module("dem::near"), &known);
    let expected = "bed::run bed::view dem::force dem::near::inner report plan";
    assert_eq!(found, expected.split(' ').map(module).collect());
}

#[test]
fn no_room_is_larger_than_a_fifth_of_the_house() {
    let mut lines: BTreeMap<String, usize> = BTreeMap::new();
    for (path, module) in modules() {
        *lines.entry(path[0].clone()).or_default() += module.text.lines().count();
    }
    let all: usize = lines.values().sum();
    for (room, lines) in lines {
        assert!(
            lines * 100 <= all * LARGEST_ROOM,
            "{room}: {lines} of {all} lines"
        );
    }
}

#[test]
fn every_file_says_what_it_is_for_and_stays_readable() {
    for module in modules().values() {
        let file = module.file.display();
        assert!(module.text.starts_with("//! "), "{file} has no module doc");
        let lines = module.text.lines().count();
        assert!(lines <= LONGEST_FILE, "{file} has {lines} lines");
    }
}

#[test]
fn arguments_are_refused_by_the_program_and_not_by_the_library() {
    for module in modules().values() {
        let allowed = ["error.rs", "command", "cli.rs"];
        assert!(
            allowed.iter().any(|place| module.file.starts_with(place))
                || !module.text.contains("Error::Argument"),
            "{} speaks of arguments: Error::Refused",
            module.file.display()
        );
    }
}

#[test]
fn rapier_is_named_in_the_machine_and_the_adapter_only() {
    for module in modules().values() {
        let code = module.text.lines().map(str::trim_start);
        let mut code = code.filter(|line| !line.starts_with("//"));
        let allowed = ["dem/bodies/machine", "dem/adapter"];
        assert!(
            allowed.iter().any(|place| module.file.starts_with(place))
                || !code.any(|line| line.contains("rapier3d")),
            "{} names rapier",
            module.file.display()
        );
    }
}

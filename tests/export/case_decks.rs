//! Cases as input decks of a finite-element code: what stands in them, what is refused, and that the code agrees with Hertz.

use crate::program::{impactlaw, message};
use std::collections::HashMap;
use std::fs::read_to_string;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

const CASE: &str = r#"[particle]
radius = "250 um"
[material]
density = "8000 kg/m3"
young_modulus = "100 GPa"
poisson_ratio = 0.35
yield_strength = "1.25 GPa"
[impact]
velocities = ["10 m/s", "50 m/s"]
[accuracy]
tolerance = 0.02
"#;

/// A half-space of another metal below it.
const WALL: &str =
    "[wall.material]\ndensity = \"2700 kg/m3\"\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.3\n";

/// `export --to calculix` of a case, with more arguments.
fn exported(case: &str, more: &[&str]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let arguments = ["export", "case.toml", "--to", "calculix", "--out", "out"];
    let output = impactlaw(folder.path(), &[&arguments, more].concat());
    assert!(output.status.success(), "{}", message(&output));
    folder
}

/// Lines below each keyword line, in the order of the deck, without comments.
fn cards(text: &str) -> Vec<(String, Vec<String>)> {
    let mut cards: Vec<(String, Vec<String>)> = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with("**")) {
        match line.starts_with('*') {
            true => cards.push((line.to_owned(), Vec::new())),
            false => cards.last_mut().unwrap().1.push(line.to_owned()),
        }
    }
    cards
}

fn card<'a>(cards: &'a [(String, Vec<String>)], start: &str) -> &'a [String] {
    let found = cards.iter().find(|(name, _)| name.starts_with(start));
    &found.unwrap_or_else(|| panic!("no {start}")).1
}

fn numbers(line: &str) -> Vec<f64> {
    let fields = line
        .split(',')
        .map(str::trim)
        .filter(|field| !field.is_empty());
    fields.map(|field| field.parse().unwrap()).collect()
}

#[test]
fn no_line_of_a_deck_is_longer_than_the_code_reads() {
    let folder = exported(CASE, &["--cells", "8"]);
    let text = read_to_string(folder.path().join("out/calculix/flattening.inp")).unwrap();
    for line in text.lines() {
        assert!(line.len() <= 120, "{line}");
        let mut fields = line.split(',').filter(|_| !line.starts_with('*'));
        assert!(fields.all(|field| field.trim().len() <= 20), "{line}");
    }
    // estimated for 50 m/s; 0.070 in finite elements
    assert!(text.contains("delta/R = 0.07"), "{}", &text[..400]);
}

#[test]
fn a_slow_deck_holds_the_sphere_by_its_mean_and_presses_it_to_the_flattening_and_back() {
    let folder = exported(CASE, &["--flattening", "0.1", "--cells", "8"]);
    let text = read_to_string(folder.path().join("out/calculix/flattening.inp")).unwrap();
    let cards = cards(&text);
    let nodes: HashMap<usize, [f64; 2]> = card(&cards, "*NODE, NSET=SPHERE")
        .iter()
        .map(|line| numbers(line))
        .map(|n| (n[0] as usize, [n[1], n[2]]))
        .collect();
    let elements: HashMap<usize, Vec<usize>> = card(&cards, "*ELEMENT, TYPE=CAX8R")
        .iter()
        .map(|line| {
            numbers(line)
                .iter()
                .map(|n| *n as usize)
                .collect::<Vec<_>>()
        })
        .map(|n| (n[0], n[1..].to_vec()))
        .collect();
    // millimetres: the contact surface lies on a sphere of a quarter, from the origin on
    let surface = card(&cards, "*SURFACE, NAME=CONTACT");
    assert!(surface.len() > 8);
    let mut end = [0.0, 0.0];
    for line in surface {
        let (element, side) = line.split_once(", S").unwrap();
        let side: usize = side.parse().unwrap();
        let of = &elements[&element.parse().unwrap()];
        let [a, b, middle] = [of[side - 1], of[side % 4], of[3 + side]].map(|n| nodes[&n]);
        for [r, z] in [a, b, middle] {
            assert!((r.hypot(z - 0.25) / 0.25 - 1.0).abs() < 1e-9, "{line}");
        }
        assert!(
            (a[0] - end[0]).abs() + (a[1] - end[1]).abs() < 1e-12,
            "{line}"
        );
        end = b;
    }
    let equation = card(&cards, "*EQUATION");
    let terms: Vec<Vec<f64>> = equation[1..].iter().map(|line| numbers(line)).collect();
    assert_eq!(equation[0], terms.len().to_string());
    assert!(
        (terms.iter().map(|term| term[2]).sum::<f64>()).abs() < 1e-9,
        "shares add up to 1"
    );
    let steps: Vec<f64> = cards
        .iter()
        .flat_map(|(_, lines)| lines)
        .filter(|line| line.starts_with("CENTRE, 2, 2"))
        .map(|line| line.rsplit(',').next().unwrap().trim().parse().unwrap())
        .collect();
    assert_eq!(steps.len(), 2);
    assert!((steps[0] + 0.025).abs() < 1e-12 && steps[1] > steps[0] && steps[1] < 0.0);
    assert_eq!(card(&cards, "*ELASTIC"), ["1.0000000000e5, 0.35"]);
    assert_eq!(card(&cards, "*PLASTIC"), ["1.2500000000e3, 0.000000e0"]);
    assert_eq!(numbers(&card(&cards, "*DENSITY")[0]), [8e-9]);
}

#[test]
fn hardening_stands_in_a_table_and_an_elastic_body_has_none() {
    let of = |constants: &str| {
        let case = CASE.replace("yield_strength = \"1.25 GPa\"\n", constants);
        let folder = exported(&case, &["--flattening", "0.01", "--cells", "4"]);
        let text = read_to_string(folder.path().join("out/calculix/flattening.inp")).unwrap();
        cards(&text)
    };
    assert!(of("").iter().all(|(name, _)| name != "*PLASTIC"));
    let linear = of("yield_strength = \"1 GPa\"\nhardening_modulus = \"2 GPa\"\n");
    let rows: Vec<_> = card(&linear, "*PLASTIC")
        .iter()
        .map(|line| numbers(line))
        .collect();
    assert_eq!(rows, [[1e3, 0.0], [11e3, 5.0]]);
    let power = of(
        "yield_strength = \"1 GPa\"\nhardening_coefficient = \"300 MPa\"\nhardening_exponent = 0.3\n",
    );
    for row in card(&power, "*PLASTIC").iter().map(|line| numbers(line)) {
        let expected = 1e3 + 300.0 * row[1].powf(0.3);
        assert!((row[0] / expected - 1.0).abs() < 1e-6, "{row:?}");
    }
}

#[test]
fn what_a_deck_cannot_say_is_refused_by_name_and_nothing_is_written() {
    let rate = "yield_strength = \"1.25 GPa\"\nhardening_coefficient = \"300 MPa\"\nhardening_exponent = 0.3\nrate_sensitivity = 0.02\n";
    let cases = [
        (format!("{CASE}[wall]\nfriction = 0.3\n"), "`wall.friction`"),
        (
            CASE.replace("[impact]\n", "[impact]\nangle = \"20 deg\"\n"),
            "`impact.angle`",
        ),
        (
            CASE.replace(
                "[particle]\n",
                "[particle]\nshape = \"cylinder\"\nlength = \"1 mm\"\n",
            ),
            "`particle.shape`",
        ),
        (format!("{CASE}[scheme]\npreset = \"flip\"\n"), "`scheme"),
        (
            format!("{CASE}[wall]\nradius = \"1 mm\"\n{WALL}"),
            "`wall.radius`",
        ),
        (
            format!("{CASE}{WALL}{rate}"),
            "`wall.material.rate_sensitivity`",
        ),
        (
            CASE.replace("yield_strength = \"1.25 GPa\"\n", rate),
            "`material.rate_sensitivity`",
        ),
    ];
    let refused = |case: &str, arguments: &[&str], why: &str| {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("case.toml"), case).unwrap();
        let law = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/sac305-solder.toml");
        std::fs::copy(law, folder.path().join("law.toml")).unwrap();
        let output = impactlaw(folder.path(), &[&["export"], arguments].concat());
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(why), "{why}: {said}");
        assert_eq!(
            std::fs::read_dir(folder.path()).unwrap().count(),
            2,
            "{why}"
        );
    };
    for (case, why) in &cases {
        refused(case, &["case.toml", "--to", "calculix"], why);
    }
    let arguments: [(&[&str], &str); 9] = [
        (
            &["case.toml", "--to", "calculix", "--flattening", "0.5"],
            "--flattening: found 0.5",
        ),
        (
            &["case.toml", "--to", "calculix", "--flattening", "nan"],
            "--flattening: found NaN",
        ),
        (
            &["case.toml", "--to", "calculix", "--cells", "2"],
            "--cells: found 2",
        ),
        (&["case.toml", "--to", "calculix,lammps"], "must be alone"),
        (&["case.toml", "--to", "calculix", "--check"], "--check"),
        (&["case.toml", "--to", "lammps"], "a case file"),
        (&["law.toml", "--to", "calculix"], "a law file"),
        (
            &["law.toml", "--to", "lammps", "--flattening", "0.1"],
            "--flattening",
        ),
        (&["case.toml", "--to", "abaqus"], "calculix"),
    ];
    for (arguments, why) in arguments {
        refused(CASE, arguments, why);
    }
}

/// Force of a slow deck at each displacement of the mean, both as the deck's units have them, as `ccx` finds them.
fn run(folder: &Path, name: &str) -> Option<Vec<[f64; 2]>> {
    let there = Command::new("ccx").arg("-v").output().is_ok();
    if !there {
        eprintln!("SKIPPED: CalculiX (`ccx`) is not installed; Debian has it as calculix-ccx");
        return None;
    }
    let mut command = Command::new("ccx");
    command.args(["-i", name]).current_dir(folder);
    let output = command.env("OMP_NUM_THREADS", "1").output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("Job finished"), "{said}");
    let mut rows: Vec<[f64; 2]> = Vec::new();
    let mut set = "";
    let printed = read_to_string(folder.join(format!("{name}.dat"))).unwrap();
    for line in printed.lines() {
        if let Some((_, name)) = line.split_once("set ") {
            set = if name.starts_with("PLANE") {
                "PLANE"
            } else if name.starts_with("CENTRE") {
                "CENTRE"
            } else {
                ""
            };
        } else if !line.trim().is_empty() {
            let words: Vec<f64> = line
                .split_whitespace()
                .map(|word| word.parse().unwrap())
                .collect();
            match set {
                "PLANE" => rows.push([f64::NAN, 180.0 * words[1]]),
                "CENTRE" => rows.last_mut().unwrap()[0] = -words[2],
                _ => {}
            }
        }
    }
    Some(rows)
}

/// Forces over Hertz's of an elastic deck of ten increments, without the way back.
fn beside_hertz(case: &str, name: &str, modulus: f64) -> Option<Vec<f64>> {
    let folder = exported(case, &["--flattening", "1e-4", "--cells", "8"]);
    let folder = folder.path().join("out/calculix");
    let deck = folder.join(format!("{name}.inp"));
    let text = read_to_string(&deck).unwrap();
    let (press, _) = text.split_once("** let go").unwrap();
    let short = press.replace(
        "*STATIC\n2e-2, 1., 1e-9, 2e-2",
        "*STATIC\n1e-1, 1., 1e-9, 1e-1",
    );
    assert_ne!(short, press);
    std::fs::write(&deck, short).unwrap();
    let rows = run(&folder, name)?;
    assert_eq!(rows.len(), 10);
    let stiffness = 4.0 / 3.0 * modulus * 0.25f64.sqrt();
    let off = |[d, f]: &[f64; 2]| f / (stiffness * d.powf(1.5)) - 1.0;
    let off: Vec<f64> = rows.iter().map(off).collect();
    println!("{name}: force beside Hertz's: {off:.4?}");
    Some(off)
}

#[test]
fn calculix_presses_an_elastic_sphere_as_hertz_says() {
    let elastic = CASE.replace("yield_strength = \"1.25 GPa\"\n", "");
    let modulus = 1e5 / (1.0 - 0.35 * 0.35);
    let Some(off) = beside_hertz(&elastic, "flattening", modulus) else {
        return;
    };
    // the first contacts are one or two elements wide
    assert!(off[5..].iter().all(|off| off.abs() < 0.02), "{off:.4?}");
    assert!(off[9].abs() < 0.01, "{off:.4?}");
}

#[test]
#[ignore = "a minute or two of a core, in CalculiX"]
fn calculix_presses_an_elastic_sphere_into_an_elastic_half_space_as_hertz_says() {
    let elastic = CASE.replace("yield_strength = \"1.25 GPa\"\n", "");
    let elastic = format!("{elastic}{WALL}");
    let [own, other] = [(1e5, 0.35f64), (7e4, 0.3)].map(|(e, nu)| e / (1.0 - nu * nu));
    let modulus = own * other / (own + other);
    let Some(off) = beside_hertz(&elastic, "indentation", modulus) else {
        return;
    };
    assert!(off[5..].iter().all(|off| off.abs() < 0.02), "{off:.4?}");
}

#[test]
fn a_deformable_wall_is_meshed_below_the_sphere_and_held_at_its_back() {
    let case = format!("{CASE}[wall]\nthickness = \"1 mm\"\n{WALL}yield_strength = \"300 MPa\"\n");
    let folder = exported(&case, &["--flattening", "0.02", "--cells", "6"]);
    let text = read_to_string(folder.path().join("out/calculix/indentation.inp")).unwrap();
    assert!(text.contains("into a frictionless plate") && !text.contains("RIGID"));
    let cards = cards(&text);
    let nodes: HashMap<usize, [f64; 2]> = card(&cards, "*NODE, NSET=WALL")
        .iter()
        .map(|line| numbers(line))
        .map(|n| (n[0] as usize, [n[1], n[2]]))
        .collect();
    let of = |name: &str| -> Vec<[f64; 2]> {
        let lines = card(&cards, name).iter();
        lines
            .map(|line| nodes[&(numbers(line)[0] as usize)])
            .collect()
    };
    // millimetres: the back of the plate lies 1 mm below the surface, and every node of it is held
    let back = of("*NSET, NSET=PLANE");
    assert!(back.len() > 20 && back.iter().all(|[_, z]| *z == -1.0));
    assert_eq!(
        back.len(),
        nodes.values().filter(|[_, z]| *z == -1.0).count()
    );
    let inmost = of("*NSET, NSET=INMOST");
    assert!(
        inmost
            .iter()
            .all(|[r, _]| *r == inmost[0][0] && *r > 0.0 && *r < 1e-4)
    );
    assert_eq!(inmost[0][1], 0.0);
    let held = card(&cards, "*BOUNDARY");
    assert_eq!(held, ["AXIS, 1, 1", "PLANE, 1, 2", "INMOST, 1, 1"]);
    let strengths: Vec<&str> = (cards.iter())
        .filter(|(name, _)| name == "*PLASTIC")
        .map(|(_, lines)| &lines[0][..])
        .collect();
    assert_eq!(
        strengths,
        ["1.2500000000e3, 0.000000e0", "3.0000000000e2, 0.000000e0"]
    );
    // the surface of the wall begins next to the axis and reaches beyond the contact
    assert!(card(&cards, "*SURFACE, NAME=WALL").len() > 8);
}

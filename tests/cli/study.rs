//! Studies through the real binary: the file contract, equal groups run once, finished runs kept.

use crate::four_cases::FOUR_CASES;
use crate::program::{impactlaw, message, program};
use impactlaw::curve::{Impact, Status};
use std::path::Path;
use std::process::Output;

fn study(folder: &Path) -> Output {
    impactlaw(folder, &["study", "s.toml", "--out", "results"])
}

#[test]
fn equal_groups_run_once_and_a_second_call_repeats_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), FOUR_CASES).unwrap();
    let output = study(folder.path());
    assert!(output.status.success(), "{}", message(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    // 2000 kg/m3 at 40 m/s is 8000 kg/m3 at 20 m/s
    assert!(
        text.starts_with("4 cases, 3 runs, 4 with status ok"),
        "{text}"
    );
    let results = folder.path().join("results/results.csv");
    let first = std::fs::read_to_string(&results).unwrap();
    let rows: Vec<&str> = first.lines().filter(|l| !l.starts_with('#')).collect();
    assert!(rows[0].starts_with(
        "name,density_kg_m3,young_modulus_Pa,yield_strength_Pa,hardening_modulus_Pa,\
         hardening_coefficient_Pa,hardening_exponent,saturation_stress_Pa,saturation_exponent,\
         rate_sensitivity,reference_rate_1_s,softening_exponent,melting_temperature_K,room_temperature_K,\
         specific_heat_J_kg_K,taylor_quinney_coefficient,doubling_rate_1_s,rate_exponent,\
         poisson_ratio,radius_m,angle_deg,friction,tolerance,young_over_yield,rho_V2_over_E,rho_V2_over_Y,V_over_Vy,\
         hardening_over_young,hardening_coefficient_over_young,saturation_stress_over_young,V_over_R_reference_rate,\
         heat_to_melt_over_yield,V_over_R_doubling_rate,velocity_m_s,restitution,max_force_N"
    ));
    assert!(rows[0].ends_with("predicted_s,status"));
    assert_eq!(rows.len(), 5);
    let cell = |row: usize, key: &str| -> f64 {
        let column = rows[0].split(',').position(|k| k == key).unwrap();
        rows[row].split(',').nth(column).unwrap().parse().unwrap()
    };
    assert_eq!(
        (cell(2, "velocity_m_s"), cell(3, "velocity_m_s")),
        (40.0, 20.0)
    );
    assert_eq!(cell(2, "restitution"), cell(3, "restitution"));
    assert!((cell(3, "contact_time_s") / cell(2, "contact_time_s") - 2.0).abs() < 1e-12);
    let overview = std::fs::read_to_string(folder.path().join("results/study.md")).unwrap();
    assert!(overview.contains("| all | 3 | 3 |"), "{overview}");
    // the wall times of the second call are those of the first: nothing was run again
    let times = || {
        let text = std::fs::read_to_string(folder.path().join("results/times.csv"));
        text.unwrap()
    };
    let before = times();
    assert!(study(folder.path()).status.success());
    assert_eq!(first, std::fs::read_to_string(&results).unwrap());
    assert_eq!(before, times());
}

/// One run of 8000 kg/m3 at 20 m/s in `folder`: F*, delta*, contact time, and the wall time that tells whether it was run again.
fn figures(folder: &Path, radius: &str, density: &str, modulus: &str, speed: &str) -> [f64; 4] {
    let text = FOUR_CASES
        .replace("[\"250 um\"]", &format!("[\"{radius}\"]"))
        .replace(
            "[\"2000 kg/m3\", \"8000 kg/m3\"]",
            &format!("[\"{density}\"]"),
        )
        .replace("[\"100 GPa\"]", &format!("[\"{modulus}\"]"))
        .replace("[\"20 m/s\", \"40 m/s\"]", &format!("[\"{speed}\"]"));
    std::fs::write(folder.join("s.toml"), text).unwrap();
    assert!(study(folder).status.success());
    let [f, d, t] = ["max_force_N", "max_displacement_m", "contact_time_s"]
        .map(|key| column(folder, "results/results.csv", key)[0]);
    [
        f,
        d,
        t,
        *column(folder, "results/times.csv", "wall_s")
            .last()
            .unwrap(),
    ]
}

/// Numbers of a column of a table.
fn column(folder: &Path, table: &str, key: &str) -> Vec<f64> {
    let cells = cells(folder, table, key).into_iter();
    cells.map(|cell| cell.parse().unwrap()).collect()
}

fn cells(folder: &Path, table: &str, key: &str) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join(table)).unwrap();
    let mut rows = text.lines().filter(|l| !l.starts_with('#'));
    let place = rows.next().unwrap().split(',').position(|k| k == key);
    rows.map(|row| row.split(',').nth(place.unwrap()).unwrap().to_owned())
        .collect()
}

#[test]
fn kept_runs_are_shared_through_their_groups_and_scaled_by_the_file_s_own_units() {
    let folder = tempfile::tempdir().unwrap();
    let first = figures(folder.path(), "250 um", "8000 kg/m3", "100 GPa", "20 m/s");
    // the same groups: four times the radius, a quarter of the density, twice the modulus
    let speed = format!("{} m/s", 20.0 * 8f64.sqrt());
    let scaled = figures(folder.path(), "1 mm", "2000 kg/m3", "200 GPa", &speed);
    assert_eq!(scaled[3], first[3], "the kept run is shared");
    for (k, factor) in [32.0, 4.0, 4.0 / 8f64.sqrt()].into_iter().enumerate() {
        assert!((scaled[k] / first[k] / factor - 1.0).abs() < 1e-12, "{k}");
    }
    // a run of its own, elsewhere, gives the same
    let alone = tempfile::tempdir().unwrap();
    let own = figures(alone.path(), "1 mm", "2000 kg/m3", "200 GPa", &speed);
    for k in 0..3 {
        assert!((own[k] / scaled[k] - 1.0).abs() < 1e-9, "{k}");
    }
    // back again: what was kept is as it was
    let back = figures(folder.path(), "250 um", "8000 kg/m3", "100 GPa", "20 m/s");
    assert_eq!(back, first);
}

#[test]
fn runs_of_another_version_are_not_taken_over() {
    let folder = tempfile::tempdir().unwrap();
    figures(folder.path(), "250 um", "8000 kg/m3", "100 GPa", "20 m/s");
    let runs = folder.path().join("results/runs");
    let run = std::fs::read_dir(&runs)
        .unwrap()
        .next()
        .unwrap()
        .unwrap()
        .path();
    let points = || Impact::read(&run).unwrap().summary.points;
    let made = points();
    let mut other = Impact::read(&run).unwrap();
    other.summary.points = made + 1;
    other.write(&run, "another").unwrap();
    let again = || {
        let output = study(folder.path());
        assert!(output.status.success());
        (points() == made + 1, message(&output))
    };
    assert!(again().0, "a kept run of this version is read");
    let mark = run.join("run.json");
    let text = std::fs::read_to_string(&mark).unwrap();
    std::fs::write(&mark, text.replace(impactlaw::PROGRAM, "impactlaw 0.0.1")).unwrap();
    assert!(!again().0, "one of another version is made again");
    // a figure that was changed by hand, or by a disk
    let summary = run.join("summary.json");
    let text = std::fs::read_to_string(&summary).unwrap();
    let changed = text.replace("\"points\": ", "\"points\": 9");
    std::fs::write(&summary, changed).unwrap();
    let (taken, said) = again();
    assert!(!taken && said.contains("is damaged"), "{said}");
    assert_eq!(points(), made);
}

/// Text of every file of a folder that ends in `.csv`, but the times.
fn results(folder: &Path, out: &str) -> String {
    std::fs::read_to_string(folder.join(out).join("results.csv")).unwrap()
}

#[test]
fn shards_that_are_merged_are_the_bytes_of_one_run_and_so_are_the_scripts_for_clusters() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("s.toml"), FOUR_CASES).unwrap();
    assert!(study(here).status.success());
    let whole = results(here, "results");
    // the last shard first
    for shard in ["2/2", "1/2"] {
        let merge = impactlaw(here, &["study", "merge", "s.toml", "--out", "parts"]);
        let said = message(&merge);
        assert_eq!(merge.status.code(), Some(2), "{said}");
        assert!(
            said.contains("finished runs") && said.contains("of 3"),
            "{said}"
        );
        assert!(!here.join("parts/results.csv").exists());
        let output = impactlaw(
            here,
            &["study", "s.toml", "--out", "parts", "--shard", shard],
        );
        assert!(output.status.success(), "{}", message(&output));
    }
    let merge = impactlaw(here, &["study", "merge", "s.toml", "--out", "parts"]);
    assert!(merge.status.success(), "{}", message(&merge));
    assert_eq!(results(here, "parts"), whole);
    // the merged folder is a study's folder like any other: nothing is run again
    let times = std::fs::read(here.join("parts/times.csv")).unwrap();
    let again = impactlaw(here, &["study", "s.toml", "--out", "parts"]);
    assert!(again.status.success());
    let lines = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        text.split_once('\n').unwrap().1.to_owned()
    };
    let after = std::fs::read(here.join("parts/times.csv")).unwrap();
    assert_eq!(lines(&after), lines(&times));

    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/cluster/study.sbatch");
    let own = program(here);
    let bin = Path::new(own.get_program()).parent().unwrap().to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::iter::once(bin).chain(std::env::split_paths(&path));
    let path = std::env::join_paths(path).unwrap();
    for task in ["1", "2"] {
        let output = std::process::Command::new("bash")
            .arg(&script)
            .current_dir(here)
            .env("PATH", &path)
            .env("STUDY", "s.toml")
            .env("OUT", "array")
            .env("SLURM_ARRAY_TASK_ID", task)
            .env("SLURM_ARRAY_TASK_COUNT", "2")
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", message(&output));
    }
    let merge = impactlaw(here, &["study", "merge", "s.toml", "--out", "array"]);
    assert!(merge.status.success(), "{}", message(&merge));
    assert_eq!(results(here, "array"), whole);

    let snakefile = script.with_file_name("Snakefile");
    let snakemake = std::process::Command::new("snakemake")
        .args(["--cores", "2", "-s"])
        .arg(&snakefile)
        .args(["--config", "study=s.toml", "out=snake", "shards=2"])
        .current_dir(here)
        .env("PATH", &path)
        .output();
    match snakemake {
        Ok(output) => {
            assert!(output.status.success(), "{}", message(&output));
            assert_eq!(results(here, "snake"), whole);
        }
        Err(_) => eprintln!("!! SKIPPED: no snakemake in PATH, the workflow was not run"),
    }
}

#[test]
fn a_study_grows_and_runs_only_what_is_new() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let cube = |samples: &str| {
        FOUR_CASES
            .replace("\n[particle]", &format!("samples = {samples}\n[particle]"))
            .replace("[80]", "{ from = 40, to = 80, scale = \"log\" }")
            .replace("[\"20 m/s\", \"40 m/s\"]", "\"20 m/s\"")
            .replace("[\"2000 kg/m3\", \"8000 kg/m3\"]", "\"8000 kg/m3\"")
    };
    let run = |samples: &str| {
        std::fs::write(here.join("s.toml"), cube(samples)).unwrap();
        let output = study(here);
        assert!(output.status.success(), "{}", message(&output));
        column(here, "results/results.csv", "young_over_yield")
    };
    let first = run("2");
    assert!(first.iter().all(|ratio| (40.0..=80.0).contains(ratio)));
    // one in each half of the logarithmic range
    let middle = 3200f64.sqrt();
    assert_eq!(first.iter().filter(|ratio| **ratio < middle).count(), 1);
    let walls = || column(here, "results/times.csv", "wall_s");
    let (before, grown) = (walls(), run("[2, 1]"));
    assert_eq!(grown[..2], first[..]);
    assert_eq!(grown.len(), 3);
    let after = walls();
    assert!(before.iter().all(|wall| after.contains(wall)), "made again");
}

#[test]
fn cases_one_by_one_take_what_they_lack_from_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let text = "[particle]\nradius = \"250 um\"\n[material]\ndensity = \"8000 kg/m3\"\nyoung_modulus = \"100 GPa\"\n\
        poisson_ratio = 0.35\nyoung_over_yield = 80\n[impact]\nvelocities = \"20 m/s\"\n[accuracy]\ntolerance = 0.2\n\
        [[case]]\nname = \"as above\"\n[[case]]\nname = \"hard\"\nmaterial.yield_strength = \"2 GPa\"\n\
        material.hardening_over_young = 0.01\nimpact.V_over_Vy = 20\n";
    std::fs::write(here.join("s.toml"), text).unwrap();
    let output = study(here);
    assert!(output.status.success(), "{}", message(&output));
    let cell = |key: &str| cells(here, "results/results.csv", key);
    assert_eq!(cell("name"), ["as above", "hard"]);
    let number = |key: &str| column(here, "results/results.csv", key);
    assert_eq!(number("yield_strength_Pa"), [1.25e9, 2e9]);
    assert_eq!(number("hardening_modulus_Pa"), [0.0, 1e9]);
    assert!((number("V_over_Vy")[1] / 20.0 - 1.0).abs() < 1e-7);
    assert!((number("rho_V2_over_Y")[0] / 2.56e-3 - 1.0).abs() < 1e-7);
    assert_eq!(cell("status"), ["ok", "ok"]);
}

#[test]
fn a_run_that_failed_is_a_row_with_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("s.toml"), FOUR_CASES).unwrap();
    assert!(study(here).status.success());
    let run = std::fs::read_dir(here.join("results/runs")).unwrap().next();
    let run = run.unwrap().unwrap().path();
    let mut impact = Impact::read(&run).unwrap();
    impact.summary.status = Status::Failed("a cell turned over".to_owned());
    impact.summary.restitution = f64::NAN;
    impact.write(&run, "by hand").unwrap();
    let output = study(here);
    assert_eq!(output.status.code(), Some(1), "{}", message(&output));
    let status = cells(here, "results/results.csv", "status");
    let failed = status.iter().filter(|s| *s == "failed: a cell turned over");
    assert!((1..=2).contains(&failed.count()), "{status:?}");
    assert_eq!(status.len(), 4);
    assert!(status.iter().any(|status| status == "ok"));
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_told_and_what_was_finished_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("s.toml"), FOUR_CASES).unwrap();
    let own = program(here);
    // no file may grow past one block: writes fail as on a full disk
    let output = std::process::Command::new("bash")
        .args([
            "-c",
            "trap '' XFSZ; ulimit -f 1; exec \"$0\" study s.toml --out results",
        ])
        .arg(own.get_program())
        .current_dir(here)
        .output()
        .unwrap();
    let said = message(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("cannot write") && said.contains("curve.csv"),
        "{said}"
    );
    assert!(!here.join("results/results.csv").exists());
    let output = study(here);
    assert!(output.status.success(), "{}", message(&output));
}

#[test]
fn bad_studies_are_refused_by_the_name_of_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let ranged = FOUR_CASES.replace("[80]", "{ from = 40, to = 80 }");
    let top = |line: &str| ranged.replace("\n[particle]", &format!("{line}\n[particle]"));
    let after = |lines: &str| format!("{FOUR_CASES}{lines}");
    for (text, said) in [
        (
            FOUR_CASES.replace("[80]", "[]"),
            "`material.young_over_yield`: found []; must hold at least one value",
        ),
        (
            FOUR_CASES.replace("[80]", "[80, 40, 80]"),
            "`material.young_over_yield[2]`: found 80; must be given once",
        ),
        (
            FOUR_CASES.replace("\"40 m/s\"", "\"20 m/s\""),
            "`impact.velocities[1]`: found \"20 m/s\"; must be given once",
        ),
        (ranged.clone(), "needs `samples`"),
        (top("samples = 0"), "`samples`: found 0; must be at least 1"),
        (
            top("samples = [3, 0]"),
            "`samples[1]`: found 0; must be at least 1",
        ),
        (top("samples = 1000000"), "more than 100000 cases"),
        (
            FOUR_CASES.replace("\n[particle]", "samples = 3\n[particle]"),
            "must not stand in a file without ranges",
        ),
        (
            top("samples = 3").replace("from = 40", "from = 90"),
            "must begin (`from`) below its end",
        ),
        (
            top("samples = 3").replace("to = 80", "to = 80, scale = \"cubic\""),
            "scale",
        ),
        (
            FOUR_CASES.replace("[80]", "80\nyield_strength = \"1 GPa\""),
            "must not stand beside",
        ),
        (
            FOUR_CASES.replace("[0.35]", "[0.35]\nhardening_over_young = -1"),
            "`material.hardening_over_young`: found -1; must not be negative",
        ),
        (
            FOUR_CASES.replace(
                "[\"2000 kg/m3\", \"8000 kg/m3\"]",
                "[\"2000 kg/m3\", \"8 kg/m3\"]",
            ),
            "`material.density[1]`: found \"8 kg/m3\"; check the unit",
        ),
        (
            FOUR_CASES.replace("density = [\"2000 kg/m3\", \"8000 kg/m3\"]\n", ""),
            "`material.density`: found nothing; must be given",
        ),
        (
            FOUR_CASES
                .replace("young_over_yield = [80]\n", "")
                .replace("velocities = [\"20 m/s\", \"40 m/s\"]", "rho_V2_over_Y = 1"),
            "`impact.rho_V2_over_Y`: found 1; needs a `yield_strength`",
        ),
        (
            after("[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n"),
            "`case[1]`",
        ),
        (
            after("[[case]]\nmaterial.poisson_ratio = 0.7\n"),
            "`case[0].material.poisson_ratio`: found 0.7; must lie in [0, 0.5)",
        ),
        (
            FOUR_CASES.replace("[\"250 um\"]", "3"),
            "`particle.radius`: invalid type: integer `3`, expected a length",
        ),
        (
            FOUR_CASES.replace("\n[accuracy]", "\nangel = 3\n[accuracy]"),
            "unknown field `angel`",
        ),
    ] {
        std::fs::write(here.join("s.toml"), &text).unwrap();
        let output = study(here);
        let found = message(&output);
        assert_eq!(output.status.code(), Some(2), "{text}\n{found}");
        let flat = found.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains(said), "{said}\n{text}\n{found}");
        assert!(!here.join("results").exists(), "{text}");
    }
}

#[test]
fn refinement_runs_the_drawn_cases_again_with_finer_cells() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), FOUR_CASES).unwrap();
    let arguments = ["study", "s.toml", "--out", "results", "--refine", "2"];
    let output = impactlaw(folder.path(), &arguments);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}");
    assert!(said.contains("2 of 2 runs change by less"), "{said}");
    let table = std::fs::read_to_string(folder.path().join("results/refinement.csv")).unwrap();
    let rows: Vec<&str> = table.lines().filter(|l| !l.starts_with('#')).collect();
    assert_eq!(rows.len(), 3);
    let changes: Vec<f64> = rows[1]
        .split(',')
        .skip(2)
        .take(3)
        .map(|x| x.parse().unwrap())
        .collect();
    assert!(changes.iter().any(|c| *c != 0.0) && changes.iter().all(|c| c.abs() < 0.2));
}

#[test]
fn a_bad_study_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("s.toml"),
        FOUR_CASES.replace("[80]", "[80, 0]"),
    )
    .unwrap();
    let output = study(folder.path());
    assert_eq!(output.status.code(), Some(2));
    let text = message(&output);
    assert!(text.contains("material.young_over_yield[1]"), "{text}");
    assert!(!folder.path().join("results").exists());
}

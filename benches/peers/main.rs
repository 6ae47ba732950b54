//! A run that other codes can repeat: the shared packing is shaken and comes to rest, walls being of the grains' material.
//!
//! `cargo run --release --example peers -- --help` lists the options; `benches/peers.sh` runs all codes and compares them.

#[path = "../packing/mod.rs"]
mod packing;

use clap::Parser;
use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::dem::dynamics::{Bed, Normals, Parts};
use impactlaw::dem::force::damping::Viscous;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::dem::force::normal::Model;
use impactlaw::dem::grains::Grains;
use impactlaw::theory::hertz::Hertz;
use packing::{GRAVITY, MATERIAL, RADIUS};
use parry3d::math::Vector;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Steps between rows.
const ROW: usize = 250;
/// Largest component of the velocities a grain is shaken with, m/s.
const SHAKE: f64 = 0.1;

/// The shared packing, shaken: prints rows of step, kinetic energy (J), contacts per grain, mean and largest height (m), then
/// the particle-steps a second, and peak memory where the system tells.
#[derive(Parser)]
struct Options {
    /// Write the packing for LAMMPS and LIGGGHTS (packing.data) into this folder instead, its velocities being those of the
    /// same friction, restitution and step
    #[arg(long, value_name = "DIR")]
    write: Option<PathBuf>,
    /// Steps to run
    #[arg(long, default_value_t = 4000)]
    steps: usize,
    /// Copies of the packing side by side, along x and along y
    #[arg(long, default_value_t = 1, conflicts_with = "write")]
    across: usize,
    /// Threads to run on
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Moves every grain by up to 1e-9 of its radius first, to see how far two runs of one scene drift apart (0: not at all)
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    nudge: usize,
    /// Coefficient of friction, of grains and walls
    #[arg(long, value_name = "MU", default_value_t = 0.5)]
    friction: f64,
    /// Coefficient of restitution of the viscous damping
    #[arg(long, value_name = "E", default_value_t = 0.8)]
    restitution: f64,
    /// Time step, s
    #[arg(long, value_name = "SECONDS", default_value_t = 1e-5)]
    dt: f64,
}

/// The packing with every grain moving, none faster than the shake.
fn shaken(across: usize) -> Grains {
    let mut grains = packing::packing(across);
    for (index, motion) in grains.motions.iter_mut().enumerate() {
        let part = |salt: usize| ((index * 7919 + salt * 104_729) % 1000) as f64 / 500.0 - 1.0;
        motion.velocity = Vector::new(part(1), part(2), part(3)) * SHAKE;
    }
    grains
}

/// Moves every grain by up to 1e-9 of a radius along each axis; not at all for seed 0.
fn nudge(grains: &mut Grains, seed: usize) {
    for (index, sphere) in grains.spheres.iter_mut().enumerate() {
        let part =
            |salt: usize| ((index * 6151 + seed * (salt + 31_337)) % 1009) as f64 / 504.0 - 1.0;
        if seed > 0 {
            sphere.centre += Vector::new(part(1), part(2), part(3)) * (1e-9 * RADIUS);
        }
    }
}

/// Velocities and angular velocities at the time of the positions: the other codes start from these, a bed from those
/// half a step before.
fn present(before: &Grains, options: &Options) -> Vec<[Vector; 2]> {
    let mut bed = bed(options);
    bed.step().expect("it stays in its box");
    let mut places = vec![0; before.len()];
    for (at, id) in before.ids.iter().enumerate() {
        places[*id as usize] = at;
    }
    let mut all = vec![[Vector::ZERO; 2]; before.len()];
    for grains in [before, &bed.grains] {
        for (at, id) in grains.ids.iter().enumerate() {
            let [v, w] = &mut all[places[*id as usize]];
            *v += 0.5 * grains.motions[at].velocity;
            *w += 0.5 * grains.spins[at].rate;
        }
    }
    all
}

/// `packing.data`, which LAMMPS (`atom_style sphere`) and LIGGGHTS (`granular`) read.
fn write(folder: &Path, options: &Options) -> std::io::Result<()> {
    let grains = shaken(options.across);
    let mut text = format!(
        "shaken packing\n\n{} atoms\n2 atom types\n\n0 0.046 xlo xhi\n0 0.046 ylo yhi\n0 0.12 zlo zhi\n\nAtoms\n\n",
        grains.len()
    );
    for (at, sphere) in grains.spheres.iter().enumerate() {
        let (c, diameter) = (sphere.centre, 2.0 * sphere.radius);
        let row = format!("{} 1 {diameter} {} ", at + 1, MATERIAL.density);
        writeln!(text, "{row}{:.13} {:.13} {:.13}", c.x, c.y, c.z).expect("a string takes it");
    }
    text.push_str("\nVelocities\n\n");
    for (at, [v, w]) in present(&grains, options).iter().enumerate() {
        let row = format!("{} {} {} {}", at + 1, v.x, v.y, v.z);
        writeln!(text, "{row} {} {} {}", w.x, w.y, w.z).expect("a string takes it");
    }
    std::fs::write(folder.join("packing.data"), text)
}

fn bed(options: &Options) -> Bed<Law<(((), Viscous), Mindlin)>> {
    let parts = Parts {
        grains: shaken(options.across),
        machine: packing::walls(options.across),
        gravity: GRAVITY,
        dt: options.dt,
        skin: 0.2 * RADIUS,
    };
    // a wall of the grains' material: 1/E* = 2 (1 - nu^2)/E
    let wall = Hertz::new(0.5 * MATERIAL.contact_modulus());
    let normals = Normals {
        pair: Box::new(Model(Twins(Hertz::of(&MATERIAL)))),
        wall: Box::new(Model(Flat(wall))),
    };
    let friction = Mindlin::between([Some(&MATERIAL); 2], options.friction);
    let damping = Viscous::new(options.restitution);
    Bed::new(Law::smooth().with(damping).with(friction), normals, parts)
}

/// Peak memory of this process in bytes, where /proc tells.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

fn run(options: &Options) {
    let mut bed = bed(options);
    nudge(&mut bed.grains, options.nudge);
    let grains = bed.grains.len() as f64;
    let mut spent = 0.0;
    println!("step,kinetic_J,contacts_per_grain,mean_height_m,top_m");
    for step in 0..=options.steps {
        if step % ROW == 0 || step == options.steps {
            bed.evaluate().expect("it stays in its box");
            let heights = bed.grains.spheres.iter().map(|sphere| sphere.centre.z);
            let mean = heights.clone().sum::<f64>() / grains;
            let top = heights.fold(0.0, f64::max);
            println!(
                "{step},{:.6e},{:.5},{mean:.9},{top:.9}",
                bed.energies().kinetic,
                bed.packing().coordination
            );
        }
        let began = Instant::now();
        bed.step().expect("it stays in its box");
        spent += began.elapsed().as_secs_f64();
    }
    let rate = grains * (options.steps + 1) as f64 / spent;
    println!("# {grains} grains: {rate:.3e} particle-steps/s of wall time");
    if let Some(bytes) = peak_memory() {
        println!(
            "# {:.0} MB at most, {:.0} bytes a grain",
            bytes / 1e6,
            bytes / grains
        );
    }
}

fn main() {
    let options = Options::parse();
    if let Some(folder) = &options.write {
        write(folder, &options).expect("the folder can be written to");
        return;
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build()
        .expect("threads start");
    pool.install(|| run(&options));
}

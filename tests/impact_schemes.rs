//! Relatives of the solver: transfers lose what theory says they must, and the two references agree where strains are small.

use impactlaw::case::Case;
use impactlaw::curve::Status;
use impactlaw::impact::{Simulated, simulate};
use impactlaw::plan::{Plan, plan};
use impactlaw::scheme::{Layout, Reference, TimeStep, Transfer};
use std::path::Path;

/// An elastic impact at 0.003 of the wave speed.
fn case() -> Case {
    let text = "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\n\
        poisson_ratio = 0.35\n[impact]\nvelocities = [\"3 m/s\"]\n[accuracy]\ntolerance = 0.02\n";
    Case::parse(text, Path::new("elastic.toml")).unwrap()
}

fn run(change: impl Fn(&mut Plan)) -> Simulated {
    let case = case();
    let mut plan = plan(&case, 3.0);
    change(&mut plan);
    let done = simulate(&case.material, case.radius, &plan);
    assert_eq!(done.impact.summary.status, Status::Ok);
    done
}

fn lattice(plan: &mut Plan) {
    plan.grid.degree = 3;
    plan.grid.fine = 1.05 * 2.0 / 26.0;
    plan.grid.fine_width = 1.0;
    plan.grid.fine_depth = 2.0;
    plan.scheme.layout = Layout::Lattice(26.0);
    plan.scheme.transfer = Transfer::Blend(1.0);
    plan.scheme.time_step = TimeStep::Fixed(0.1 * plan.grid.fine / 1.27);
}

#[test]
fn velocity_on_the_nodes_loses_nothing_and_transfers_do() {
    let with = |transfer| {
        run(|p| {
            p.grid.fine *= 2.0;
            p.scheme.transfer = transfer;
        })
    };
    let (ours, apic, pic) = (
        with(Transfer::Persistent),
        with(Transfer::Apic),
        with(Transfer::Blend(0.0)),
    );
    assert_eq!(ours.transfer_loss.abs(), 0.0);
    let e = |s: &Simulated| s.impact.summary.restitution;
    assert!(e(&ours) > 0.9995, "{}", e(&ours));
    assert!(e(&apic) < e(&ours) && e(&pic) < e(&apic));
    assert!(apic.transfer_loss > 1e-4 && pic.transfer_loss > 5.0 * apic.transfer_loss);
    // what is lost is accounted for: the balance closes with it
    for done in [&ours, &apic, &pic] {
        assert!(done.impact.summary.energy_closure < 1e-3);
    }
}

#[test]
fn updated_and_total_lagrangian_agree_at_small_strain() {
    let total = run(lattice).impact.summary;
    let updated = run(|p| {
        lattice(p);
        p.scheme.reference = Reference::Present;
    })
    .impact
    .summary;
    for (name, a, b) in [
        ("F*", total.max_force_n, updated.max_force_n),
        (
            "delta*",
            total.max_displacement_m,
            updated.max_displacement_m,
        ),
        ("e", total.restitution, updated.restitution),
    ] {
        assert!((a / b - 1.0).abs() < 0.02, "{name}: {a} and {b}");
    }
    // the staircase stiffens the contact: the exact surface gives another force
    let exact = run(|_| ()).impact.summary;
    assert!(total.max_force_n > 1.1 * exact.max_force_n);
    assert!(total.restitution < exact.restitution);
}

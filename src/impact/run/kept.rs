//! Runs with levels of steps resume bit for bit.

use crate::impact::kernel::made_of;
use crate::impact::model;
use crate::impact::run::Run;
use crate::impact::wall::meridian::Contact;
use crate::material::flow::PerfectlyPlastic;
use crate::material::stress::{J2, Moduli};
use crate::plan::Plan;
use crate::scheme::Layout;
use crate::space::Axisymmetric;
use crate::tape::{Keep, Tape};
use std::path::Path;

type Crushed<'a> = Run<'a, Axisymmetric, Contact<Axisymmetric, 9>, (), 9>;

/// E/Y = 320 and rho V^2/Y = 1 on a coarse grid.
fn planned() -> Plan {
    let text = "[particle]\nradius = \"1 mm\"\n[material]\ndensity = \"1000 kg/m3\"\nyoung_modulus = \"1 GPa\"\n\
                poisson_ratio = 0.35\nyield_strength = \"3.125 MPa\"\n[impact]\nvelocities = [\"55.9 m/s\"]\n[accuracy]\ntolerance = 0.02\n";
    let case = crate::case::Case::parse(text, Path::new("kept.toml")).unwrap();
    let plan = crate::plan::plan(&case, 55.9);
    crate::plan::with_cells(plan, 2.0, &case.material)
}

fn run(plan: &Plan) -> Crushed<'_> {
    let moduli = Moduli::new(1.0, 0.35);
    let flow = PerfectlyPlastic {
        strength: 1.0 / 320.0,
    };
    let model = model::build::<2, 9>(
        &plan.grid,
        Layout::Fitted,
        made_of(J2 { moduli, flow }),
        1e-9,
    );
    Run::new(model, (), plan, 0.0559)
}

fn step(run: &mut Crushed, count: usize) {
    for _ in 0..count {
        if run.step == run.next_refresh {
            run.refresh();
        }
        run.advance(false);
    }
}

#[test]
fn a_run_with_levels_of_steps_goes_on_with_the_same_bits() {
    let plan = planned();
    let mut whole = run(&plan);
    while whole.model.points.deepest() < 2 {
        step(&mut whole, 1);
        assert!(whole.step < 5000, "cells are squeezed");
    }
    let mut tape = Tape::default();
    whole.save(&mut tape);
    let mut rest = run(&plan);
    rest.load(&mut Tape::from_bytes(tape.as_bytes().to_vec()))
        .expect("the tape fits");
    step(&mut whole, 60);
    step(&mut rest, 60);
    let bits = |run: &Crushed| -> Vec<u64> {
        let numbers = run.u.iter().chain(&run.v).flatten();
        numbers.map(|x| x.to_bits()).collect()
    };
    assert_eq!(bits(&whole), bits(&rest));
}

//! Fit to independent finite-element impacts (`tests/data/reference/README.md`): F*, delta*, e within 3 %.

use crate::impacts::{MATERIAL, case, references};
use impactlaw::contact::NormalLaw;
use impactlaw::fit::{Fit, Outcome, fit};

fn print(fit: &Fit) {
    let Outcome::Yielding {
        closed_form: Some(closed_form),
        spline: Some(spline),
    } = &fit.outcome
    else {
        panic!("the reference yields");
    };
    println!(
        "{:?}\n{:?}",
        closed_form.law.loading(),
        closed_form.law.unloading()
    );
    println!(
        "{:?}\n{:?}",
        spline.law.loading().knots(),
        spline.law.unloading()
    );
    println!(
        "{:?}\n{:?}",
        closed_form.law.inertia(),
        spline.law.inertia()
    );
    for q in closed_form.quality.iter().chain(&spline.quality) {
        println!("{q:.4?}");
    }
    println!("{:.3?}\n{:.3?}", closed_form.intervals, spline.intervals);
    println!("{:.3?}\n{:.3?}", closed_form.left_out, spline.left_out);
}

#[test]
fn both_forms_return_the_figures_within_three_per_cent() {
    let case = case(MATERIAL, &[10.0, 50.0]);
    let fit = fit(&case, &references()).unwrap();
    print(&fit);
    let Outcome::Yielding {
        closed_form: Some(closed_form),
        spline: Some(spline),
    } = &fit.outcome
    else {
        panic!("the reference yields");
    };
    for q in closed_form.quality.iter().chain(&spline.quality) {
        assert!(q.worst() < 0.01, "{q:?}");
        assert!(q.loading_force < 0.03 && q.unloading_force < 0.03, "{q:?}");
    }
}

#[test]
fn one_speed_has_neither_intervals_nor_left_out_errors() {
    let [_, fast] = references();
    let fit = fit(&case(MATERIAL, &[50.0]), &[fast]).unwrap();
    let Outcome::Yielding {
        closed_form: Some(closed_form),
        ..
    } = &fit.outcome
    else {
        panic!("the reference yields");
    };
    assert!(closed_form.quality[0].worst() < 0.03);
    assert!(closed_form.intervals.is_none() && closed_form.left_out.is_empty());
}

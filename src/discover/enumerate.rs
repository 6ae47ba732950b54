//! Every structure up to a stated size, bottom-up, each once.
//!
//! Sums and products are flat and sorted; power products take in what multiplies them; exp and log undo each other. What is left
//! twice is caught after the fit, by its values.

use super::formula::Shape;
use std::collections::BTreeSet;

/// Structures with up to `size` nodes over the leaves given, in the order of size and then of the text.
#[must_use]
pub fn shapes(leaves: &[Shape], size: usize) -> Vec<Shape> {
    let mut by_size: Vec<Vec<Shape>> = vec![Vec::new()];
    for n in 1..=size {
        let mut found: BTreeSet<Shape> = BTreeSet::new();
        if n == 1 {
            found.extend(leaves.iter().cloned());
            found.insert(Shape::One);
        } else {
            for inner in &by_size[n - 1] {
                found.extend(unary(inner));
            }
            for left in 1..n - 1 {
                for a in &by_size[left] {
                    for b in &by_size[n - 1 - left] {
                        found.extend(sum(a, b));
                        found.extend(product(a, b));
                    }
                }
            }
        }
        by_size.push(found.into_iter().collect());
    }
    by_size.into_iter().flatten().collect()
}

/// What one operation makes of an expression.
fn unary(inner: &Shape) -> Vec<Shape> {
    let boxed = || Box::new(inner.clone());
    let mut found = Vec::new();
    match inner {
        Shape::One | Shape::Minus(_) => {}
        Shape::Sum(all) => {
            found.push(Shape::Power(boxed()));
            found.push(Shape::Log(boxed()));
            // exp(1 + x) is a constant times exp(x)
            if !all.contains(&Shape::One) {
                found.push(Shape::Exp(boxed()));
                found.push(Shape::Tanh(boxed()));
            }
        }
        Shape::Leaf(_) => {
            found.push(Shape::Exp(boxed()));
            found.push(Shape::Tanh(boxed()));
        }
        Shape::Product(_) | Shape::Power(_) => {
            found.push(Shape::Exp(boxed()));
            found.push(Shape::Tanh(boxed()));
            found.push(Shape::Minus(boxed()));
        }
        Shape::Exp(_) | Shape::Tanh(_) | Shape::Log(_) => found.push(Shape::Minus(boxed())),
    }
    found
}

/// Terms of a sum.
fn terms(shape: &Shape) -> Vec<Shape> {
    match shape {
        Shape::Sum(all) => all.clone(),
        one => vec![one.clone()],
    }
}

/// Factors of a product.
fn factors(shape: &Shape) -> Vec<Shape> {
    match shape {
        Shape::Product(all) => all.clone(),
        one => vec![one.clone()],
    }
}

/// Sum of two expressions, if it is a new one.
#[must_use]
pub fn sum(a: &Shape, b: &Shape) -> Option<Shape> {
    let mut all = terms(a);
    all.extend(terms(b));
    all.sort();
    let ones = all.iter().filter(|one| **one == Shape::One).count();
    let minus = all.iter().filter(|one| matches!(one, Shape::Minus(_)));
    // two numbers add up to one, and a sum of negatives is a negative sum
    (ones <= 1 && minus.count() <= 1).then_some(Shape::Sum(all))
}

/// Product of two expressions, if it is a new one.
#[must_use]
pub fn product(a: &Shape, b: &Shape) -> Option<Shape> {
    let mut all = factors(a);
    all.extend(factors(b));
    all.sort();
    let count = |is: fn(&Shape) -> bool| all.iter().filter(|one| is(one)).count();
    let fine = count(|one| matches!(one, Shape::One | Shape::Minus(_))) == 0
        && count(|one| matches!(one, Shape::Leaf(_))) <= 1
        && count(|one| matches!(one, Shape::Exp(_))) <= 1;
    fine.then_some(Shape::Product(all))
}

/// Structures one step beyond `shape`: each place gets one more power product, factor or exponential. What is new comes with
/// `leaf` and starts near nothing, so that a fit goes on from where the old one ended.
#[must_use]
pub fn grown(shape: &Shape, leaf: &Shape) -> Vec<Shape> {
    let mut found = BTreeSet::new();
    found.extend(around(shape, leaf));
    match shape {
        Shape::Sum(all) => {
            for (i, one) in all.iter().enumerate() {
                for new in grown(one, leaf) {
                    let mut rest = all.clone();
                    rest.remove(i);
                    let rest = match rest.len() {
                        1 => rest.remove(0),
                        _ => Shape::Sum(rest),
                    };
                    found.extend(sum(&new, &rest));
                }
            }
        }
        Shape::Product(all) => {
            for (i, one) in all.iter().enumerate() {
                for new in grown(one, leaf) {
                    let mut rest = all.clone();
                    rest.remove(i);
                    let rest = match rest.len() {
                        1 => rest.remove(0),
                        _ => Shape::Product(rest),
                    };
                    found.extend(product(&new, &rest));
                }
            }
        }
        Shape::Minus(inner) => {
            found.extend(
                grown(inner, leaf)
                    .into_iter()
                    .map(|s| Shape::Minus(Box::new(s))),
            );
        }
        Shape::Power(inner) => {
            let sums = grown(inner, leaf).into_iter();
            let sums = sums.filter(|s| matches!(s, Shape::Sum(_)));
            found.extend(sums.map(|s| Shape::Power(Box::new(s))));
        }
        Shape::Exp(inner) => {
            found.extend(
                grown(inner, leaf)
                    .into_iter()
                    .map(|s| Shape::Exp(Box::new(s))),
            );
        }
        Shape::Log(inner) => {
            found.extend(
                grown(inner, leaf)
                    .into_iter()
                    .map(|s| Shape::Log(Box::new(s))),
            );
        }
        Shape::Tanh(inner) => {
            found.extend(
                grown(inner, leaf)
                    .into_iter()
                    .map(|s| Shape::Tanh(Box::new(s))),
            );
        }
        Shape::One | Shape::Leaf(_) => {}
    }
    found.into_iter().collect()
}

/// One more term or factor at the root.
fn around(shape: &Shape, leaf: &Shape) -> Vec<Shape> {
    let near_one = Shape::Power(Box::new(Shape::Sum(vec![Shape::One, leaf.clone()])));
    let fading = Shape::Exp(Box::new(leaf.clone()));
    [
        sum(shape, leaf),
        product(shape, &near_one),
        product(shape, &fading),
    ]
    .into_iter()
    .flatten()
    .collect()
}

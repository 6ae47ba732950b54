//! Formulas over dimensionless groups: sums, products, powers, exp, log and tanh of power products.
//!
//! The smallest piece is a power product of the groups with a coefficient, `c p1^a1 p2^a2 ...`: products of powers
//! come before sums. What algebra makes equal is one shape: a product of two power products is one, a power of a power is one.

pub use super::ratio::Ratio;
use std::fmt::Write as _;

/// Groups of many rows, in columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Columns {
    /// Number of rows.
    pub rows: usize,
    /// Natural logarithm of every group.
    pub logs: Vec<Vec<f64>>,
    /// Natural logarithm of every factor that vanishes at the limit; minus infinity there.
    pub vanishing: Vec<Vec<f64>>,
}

impl Columns {
    /// The rows of these numbers.
    #[must_use]
    pub fn some(&self, rows: &[usize]) -> Columns {
        let pick = |columns: &[Vec<f64>]| {
            let column = |all: &Vec<f64>| rows.iter().map(|&row| all[row]).collect();
            columns.iter().map(column).collect()
        };
        Columns {
            rows: rows.len(),
            logs: pick(&self.logs),
            vanishing: pick(&self.vanishing),
        }
    }
}

/// Where a number of a formula comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// Fitted: a constant of the formula.
    Free,
    /// Part of the structure.
    Fixed(Ratio),
    /// So many times another number, which is free.
    Tied(usize, Ratio),
}

/// What a number of a formula does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Coefficient of a power product.
    Coefficient,
    /// Exponent of a group.
    Exponent,
    /// Exponent of a factor that vanishes at the limit; positive.
    Order,
    /// Exponent of a sum.
    Power,
}

/// Structure of a formula; numbers are counted through in the order of the text.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// 1.
    One,
    /// Power product; with the number of the vanishing factor it holds, if it holds one.
    Leaf(Option<usize>),
    /// Sum of at least two.
    Sum(Vec<Shape>),
    /// Minus it.
    Minus(Box<Shape>),
    /// Product of at least two.
    Product(Vec<Shape>),
    /// Power of a sum.
    Power(Box<Shape>),
    /// Exponential.
    Exp(Box<Shape>),
    /// Natural logarithm.
    Log(Box<Shape>),
    /// Hyperbolic tangent.
    Tanh(Box<Shape>),
}

impl Shape {
    /// Nodes of the tree, operations among them.
    #[must_use]
    pub fn size(&self) -> usize {
        match self {
            Shape::One | Shape::Leaf(_) => 1,
            Shape::Sum(all) | Shape::Product(all) => {
                all.iter().map(Shape::size).sum::<usize>() + all.len() - 1
            }
            Shape::Minus(inner)
            | Shape::Power(inner)
            | Shape::Exp(inner)
            | Shape::Log(inner)
            | Shape::Tanh(inner) => inner.size() + 1,
        }
    }

    /// Number of power products.
    #[must_use]
    pub fn leaves(&self) -> usize {
        match self {
            Shape::One => 0,
            Shape::Leaf(_) => 1,
            Shape::Sum(all) | Shape::Product(all) => all.iter().map(Shape::leaves).sum(),
            Shape::Minus(inner)
            | Shape::Power(inner)
            | Shape::Exp(inner)
            | Shape::Log(inner)
            | Shape::Tanh(inner) => inner.leaves(),
        }
    }

    /// Roles of the numbers, in order, for `groups` groups.
    #[must_use]
    pub fn roles(&self, groups: usize) -> Vec<Role> {
        let mut roles = Vec::new();
        self.collect(groups, &mut roles);
        roles
    }

    fn collect(&self, groups: usize, roles: &mut Vec<Role>) {
        match self {
            Shape::One => {}
            Shape::Leaf(vanishing) => {
                roles.push(Role::Coefficient);
                roles.extend((0..groups).map(|_| Role::Exponent));
                roles.extend(vanishing.map(|_| Role::Order));
            }
            Shape::Sum(all) | Shape::Product(all) => {
                all.iter().for_each(|one| one.collect(groups, roles));
            }
            Shape::Power(inner) => {
                inner.collect(groups, roles);
                roles.push(Role::Power);
            }
            Shape::Minus(inner) | Shape::Exp(inner) | Shape::Log(inner) | Shape::Tanh(inner) => {
                inner.collect(groups, roles);
            }
        }
    }
}

/// Values of an expression over the rows, and their derivatives by some of its numbers.
#[derive(Debug, Clone)]
pub struct Slopes {
    /// Values.
    pub values: Vec<f64>,
    /// Number and derivative of every row by it.
    pub slopes: Vec<(usize, Vec<f64>)>,
}

impl Slopes {
    /// Through a function of one variable: `f` gives value and slope.
    fn through(mut self, f: impl Fn(f64) -> (f64, f64)) -> Self {
        let mut slope = Vec::with_capacity(self.values.len());
        for value in &mut self.values {
            let (y, dy) = f(*value);
            *value = y;
            slope.push(dy);
        }
        for (_, column) in &mut self.slopes {
            column.iter_mut().zip(&slope).for_each(|(d, s)| *d *= s);
        }
        self
    }

    fn plus(mut self, other: Slopes) -> Self {
        let both = self.values.iter_mut().zip(&other.values);
        both.for_each(|(a, b)| *a += b);
        self.slopes.extend(other.slopes);
        self
    }

    fn times(mut self, mut other: Slopes) -> Self {
        for (_, column) in &mut self.slopes {
            let both = column.iter_mut().zip(&other.values);
            both.for_each(|(d, b)| *d *= b);
        }
        for (_, column) in &mut other.slopes {
            column
                .iter_mut()
                .zip(&self.values)
                .for_each(|(d, a)| *d *= a);
        }
        let both = self.values.iter_mut().zip(&other.values);
        both.for_each(|(a, b)| *a *= b);
        self.slopes.extend(other.slopes);
        self
    }
}

/// A formula: structure, numbers, and where each comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    /// Structure.
    pub shape: Shape,
    /// Numbers, in the order of [`Shape::roles`].
    pub numbers: Vec<f64>,
    /// Their sources.
    pub sources: Vec<Source>,
}

impl Formula {
    /// A formula with all its numbers free.
    #[must_use]
    pub fn free(shape: Shape, numbers: Vec<f64>) -> Self {
        let sources = vec![Source::Free; numbers.len()];
        Formula {
            shape,
            numbers,
            sources,
        }
    }

    /// Which numbers are fitted.
    #[must_use]
    pub fn constants(&self) -> Vec<usize> {
        let free = |&i: &usize| self.sources[i] == Source::Free;
        (0..self.numbers.len()).filter(free).collect()
    }

    /// Takes the values of its constants, and sets what is tied to them.
    pub fn set(&mut self, constants: &[f64]) {
        for (i, value) in self.constants().into_iter().zip(constants) {
            self.numbers[i] = *value;
        }
        self.settle();
    }

    /// Sets fixed and tied numbers by their sources.
    pub fn settle(&mut self) {
        for i in 0..self.numbers.len() {
            match self.sources[i] {
                Source::Free => {}
                Source::Fixed(ratio) => self.numbers[i] = ratio.value(),
                Source::Tied(to, ratio) => self.numbers[i] = ratio.value() * self.numbers[to],
            }
        }
    }

    /// Values over the rows.
    #[must_use]
    pub fn values(&self, columns: &Columns) -> Vec<f64> {
        let mut next = 0;
        self.walk(&self.shape, columns, &mut next, false).values
    }

    /// Values over the rows, and derivatives by the constants in their order.
    #[must_use]
    pub fn slopes(&self, columns: &Columns) -> (Vec<f64>, Vec<Vec<f64>>) {
        let mut next = 0;
        let all = self.walk(&self.shape, columns, &mut next, true);
        let constants = self.constants();
        let mut by = vec![vec![0.0; columns.rows]; constants.len()];
        for (number, column) in all.slopes {
            let (to, factor) = match self.sources[number] {
                Source::Free => (number, 1.0),
                Source::Fixed(_) => continue,
                Source::Tied(to, ratio) => (to, ratio.value()),
            };
            if let Some(at) = constants.iter().position(|&c| c == to) {
                let both = by[at].iter_mut().zip(&column);
                both.for_each(|(sum, d)| *sum += factor * d);
            }
        }
        (all.values, by)
    }

    fn leaf(
        &self,
        vanishing: Option<usize>,
        columns: &Columns,
        next: &mut usize,
        wanted: bool,
    ) -> Slopes {
        let first = *next;
        let groups = columns.logs.len();
        *next += 1 + groups + usize::from(vanishing.is_some());
        let mut factors: Vec<(usize, &Vec<f64>)> = (0..groups)
            .map(|j| (first + 1 + j, &columns.logs[j]))
            .collect();
        factors.extend(vanishing.map(|k| (first + 1 + groups, &columns.vanishing[k])));
        let mut bare = vec![0.0; columns.rows];
        for &(number, logs) in &factors {
            let exponent = self.numbers[number];
            if exponent != 0.0 {
                let both = bare.iter_mut().zip(logs);
                both.for_each(|(sum, log)| *sum += exponent * log);
            }
        }
        bare.iter_mut().for_each(|value| *value = value.exp());
        let coefficient = self.numbers[first];
        let values: Vec<f64> = bare.iter().map(|b| coefficient * b).collect();
        let mut slopes = Vec::new();
        if wanted {
            for &(number, logs) in &factors {
                if !matches!(self.sources[number], Source::Fixed(_)) {
                    let slope = values.iter().zip(logs).map(|(v, log)| v * log);
                    slopes.push((number, slope.collect()));
                }
            }
            if !matches!(self.sources[first], Source::Fixed(_)) {
                slopes.push((first, bare));
            }
        }
        Slopes { values, slopes }
    }

    fn walk(&self, shape: &Shape, columns: &Columns, next: &mut usize, wanted: bool) -> Slopes {
        let inner = |shape: &Shape, next: &mut usize| self.walk(shape, columns, next, wanted);
        match shape {
            Shape::One => Slopes {
                values: vec![1.0; columns.rows],
                slopes: Vec::new(),
            },
            Shape::Leaf(vanishing) => self.leaf(*vanishing, columns, next, wanted),
            Shape::Sum(all) => {
                let first = inner(&all[0], next);
                all[1..]
                    .iter()
                    .fold(first, |sum, one| sum.plus(inner(one, next)))
            }
            Shape::Product(all) => {
                let first = inner(&all[0], next);
                all[1..]
                    .iter()
                    .fold(first, |product, one| product.times(inner(one, next)))
            }
            Shape::Minus(one) => inner(one, next).through(|x| (-x, -1.0)),
            Shape::Exp(one) => inner(one, next).through(|x| (x.exp(), x.exp())),
            Shape::Log(one) => inner(one, next).through(|x| (x.ln(), 1.0 / x)),
            Shape::Tanh(one) => inner(one, next).through(|x| {
                let y = x.tanh();
                (y, 1.0 - y * y)
            }),
            Shape::Power(one) => {
                let base = inner(one, next);
                let number = *next;
                *next += 1;
                let p = self.numbers[number];
                let by_power = (wanted && !matches!(self.sources[number], Source::Fixed(_)))
                    .then(|| base.values.iter().map(|x| x.powf(p) * x.ln()).collect());
                let mut power = base.through(|x| (x.powf(p), p * x.powf(p - 1.0)));
                power.slopes.extend(by_power.map(|column| (number, column)));
                power
            }
        }
    }

    /// Bits of the structure: operations, and the numbers that are not fitted.
    #[must_use]
    pub fn bits(&self) -> f64 {
        // one of ten kinds of node
        let nodes = self.shape.size() as f64 * 10f64.log2();
        let constants = self.constants().len().max(1) as f64;
        let numbers = self.sources.iter().map(|source| match source {
            Source::Free => 0.0,
            Source::Fixed(ratio) => ratio.bits(),
            Source::Tied(_, ratio) => ratio.bits() + constants.log2() + 1.0,
        });
        nodes + numbers.sum::<f64>()
    }

    /// As text, with the names of groups and vanishing factors; every number is written by `number` from its index.
    #[must_use]
    pub fn text(
        &self,
        groups: &[String],
        vanishing: &[String],
        number: &dyn Fn(usize) -> String,
    ) -> String {
        let names = Names {
            groups,
            vanishing,
            number,
        };
        let mut next = 0;
        self.write(&self.shape, &names, &mut next)
    }

    fn write(&self, shape: &Shape, names: &Names<'_>, next: &mut usize) -> String {
        let inner = |shape: &Shape, next: &mut usize| self.write(shape, names, next);
        match shape {
            Shape::One => "1".to_owned(),
            Shape::Leaf(vanishing) => self.leaf_text(*vanishing, names, next),
            Shape::Sum(all) => {
                let mut text = String::new();
                for one in all {
                    let term = inner(one, next);
                    match (text.is_empty(), term.strip_prefix('-')) {
                        (true, _) => text = term,
                        (false, Some(rest)) => {
                            let _ = write!(text, " - {rest}");
                        }
                        (false, None) => {
                            let _ = write!(text, " + {term}");
                        }
                    }
                }
                text
            }
            Shape::Product(all) => {
                let factor = |one: &Shape, next: &mut usize| match one {
                    Shape::Sum(_) | Shape::Minus(_) => format!("({})", inner(one, next)),
                    _ => inner(one, next),
                };
                let parts: Vec<String> = all.iter().map(|one| factor(one, next)).collect();
                let parts: Vec<String> = parts.into_iter().filter(|part| part != "1").collect();
                match parts.is_empty() {
                    true => "1".to_owned(),
                    false => parts.join(" * "),
                }
            }
            Shape::Minus(one) => format!("-({})", inner(one, next)),
            Shape::Exp(one) => format!("exp({})", inner(one, next)),
            Shape::Log(one) => format!("log({})", inner(one, next)),
            Shape::Tanh(one) => format!("tanh({})", inner(one, next)),
            Shape::Power(one) => {
                let base = inner(one, next);
                let number = *next;
                *next += 1;
                format!("({base})^{}", self.exponent(number, names))
            }
        }
    }

    /// An exponent; brackets where it is no bare positive number.
    fn exponent(&self, number: usize, names: &Names<'_>) -> String {
        let text = match self.sources[number] {
            Source::Free => (names.number)(number),
            Source::Fixed(ratio) => ratio.to_string(),
            Source::Tied(to, ratio) => {
                let base = (names.number)(to);
                match (ratio.over, ratio.under) {
                    (1, 1) => base,
                    (-1, 1) => format!("-{base}").replace("--", ""),
                    (_, 1) => format!("{ratio}*{base}"),
                    _ => format!("({ratio})*{base}"),
                }
            }
        };
        let bare = |c: char| c.is_ascii_alphanumeric() || c == '.' || c == '_';
        match text.chars().all(bare) {
            true => text,
            false => format!("({text})"),
        }
    }

    fn leaf_text(&self, vanishing: Option<usize>, names: &Names<'_>, next: &mut usize) -> String {
        let first = *next;
        let groups = names.groups.len();
        *next += 1 + groups + usize::from(vanishing.is_some());
        let mut parts = Vec::new();
        let mut sign = "";
        match self.sources[first] {
            Source::Fixed(Ratio { over: 1, under: 1 }) => {}
            Source::Fixed(Ratio { over: -1, under: 1 }) => sign = "-",
            Source::Fixed(ratio) => parts.push(match ratio.under {
                1 => ratio.to_string(),
                _ => format!("({ratio})"),
            }),
            _ => parts.push((names.number)(first)),
        }
        let symbols = names.groups.iter().map(String::as_str);
        let symbols = symbols.chain(vanishing.map(|k| &names.vanishing[k][..]));
        for (j, symbol) in symbols.enumerate() {
            let number = first + 1 + j;
            match self.sources[number] {
                Source::Fixed(Ratio { over: 0, .. }) => {}
                Source::Fixed(Ratio { over: 1, under: 1 }) => parts.push(symbol.to_owned()),
                _ => parts.push(format!("{symbol}^{}", self.exponent(number, names))),
            }
        }
        match parts.is_empty() {
            true => format!("{sign}1"),
            false => format!("{sign}{}", parts.join(" * ")),
        }
    }
}

/// How groups, factors and numbers are written.
struct Names<'a> {
    groups: &'a [String],
    vanishing: &'a [String],
    number: &'a dyn Fn(usize) -> String,
}

//! Formulas as text: numbers, names, + - * / ^, brackets, exp, log, sqrt and tanh, evaluated with the values of the names.

/// A parsed formula.
#[derive(Debug, Clone, PartialEq)]
pub enum Infix {
    /// A number.
    Number(f64),
    /// A name.
    Name(String),
    /// Minus it.
    Minus(Box<Infix>),
    /// Two with an operator between them.
    Two(Box<Infix>, char, Box<Infix>),
    /// A function of it.
    Of(Function, Box<Infix>),
}

/// Functions a formula may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    /// Exponential.
    Exp,
    /// Natural logarithm.
    Log,
    /// Square root.
    Sqrt,
    /// Hyperbolic tangent.
    Tanh,
}

/// Deepest nesting.
const DEEPEST: usize = 64;

struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
}

impl Infix {
    /// Parses a formula; what is wrong with it otherwise.
    ///
    /// # Errors
    /// A sentence with the place.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut reader = Reader {
            text,
            at: 0,
            depth: 0,
        };
        let formula = reader.sum()?;
        match reader.peek() {
            None => Ok(formula),
            Some(c) => Err(format!("`{c}` at {} is not expected", reader.at + 1)),
        }
    }

    /// Names it holds, in the order of the text.
    #[must_use]
    pub fn names(&self) -> Vec<&str> {
        match self {
            Infix::Number(_) => Vec::new(),
            Infix::Name(name) => vec![name],
            Infix::Minus(inner) | Infix::Of(_, inner) => inner.names(),
            Infix::Two(a, _, b) => [a.names(), b.names()].concat(),
        }
    }

    /// Value with what `value` gives for the names; NaN for a name it does not know.
    #[must_use]
    pub fn value(&self, value: &dyn Fn(&str) -> Option<f64>) -> f64 {
        match self {
            Infix::Number(number) => *number,
            Infix::Name(name) => value(name).unwrap_or(f64::NAN),
            Infix::Minus(inner) => -inner.value(value),
            Infix::Two(a, operator, b) => {
                let (a, b) = (a.value(value), b.value(value));
                match operator {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    '/' => a / b,
                    _ => a.powf(b),
                }
            }
            Infix::Of(function, inner) => {
                let x = inner.value(value);
                match function {
                    Function::Exp => x.exp(),
                    Function::Log => x.ln(),
                    Function::Sqrt => x.sqrt(),
                    Function::Tanh => x.tanh(),
                }
            }
        }
    }
}

impl Reader<'_> {
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let there = self.peek() == Some(wanted);
        if there {
            self.at += wanted.len_utf8();
        }
        there
    }

    fn sum(&mut self) -> Result<Infix, String> {
        let mut left = self.product()?;
        loop {
            let operator = match self.peek() {
                Some(c @ ('+' | '-')) => c,
                _ => return Ok(left),
            };
            self.at += 1;
            left = Infix::Two(Box::new(left), operator, Box::new(self.product()?));
        }
    }

    fn product(&mut self) -> Result<Infix, String> {
        let mut left = self.signed()?;
        loop {
            let operator = match self.peek() {
                Some(c @ ('*' | '/')) => c,
                _ => return Ok(left),
            };
            self.at += 1;
            left = Infix::Two(Box::new(left), operator, Box::new(self.signed()?));
        }
    }

    fn signed(&mut self) -> Result<Infix, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!(
                "more than {DEEPEST} brackets and signs within each other"
            ));
        }
        let found = match self.take('-') {
            true => Infix::Minus(Box::new(self.signed()?)),
            false => self.power()?,
        };
        self.depth -= 1;
        Ok(found)
    }

    /// A power binds to its right, and before a sign to its left.
    fn power(&mut self) -> Result<Infix, String> {
        let base = self.atom()?;
        match self.take('^') {
            true => Ok(Infix::Two(Box::new(base), '^', Box::new(self.signed()?))),
            false => Ok(base),
        }
    }

    fn atom(&mut self) -> Result<Infix, String> {
        let Some(first) = self.peek() else {
            return Err("it ends where a number, a name or a bracket is expected".to_owned());
        };
        if self.take('(') {
            let inner = self.sum()?;
            return match self.take(')') {
                true => Ok(inner),
                false => Err(format!("`)` is missing at {}", self.at + 1)),
            };
        }
        let rest = &self.text[self.at..];
        if first.is_ascii_digit() || first == '.' {
            let length = number_length(rest);
            let digits = &rest[..length];
            self.at += length;
            return match digits.parse::<f64>() {
                Ok(number) if number.is_finite() => Ok(Infix::Number(number)),
                _ => Err(format!("`{digits}` is no number")),
            };
        }
        let length = rest
            .find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .unwrap_or(rest.len());
        if length == 0 {
            return Err(format!("`{first}` at {} is not expected", self.at + 1));
        }
        let name = rest[..length].to_owned();
        self.at += length;
        let function = match &name[..] {
            "exp" => Function::Exp,
            "log" => Function::Log,
            "sqrt" => Function::Sqrt,
            "tanh" => Function::Tanh,
            _ => return Ok(Infix::Name(name)),
        };
        if self.peek() != Some('(') {
            return Err(format!("`(` is missing behind `{name}`"));
        }
        // the bracket is read as an atom
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(format!(
                "more than {DEEPEST} brackets and signs within each other"
            ));
        }
        let inner = self.atom()?;
        self.depth -= 1;
        Ok(Infix::Of(function, Box::new(inner)))
    }
}

/// Length of the number at the start of a text: digits, a point, an exponent.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let mut end = 0;
    while digit(end) || bytes.get(end) == Some(&b'.') {
        end += 1;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if digit(end + 1 + sign) {
            end += 1 + sign;
            while digit(end) {
                end += 1;
            }
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        let names = |name: &str| match name {
            "x" => Some(2.0),
            "y_2" => Some(5.0),
            _ => None,
        };
        Infix::parse(text).unwrap().value(&names)
    }

    #[test]
    fn operators_bind_as_in_algebra() {
        assert_eq!(value("1 + 2*3"), 7.0);
        assert_eq!(value("2^3^2"), 512.0);
        assert_eq!(value("-x^2"), -4.0);
        assert_eq!(value("x^-1"), 0.5);
        assert_eq!(value("8/2/2 - 1"), 1.0);
        assert_eq!(value("(1 + x)^(1/2)*y_2"), 3f64.sqrt() * 5.0);
        assert_eq!(value("exp(log(x)) + sqrt(4) - tanh(0)"), 4.0);
        assert_eq!(value("1.5e-3*2"), 0.003);
        assert!(value("unknown + 1").is_nan());
    }

    #[test]
    fn what_is_no_formula_is_said_with_its_place() {
        for text in [
            "", "1 +", "(1", "1)", "2 x", "exp 2", "1..2", "a $ b", "*2", "1e999",
        ] {
            assert!(Infix::parse(text).is_err(), "{text}");
        }
        let deep = "(".repeat(500) + "1" + &")".repeat(500);
        assert!(
            Infix::parse(&deep)
                .unwrap_err()
                .contains("within each other")
        );
        assert!(Infix::parse(&("-".repeat(500) + "1")).is_err());
    }
}

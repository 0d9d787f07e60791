//! Lubricant laws: numbers in, numbers and derivatives out.

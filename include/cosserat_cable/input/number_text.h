// Numbers as text: what users write, and what reads back to the same bits.
#pragma once

#include <string>

namespace cosserat_cable {

/// What a piece of text is, read as a number.
struct NumberText {
  enum class Kind {
    kFinite,     ///< `value` holds it
    kNonFinite,  ///< nan or inf, with or without YAML's dot, or too large for a double
    kNone        ///< no number
  };
  Kind kind = Kind::kNone;
  double value = 0;
};

/// Reads decimal numbers with optional fraction and exponent ("12", "-.5", "1e-3", "1."), in any
/// locale. Hexadecimal, digit separators, units and decimal commas are no numbers.
NumberText ParseNumber(const std::string& text);

/// The shortest decimal text, of at most 17 digits, that reads back to the same double.
/// @pre `value` is finite.
std::string FormatNumber(double value);

/// Rounded to so many significant digits, for people: without an exponent from 1e-4 to below 1e6.
/// @pre `value` is finite.
std::string FormatRounded(double value, int digits = 3);

/// A length [m] for people, in millimetres where it rounds to less than a metre: "12.3 mm".
/// @pre `metres` is finite.
std::string FormatLength(double metres, int digits = 3);

}  // namespace cosserat_cable

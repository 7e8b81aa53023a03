// Expressions over the signals of a run, such as `separation > 1 m and not link(jurong, gcs)`. A number has a unit; a
// condition has a truth and a margin: how far it is from the opposite, in the unit of what is compared. Margins follow
// the quantitative semantics of signal temporal logic (A. Donze and O. Maler, "Robust Satisfaction of Temporal Logic
// over Real-Valued Signals", FORMATS 2010): of a > b it is a - b, of `and` the lesser, of `or` the greater, of `not`
// the opposite. What is true or false by itself has an infinite margin. A margin of 0 says nothing of the truth, which
// is therefore kept beside it.
// A quotient by 0 is undefined, as is what is computed of it; separations may be infinite, and the difference of two
// infinite ones is undefined, too. A comparison with an undefined number is neither true nor false: `not` of it is as
// undefined, `and` is false where its other part is, `or` true where its other part is (S. C. Kleene's strong logic).
// expression_parser.hpp reads them.  Pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/expressions/unit.hpp"

namespace skein {

struct Expression {
  enum class Op {
    number,
    signal,  ///< a boolean one is true from 0.5 on
    negate,
    add,
    subtract,
    multiply,
    divide,
    least,
    greatest,
    absolute,
    gain,   ///< what it has grown since the anchor
    rises,  ///< more than in the exchange before; of a condition: true, and it was not
    falls,
    less,
    at_most,
    more,
    at_least,
    equal,
    unequal,
    negation,
    conjunction,
    disjunction
  };

  Op op = Op::number;
  double number = 0.0;     ///< of a number, in SI
  std::size_t signal = 0;  ///< of a signal: its slot in the list of those that are used
  std::vector<Expression> parts = {};
  Unit unit = {};  ///< of a number, or of a condition's margin; plain where the margins of parts differ in it
  bool is_condition = false;
  bool is_certain = false;  ///< a condition whose margin is infinite
  std::size_t at = 0;       ///< where it begins in its text
};

/// The values of all signals that are used, by slot.
struct Instant {
  std::span<const double> now, before;  ///< in this exchange and in the one before; in the first, both are the same
  std::span<const double> anchor;       ///< what `gain` counts from
};

struct Margin {
  bool holds = false;
  double margin = 0.0;
  bool is_defined = true;  ///< else it neither holds nor fails: `holds` is false, and the margin 0
};

inline constexpr Margin kUndefined = {false, 0.0, false};

/// Of an undefined one and another, what the other alone decides, if it does.
inline Margin both(const Margin& a, const Margin& b) {
  if (!a.is_defined) return b.is_defined && !b.holds ? b : kUndefined;
  if (!b.is_defined) return a.holds ? kUndefined : a;
  return {a.holds && b.holds, std::min(a.margin, b.margin)};
}
inline Margin opposite(const Margin& a) { return a.is_defined ? Margin{!a.holds, -a.margin} : kUndefined; }
inline Margin either(const Margin& a, const Margin& b) { return opposite(both(opposite(a), opposite(b))); }
/// Of what is true or false by itself.
inline Margin certain(bool holds) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {holds, holds ? kInfinity : -kInfinity};
}

/// @param expression  a number. @returns NaN where it is undefined.
double number_at(const Expression& expression, const Instant& instant);
/// @param expression  a condition.
Margin margin_at(const Expression& expression, const Instant& instant);

}  // namespace skein

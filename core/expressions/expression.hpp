// Expressions over the signals of a run, such as `separation > 1 m and not link(jurong, gcs)`. A number has a unit. A
// condition has a truth value and a margin: its distance from changing its truth value, in the unit of the compared
// numbers. Margins follow the quantitative semantics of signal temporal logic (A. Donze and O. Maler, "Robust
// Satisfaction of Temporal Logic over Real-Valued Signals", FORMATS 2010): the margin of a > b is a - b; that of `and`
// is the smaller of its parts' margins, that of `or` the greater, that of `not` the negative. A condition without a
// comparison, such as a boolean signal, has an infinite margin. At a margin of 0, a condition may be true or false, so
// the truth value is stored separately.
// A quotient by 0 is undefined, and so is every number computed from it. Separations may be infinite; a sum or
// difference of infinities may be undefined. A comparison with an undefined number is undefined: neither true nor
// false. `not` of it is undefined, too; `and` is false if its other part is false, `or` is true if its other part is
// true, otherwise they are undefined (S. C. Kleene's strong logic). expression_parser.hpp parses expressions.  Pure.
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
    signal,  ///< as a condition: true if at least 0.5
    negate,
    add,
    subtract,
    multiply,
    divide,
    least,
    greatest,
    absolute,
    gain,   ///< increase since the anchor
    rises,  ///< a number is greater than in the previous exchange; a condition has become true
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
  double number = 0.0;     ///< for Op::number: its value in SI
  std::size_t signal = 0;  ///< for Op::signal: its slot, the index in the list of used signals
  std::vector<Expression> parts = {};
  Unit unit = {};  ///< of a number, or of a condition's margin; plain if the parts' margins have different units
  bool is_condition = false;
  bool is_certain = false;  ///< a condition whose margin is infinite
  std::size_t at = 0;       ///< index in the text at which the expression begins
};

/// The values of all used signals, by slot.
struct Instant {
  std::span<const double> now, before;  ///< in this exchange and in the previous one; the same in the first exchange
  std::span<const double> anchor;       ///< values from which `gain` counts
};

struct Margin {
  bool holds = false;
  double margin = 0.0;
  bool is_defined = true;  ///< false: the condition neither holds nor fails; `holds` is false, and the margin 0
};

inline constexpr Margin kUndefined = {false, 0.0, false};

/// `and`. If one part is undefined, the result is the other part if that is false, otherwise undefined.
inline Margin both(const Margin& a, const Margin& b) {
  if (!a.is_defined) return b.is_defined && !b.holds ? b : kUndefined;
  if (!b.is_defined) return a.holds ? kUndefined : a;
  return {a.holds && b.holds, std::min(a.margin, b.margin)};
}
inline Margin opposite(const Margin& a) { return a.is_defined ? Margin{!a.holds, -a.margin} : kUndefined; }
inline Margin either(const Margin& a, const Margin& b) { return opposite(both(opposite(a), opposite(b))); }
/// The margin of a condition without a comparison: infinite.
inline Margin certain(bool holds) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {holds, holds ? kInfinity : -kInfinity};
}

/// Whether no part of an expression is a signal.
bool is_constant(const Expression& expression);

/// @param expression  a number. @returns NaN where it is undefined.
double number_at(const Expression& expression, const Instant& instant);
/// @param expression  a condition.
Margin margin_at(const Expression& expression, const Instant& instant);

}  // namespace skein

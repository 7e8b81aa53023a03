#include "core/expressions/expression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

using Op = Expression::Op;

Instant at_anchor(const Instant& instant) { return {instant.anchor, instant.anchor, instant.anchor}; }
Instant one_earlier(const Instant& instant) { return {instant.before, instant.before, instant.anchor}; }

/// @param distance  from the value at which the condition changes; positive on the side where the condition holds
Margin compared(bool holds, double distance) { return std::isnan(distance) ? kUndefined : Margin{holds, distance}; }

double quotient(double a, double b) { return b == 0.0 ? std::numeric_limits<double>::quiet_NaN() : a / b; }

/// @param choose  std::min or std::max, whose result may be a number although the other one is undefined (NaN)
double chosen(double a, double b, const auto& choose) { return std::isnan(a) || std::isnan(b) ? a + b : choose(a, b); }

/// The difference of equal infinite numbers is 0 here, not NaN.
double difference(double a, double b) { return a == b ? 0.0 : a - b; }

/// The truth value of a condition, without its distance from changing.
Margin truth(const Margin& margin) { return margin.is_defined ? certain(margin.holds) : kUndefined; }

/// Whether a number is greater at `to` than at `from`, or a condition is false at `from` and true at `to`.
Margin rises_between(const Expression& part, const Instant& from, const Instant& to) {
  if (part.is_condition) return truth(both(opposite(truth(margin_at(part, from))), truth(margin_at(part, to))));
  const double before = number_at(part, from), now = number_at(part, to);
  return std::isnan(before) || std::isnan(now) ? kUndefined : certain(now > before);
}

}  // namespace

bool is_constant(const Expression& expression) {
  return expression.op != Expression::Op::signal && std::ranges::all_of(expression.parts, is_constant);
}

double number_at(const Expression& expression, const Instant& instant) {
  const auto part = [&](std::size_t i) { return number_at(expression.parts[i], instant); };
  switch (expression.op) {
    case Op::number:
      return expression.number;
    case Op::signal:
      return instant.now[expression.signal];
    case Op::negate:
      return -part(0);
    case Op::add:
      return part(0) + part(1);
    case Op::subtract:
      return part(0) - part(1);
    case Op::multiply:
      return part(0) * part(1);
    case Op::divide:
      return quotient(part(0), part(1));
    case Op::least:
      return chosen(part(0), part(1), [](double a, double b) { return std::min(a, b); });
    case Op::greatest:
      return chosen(part(0), part(1), [](double a, double b) { return std::max(a, b); });
    case Op::absolute:
      return std::abs(part(0));
    case Op::gain:
      return difference(part(0), number_at(expression.parts[0], at_anchor(instant)));
    default: {
      const Margin margin = margin_at(expression, instant);
      if (!margin.is_defined) return std::numeric_limits<double>::quiet_NaN();
      return margin.holds ? 1.0 : 0.0;
    }
  }
}

Margin margin_at(const Expression& expression, const Instant& instant) {
  const std::vector<Expression>& parts = expression.parts;
  const auto numbers = [&](const auto& compare) {
    return compare(number_at(parts[0], instant), number_at(parts[1], instant));
  };
  switch (expression.op) {
    case Op::signal:
      return certain(instant.now[expression.signal] >= 0.5);
    case Op::rises:
      return rises_between(parts[0], one_earlier(instant), instant);
    case Op::falls:
      return rises_between(parts[0], instant, one_earlier(instant));
    case Op::less:
      return numbers([](double a, double b) { return compared(a < b, difference(b, a)); });
    case Op::at_most:
      return numbers([](double a, double b) { return compared(a <= b, difference(b, a)); });
    case Op::more:
      return numbers([](double a, double b) { return compared(a > b, difference(a, b)); });
    case Op::at_least:
      return numbers([](double a, double b) { return compared(a >= b, difference(a, b)); });
    case Op::equal:
      return numbers([](double a, double b) { return compared(a == b, -std::abs(difference(a, b))); });
    case Op::unequal:
      return numbers([](double a, double b) { return compared(a != b, std::abs(difference(a, b))); });
    case Op::negation:
      return opposite(margin_at(parts[0], instant));
    case Op::conjunction:
      return both(margin_at(parts[0], instant), margin_at(parts[1], instant));
    case Op::disjunction:
      return either(margin_at(parts[0], instant), margin_at(parts[1], instant));
    default: {
      const double number = number_at(expression, instant);
      return std::isnan(number) ? kUndefined : certain(number != 0.0);
    }
  }
}

}  // namespace skein

#include "core/expression.hpp"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

using Op = Expression::Op;

Instant at_anchor(const Instant& instant) { return {instant.anchor, instant.anchor, instant.anchor}; }
Instant one_earlier(const Instant& instant) { return {instant.before, instant.before, instant.anchor}; }

/// @param distance  above 0 on the side where it holds.
Margin compared(bool holds, double distance) { return std::isnan(distance) ? certain(holds) : Margin{holds, distance}; }

/// Numbers that are equal, infinite ones too, are no way apart.
double difference(double a, double b) { return a == b ? 0.0 : a - b; }

bool rises_at(const Expression& part, const Instant& instant) {
  if (!part.is_condition) return number_at(part, instant) > number_at(part, one_earlier(instant));
  return margin_at(part, instant).holds && !margin_at(part, one_earlier(instant)).holds;
}

bool falls_at(const Expression& part, const Instant& instant) {
  if (!part.is_condition) return number_at(part, instant) < number_at(part, one_earlier(instant));
  return !margin_at(part, instant).holds && margin_at(part, one_earlier(instant)).holds;
}

}  // namespace

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
      return part(0) / part(1);
    case Op::least:
      return std::min(part(0), part(1));
    case Op::greatest:
      return std::max(part(0), part(1));
    case Op::absolute:
      return std::abs(part(0));
    case Op::gain:
      return difference(part(0), number_at(expression.parts[0], at_anchor(instant)));
    default:
      return margin_at(expression, instant).holds ? 1.0 : 0.0;
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
      return certain(rises_at(parts[0], instant));
    case Op::falls:
      return certain(falls_at(parts[0], instant));
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
    default:
      return certain(number_at(expression, instant) != 0.0);
  }
}

}  // namespace skein

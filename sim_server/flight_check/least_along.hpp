// Global minimum of a Lipschitz-continuous function of one variable, with few evaluations.
// Pure; safe from any thread, if `f` is.
#pragma once

#include <algorithm>
#include <vector>

namespace skein::sim {

struct Least {
  double value = 0.0;
  double at = 0.0;  ///< argument at which f has this value
};

/// Piyavskii-Shubert algorithm, depth first: evaluates f where the Lipschitz bound of an interval has its minimum.
/// @param f  on [0, length]; |f(x) - f(y)| <= slope |x - y|.   @param slope  above 0.
/// @param most  values above it are ignored.   @param tolerance  above 0.
/// @returns a value of f within `tolerance` of the minimum, and its argument; {most, 0} when no value below `most` was
///          found: then the minimum is at least `most` - `tolerance`.
Least least_along(const auto& f, double length, double slope, double most, double tolerance) {
  struct Part {
    Least from, to;
  };
  Least best{most, 0.0};
  const auto ask = [&](double at) {
    const Least found{f(at), at};
    if (found.value < best.value) best = found;
    return found;
  };
  const Least begin = ask(0.0);
  if (length <= 0.0) return best;
  std::vector<Part> parts = {{begin, ask(length)}};
  while (!parts.empty()) {
    const auto [from, to] = parts.back();
    parts.pop_back();
    const double least = 0.5 * (from.value + to.value - slope * (to.at - from.at));
    if (least >= best.value - tolerance) continue;
    const double turn = 0.5 * (from.at + to.at) + 0.5 * (from.value - to.value) / slope;
    const Least middle = ask(std::clamp(turn, from.at, to.at));
    if (middle.at <= from.at || middle.at >= to.at) continue;  // as narrow as doubles resolve
    parts.push_back({from, middle});
    parts.push_back({middle, to});
  }
  return best;
}

}  // namespace skein::sim

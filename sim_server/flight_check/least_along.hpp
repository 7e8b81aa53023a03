// The least value of a function that is known to change no faster than some slope: with few questions to it.
// Pure; safe from any thread.
#pragma once

#include <algorithm>
#include <vector>

namespace skein::sim {

struct Least {
  double value = 0.0;
  double at = 0.0;  ///< where
};

/// Piyavskii's and Shubert's search: the next question goes where the value could be least by what is known.
/// @param f  on [0, length]; |f(x) - f(y)| <= slope |x - y|.   @param slope  above 0.
/// @param most  larger values are of no interest.   @param tolerance  above 0.
/// @returns a value of f within `tolerance` of its least one and where it is; {most, 0} when none is below `most`, or
///          none by more than `tolerance` that the search had not come upon.
template <class F>
Least least_along(const F& f, double length, double slope, double most, double tolerance) {
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
    if (middle.at <= from.at || middle.at >= to.at) continue;  // as narrow as numbers are
    parts.push_back({from, middle});
    parts.push_back({middle, to});
  }
  return best;
}

}  // namespace skein::sim

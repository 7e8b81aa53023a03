// Parameters of a strategy with two values of their own accord: ours, or after the paper, and those of `faithful=true`,
// after the public code or what the sources leave out. What is given by its own name stays as it is given.
#pragma once

#include <optional>

namespace skein::agent {

/// A limit of time that no mission reaches.
constexpr double kNeverS = 1e6;

/// Fills in what was not given.
template <class T, class Value>
void fill(std::optional<T>& parameter, bool faithful, const Value& ours, const Value& faithful_value) {
  if (!parameter) parameter = faithful ? faithful_value : ours;
}

}  // namespace skein::agent

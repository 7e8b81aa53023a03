// Parameters of a strategy that have two defaults: one of our choice or from the paper, and one for `faithful=true`,
// which follows the public code or leaves out what the sources do not mention. A given parameter keeps its value.
#pragma once

#include <optional>

namespace skein::agent {

/// A time limit that no mission reaches. Chosen.
constexpr double kNeverS = 1e6;

/// Sets a parameter that was not given to one of its two defaults.
template <class T, class Value>
void fill(std::optional<T>& parameter, bool faithful, const Value& ours, const Value& faithful_value) {
  if (!parameter) parameter = faithful ? faithful_value : ours;
}

}  // namespace skein::agent

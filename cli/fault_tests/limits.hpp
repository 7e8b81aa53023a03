// Limits that a fault test sets for a number: `0` means exactly 0; `{at_least: 3}`, `{at_most: 9}` or both, a range.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>

#include "core/config/config_reader.hpp"
#include "core/text/text.hpp"

namespace skein::cli {

struct Limits {
  std::optional<double> at_least, at_most;

  bool contain(double value) const { return (!at_least || value >= *at_least) && (!at_most || value <= *at_most); }
  /// "at least 3", "0", "from 3 to 9".
  std::string text() const;

  void describe(auto& r) {
    r.field("at_least", at_least);
    r.field("at_most", at_most);
    r.check(at_least || at_most, "at_least", "is missing, and so is at_most: one of them must be there");
    r.check(!at_least || !at_most || *at_least <= *at_most, "at_most", "must not be below at_least");
  }
};

/// Reads `key`, which has either of the two forms; `limits` is left unchanged when the key is absent.
void read_limits(auto& r, const std::string& key, std::optional<Limits>& limits) {
  std::variant<std::string, Limits> given;
  r.field(key, given);
  if (!r.has(key)) return;
  if (const auto* range = std::get_if<Limits>(&given)) {
    limits = *range;
    return;
  }
  const std::optional<double> exact = parse_number(std::get<std::string>(given));
  r.check(exact.has_value(), key, "must be a number, or {at_least: NUMBER, at_most: NUMBER}");
  limits = Limits{exact, exact};
}

/// A map from names to limits. `Names` is a function that returns the names that may be keys.
template <auto Names>
struct LimitsByName {
  std::map<std::string, Limits> limits;

  void describe(auto& r) {
    for (const char* name : Names()) {
      std::optional<Limits> given;
      read_limits(r, name, given);
      if (given) limits.emplace(name, *given);
    }
  }
};

}  // namespace skein::cli

// What became of a property in a run: whether it held, and by how much.  Pure: signals in, verdicts out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "properties/property.hpp"

namespace skein::properties {

/// The signals of one run. They are step functions: a value for each exchange, the first of which is at time 0.
class RunSignals {
 public:
  virtual ~RunSignals() = default;
  /// Values of a signal, one for each exchange. Valid as long as this.
  /// @throws InputError when the run lacks what it takes to know.
  virtual const std::vector<double>& values(const SignalUse& signal) = 0;
  virtual std::size_t exchanges() const = 0;
  virtual double period_s() const = 0;
  /// When the last fault was over: 0 without faults; nullopt when one lasted to the end.
  virtual std::optional<double> healed_s() const = 0;
};

struct Verdict {
  enum class Outcome {
    holds,
    fails,
    vacuous  ///< the run says nothing of it; `reason` tells why
  };

  Outcome outcome = Outcome::vacuous;
  std::string bound = {};  ///< of which binding this is
  double margin = 0.0;     ///< how far from the opposite; infinite where truth has no measure. Of a vacuous one: 0
  Unit unit = {};          ///< of the margin
  double at_s = 0.0;  ///< when it was decided: where an `always` came nearest to failing, an `eventually` to holding
  std::string reason = {};  ///< why it is vacuous, or how it failed, for people
  bool is_unclear = false;  ///< vacuous, since what it compares is undefined (core/expressions/expression.hpp)
};

Verdict evaluate(const Property& property, RunSignals& run);

/// The one that counts of several: those of one property for each of its bindings. The first that fails by most; where
/// none does, one that cannot be judged, since what it compares is undefined; else the one that came nearest to it;
/// where none decided, the first.
Verdict worst_of(const std::vector<Verdict>& verdicts);

/// The margin of the property's condition in each exchange, for drawings.
std::vector<double> margins_over_time(const Property& property, RunSignals& run);

}  // namespace skein::properties

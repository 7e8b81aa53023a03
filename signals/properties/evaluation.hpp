// Evaluates properties in a run: whether a property held, and with what margin.  Pure: signals in, verdicts out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signals/properties/property.hpp"

namespace skein::properties {

/// The signals of one run. They are step functions with one value per exchange; the first exchange is at time 0.
class RunSignals {
 public:
  virtual ~RunSignals() = default;
  /// Values of a signal, one per exchange. The reference is valid as long as this object.
  /// @throws InputError if the run lacks the data for this signal.
  virtual const std::vector<double>& values(const SignalUse& signal) = 0;
  virtual std::size_t exchanges() const = 0;
  virtual double period_s() const = 0;
  /// Time at which the last fault ended [s]: 0 without faults; nullopt if one lasted to the end of the run.
  virtual std::optional<double> healed_s() const = 0;
};

struct Verdict {
  enum class Outcome {
    holds,
    fails,
    vacuous  ///< the run does not decide the property; see `reason`
  };

  Outcome outcome = Outcome::vacuous;
  std::string bound = {};   ///< binding of the property's variables: "u = changi"
  double margin = 0.0;      ///< distance from the opposite outcome, at most 0 if it fails; may be infinite; vacuous: 0
  Unit unit = {};           ///< unit of the margin
  double at_s = 0.0;        ///< time that decided the margin: `always` was nearest to failing, `eventually` to holding
  std::string reason = {};  ///< why it is vacuous, or how it failed; for people
  bool is_unclear = false;  ///< vacuous, because a comparison is undefined (core/expressions/expression.hpp)
};

/// @throws InputError if the run lacks the data for a signal of the property.
Verdict evaluate(const Property& property, RunSignals& run);

/// The verdict that counts for a property with several bindings, in this order of precedence: the failure with the
/// least margin; a verdict that is unclear; the one that holds with the least margin; a vacuous one, then without
/// `bound` if there are several. Of equals, the first. @param verdicts  one per binding; not empty.
Verdict worst_of(const std::vector<Verdict>& verdicts);

/// The margin of the property's condition in each exchange, for plots. @throws InputError as evaluate() does.
std::vector<double> margins_over_time(const Property& property, RunSignals& run);

}  // namespace skein::properties

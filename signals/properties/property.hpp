// A property of a run: a condition over its signals, and when it must hold. Temporal operators and their margins are
// those of signal temporal logic on the run's exchanges (Donze and Maler 2010, see core/expressions/expression.hpp).
// The margin of `always` is the least in its window, that of `eventually` the greatest, that of `finally` the one in
// the last exchange. That of `a until b` is the greatest, over all instants t, of min(b at t, least a before t).
// docs/properties.md explains properties to users; property_parser.hpp reads their texts.
// Pure.   Times: simulated seconds.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/expressions/expression.hpp"
#include "core/expressions/signal_table.hpp"

namespace skein::properties {

/// The part of a run in which a property is evaluated.
struct Window {
  enum class From { start, heal, time };  ///< the run's start; the end of the last fault; `from_s`

  From from = From::start;
  double from_s = 0.0;
  std::optional<double> until_s;   ///< none: to the end of the run
  std::optional<double> within_s;  ///< length, from its beginning or, with `whenever`, from each trigger
};

struct Property {
  enum class Kind { always, never, sometimes, eventually, finally, until };

  std::string name;
  std::string bound;  ///< binding of its variables: "u = changi"; empty: it has none
  Kind kind = Kind::always;
  std::optional<Expression> whenever = {};  ///< trigger: each time it becomes true, the rest must hold from then on
  Expression condition = {};
  Expression goal = {};                   ///< right-hand side of `until`
  std::optional<Expression> unless = {};  ///< once it is true, nothing more is required in this window
  Window window = {};
  std::vector<SignalUse> signals = {};  ///< by slot in the expressions
  std::size_t window_at = 0;            ///< index in its text at which the window begins
};

}  // namespace skein::properties

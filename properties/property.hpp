// A property of a run: a condition over its signals, and when it must hold. Temporal operators and their margins are
// those of signal temporal logic on the run's exchanges (Donze and Maler 2010, see core/expressions/expression.hpp): of
// `always` the least margin in its window, of `eventually` the greatest, of `a until b` the greatest over all instants
// of the lesser of b then and a before.  docs/properties.md is for users; property_parser.hpp reads texts.
// Pure.   Times: simulated seconds.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/expressions/expression.hpp"
#include "core/expressions/signal_table.hpp"

namespace skein::properties {

/// From when to when a property is looked at.
struct Window {
  enum class From { start, heal, time };  ///< the run's start; when the last fault is over; `from_s`

  From from = From::start;
  double from_s = 0.0;
  std::optional<double> until_s;   ///< none: to the end of the run
  std::optional<double> within_s;  ///< so long from its beginning, or from what `whenever` says
};

struct Property {
  enum class Kind { always, never, sometimes, eventually, until };

  std::string name;
  std::string bound;  ///< what its variables stand for: "u = changi"; empty: it has none
  Kind kind = Kind::always;
  std::optional<Expression> whenever = {};  ///< each time that this becomes true, the rest must hold from then on
  Expression condition = {};
  Expression goal = {};                   ///< of `until`
  std::optional<Expression> unless = {};  ///< from where this is true on, nothing is asked until the window's end
  Window window = {};
  std::vector<SignalUse> signals = {};  ///< by slot
  std::size_t window_at = 0;            ///< where its window stands in its text
};

}  // namespace skein::properties

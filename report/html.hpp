// Pieces of HTML and SVG text. Pure; any thread. Numbers are written the same in every locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/text/text.hpp"

namespace skein::report {

/// Text made fit for elements and attributes in quotes: & < > " '. Control characters that XML forbids become '?'.
std::string escaped(std::string_view text);

using skein::fixed;
/// The same, or a dash.
std::string fixed(const std::optional<double>& value, int digits);

/// A coordinate in a drawing: at most one digit behind the point, "3" and not "3.0".
std::string coordinate(double value);

/// At most this many characters, the last of them an ellipsis where something was cut off. UTF-8 stays whole.
std::string shortened(const std::string& text, std::size_t most);

/// A drawing with a caption; `small`, which may be empty, is below it. Only these two are escaped.
std::string figure(const std::string& caption, const std::string& small, const std::string& svg);

/// A range with round ends that holds all it was made for, divided by round ticks.
struct Axis {
  double low = 0.0, high = 1.0, step = 1.0;

  /// @returns 0 at low, 1 at high.
  double share(double value) const { return (value - low) / (high - low); }
  std::vector<double> ticks() const;
  /// A tick's text with as many digits as the step needs.
  std::string label(double tick) const;
};

/// @param about how many steps. The axis begins at 0 where that costs at most half of it; an empty range is widened.
Axis nice_axis(double low, double high, int about = 5);

}  // namespace skein::report

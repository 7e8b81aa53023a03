// Functions that build the HTML and SVG of reports. Pure; any thread. The locale does not affect how they write
// numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/text/text.hpp"

namespace skein::report {

/// The text with & < > " ' escaped, for use in elements and in quoted attributes. Replaces control characters
/// that XML forbids, and bytes that are not UTF-8, by '?'.
std::string escaped(std::string_view text);

using skein::fixed;
/// As skein::fixed(); a dash if there is no value.
std::string fixed(const std::optional<double>& value, int digits);

/// A coordinate in a drawing, with one digit after the point, or none if it is 0: "3.5", "3".
std::string coordinate(double value);

/// A text of at most `most` characters (not bytes) of UTF-8. If the text is longer, cuts off its end, and the last of
/// the `most` characters is an ellipsis.
std::string shortened(const std::string& text, std::size_t most);

/// The beginning, up to <main>, of a page that users open as a file, not from a server, with the styles of drawings and
/// runs. Escapes the title.
/// @param script  the only script that the page may run (policy_of_file())
/// @param classes  CSS classes of the body. @param css  more styles
std::string page_begin(const std::string& title, const std::optional<std::string>& script, const std::string& classes,
                       std::string_view css = {});

/// A <figure>: the caption, below it `small` in smaller print (unless empty), and the drawing `svg`. Escapes `caption`
/// and `small`, but not `svg`.
std::string figure(const std::string& caption, const std::string& small, const std::string& svg);

/// The axis of a plot. Both ends and all ticks are multiples of the step between two ticks.
struct Axis {
  double low = 0.0, high = 1.0, step = 1.0;

  /// Relative position of a value on the axis: 0 at `low`, 1 at `high`.
  double share(double value) const { return (value - low) / (high - low); }
  std::vector<double> ticks() const;
  /// Text of a tick, with as many digits after the point as the step needs.
  std::string label(double tick) const;
};

/// An axis that contains all values from `low` to `high`, with a step of 1, 2 or 5 times a power of ten. It is extended
/// to 0 if that makes the range less than twice as long. If `low` and `high` are equal, the axis also covers values
/// beside them. @param about  approximate number of steps.
Axis nice_axis(double low, double high, int about = 5);

}  // namespace skein::report

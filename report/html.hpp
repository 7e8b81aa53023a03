// Pieces of HTML and SVG text. Pure; any thread. Numbers are written the same in every locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/text/text.hpp"

namespace skein::report {

/// Escapes text for elements and quoted attributes: & < > " '. Control characters that XML forbids become '?'.
std::string escaped(std::string_view text);

using skein::fixed;
/// The same; a dash if there is no value.
std::string fixed(const std::optional<double>& value, int digits);

/// A coordinate in a drawing, with at most one digit after the point: "3", not "3.0".
std::string coordinate(double value);

/// Shortens text to at most `most` characters of UTF-8. If it cuts something off, the last character is an ellipsis.
std::string shortened(const std::string& text, std::size_t most);

/// The beginning of a page that is a file, up to <main>, with the styles of drawings and runs. Escapes the title.
/// @param script  the only script that the page may run (policy_of_file())
/// @param classes  CSS classes of the body
/// @param css  more styles
std::string page_begin(const std::string& title, const std::optional<std::string>& script, const std::string& classes,
                       std::string_view css = {});

/// A <figure> with a caption and, if not empty, a smaller line below the caption. Escapes these two, but not `svg`.
std::string figure(const std::string& caption, const std::string& small, const std::string& svg);

/// An axis with round ends and round ticks.
struct Axis {
  double low = 0.0, high = 1.0, step = 1.0;

  /// Position of a value on the axis: 0 at `low`, 1 at `high`.
  double share(double value) const { return (value - low) / (high - low); }
  std::vector<double> ticks() const;
  /// Text of a tick, with as many digits after the point as the step needs.
  std::string label(double tick) const;
};

/// The axis for values from `low` to `high`. It begins (or ends) at 0 if that makes the range at most twice as long. An
/// empty range is widened. @param about  approximate number of steps.
Axis nice_axis(double low, double high, int about = 5);

}  // namespace skein::report

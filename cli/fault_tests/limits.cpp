#include "cli/fault_tests/limits.hpp"

#include "core/text/text.hpp"

namespace skein::cli {

std::string Limits::text() const {
  if (at_least && at_most && *at_least == *at_most) return number_text(*at_least);
  if (at_least && at_most) return "from " + number_text(*at_least) + " to " + number_text(*at_most);
  return at_least ? "at least " + number_text(*at_least) : "at most " + number_text(*at_most);
}

}  // namespace skein::cli

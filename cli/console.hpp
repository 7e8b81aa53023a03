// The output streams of a command, and whether a user sits at them.
#pragma once

#include <ostream>

namespace skein::cli {

/// `terminal`: `err` is a terminal, whose last line can be rewritten. `keyboard`: and this process gets its input.
struct Console {
  std::ostream& out;  ///< results
  std::ostream& err;  ///< progress, warnings and errors
  bool terminal = false;
  bool keyboard = false;
};

}  // namespace skein::cli

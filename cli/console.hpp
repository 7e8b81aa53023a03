// The output streams of a command, and whether a user sits at them.
#pragma once

#include <ostream>

namespace skein::cli {

struct Console {
  std::ostream& out;      ///< results
  std::ostream& err;      ///< progress, warnings and errors
  bool terminal = false;  ///< `err` is a terminal, whose last line can be rewritten
  bool keyboard = false;  ///< and this process gets the terminal's input
};

}  // namespace skein::cli

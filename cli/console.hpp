// Where a command writes.
#pragma once

#include <ostream>

namespace skein::cli {

/// `terminal`: the second stream can rewrite its last line. `keyboard`: and what is typed comes to us.
struct Console {
  std::ostream& out;  ///< results
  std::ostream& err;  ///< progress and complaints
  bool terminal = false;
  bool keyboard = false;
};

}  // namespace skein::cli

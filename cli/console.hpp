// Where a command writes.
#pragma once

#include <ostream>

namespace skein::cli {

/// `terminal`: the second stream can rewrite its last line.
struct Console {
  std::ostream& out;  ///< results
  std::ostream& err;  ///< progress and complaints
  bool terminal = false;
};

}  // namespace skein::cli

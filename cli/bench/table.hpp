// What `skein bench` prints.
#pragma once

#include <ostream>

#include "cli/run/result.hpp"

namespace skein::cli {

/// @param report  as --json writes it. Parts that were not measured are left out.
void print_bench(std::ostream& out, const Json& report);

}  // namespace skein::cli

// Prints the report of `skein bench`.
#pragma once

#include <ostream>

#include "results/result.hpp"

namespace skein::cli {

/// @param report  as --json writes it. The table leaves out parts that bench has not measured.
void print_bench(std::ostream& out, const Json& report);

}  // namespace skein::cli

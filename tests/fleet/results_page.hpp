// Checks that docs/results.md and the files of a run have the same columns.
#pragma once

#include <filesystem>

namespace skein::test {

/// Expects every CSV file in a run's folder to have the columns that the page lists, in the page's order.
void expect_documented_columns(const std::filesystem::path& dir);

}  // namespace skein::test

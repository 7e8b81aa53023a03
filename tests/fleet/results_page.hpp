// docs/results.md and the files of a run have the same columns.
#pragma once

#include <filesystem>

namespace skein::test {

/// Every CSV file of a run's folder has the columns that the page lists, in the page's order.
void expect_documented_columns(const std::filesystem::path& dir);

}  // namespace skein::test

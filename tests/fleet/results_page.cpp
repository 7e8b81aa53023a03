#include "results_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// The columns that the page lists below "### FILE".
Names documented(const std::string& file) {
  std::ifstream page(source_path("docs/results.md"));
  Names columns;
  bool here = false, in_table = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) here = line == "### " + file;
    if (line.starts_with("| column ") && here) in_table = true;
    in_table = in_table && line.starts_with("|");  // other tables of the section explain values
    if (!in_table || !line.starts_with("| `")) continue;
    const std::string cell = line.substr(0, line.find(" |", 2));
    for (std::size_t at = cell.find('`'); at != std::string::npos; at = cell.find('`', at)) {
      const std::size_t end = cell.find('`', at + 1);
      columns.push_back(cell.substr(at + 1, end - at - 1));
      at = end + 1;
    }
  }
  return columns;
}

/// The columns in a file's header; a column that each UAV has is listed once, as "<uav>".
Names header(const fs::path& file, const Names& uavs) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  Names columns;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    std::string column = line.substr(at, end - at);
    for (const std::string& uav : uavs) {
      if (column.starts_with(uav + ".")) column.replace(0, uav.size(), "<uav>");
    }
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
    at = end + 1;
  }
  return columns;
}

}  // namespace

void expect_documented_columns(const fs::path& dir) {
  Names uavs;
  std::ifstream result_file(dir / "result.json");
  const auto result = nlohmann::json::parse(result_file);
  for (const auto& uav : result["uavs"]) uavs.push_back(uav["name"]);
  for (const auto& entry : fs::directory_iterator(dir)) {
    if (entry.path().extension() != ".csv") continue;
    std::string name = entry.path().filename();
    for (const std::string& uav : uavs) {
      if (name == "hand-" + uav + ".csv") name = "hand-<uav>.csv";
    }
    // On a full disk a table may be empty; then the result has a warning that names it.
    const bool told = result["warnings"].dump().find(name) != std::string::npos;
    if (told && fs::file_size(entry.path()) == 0) continue;
    EXPECT_EQ(header(entry.path(), uavs), documented(name)) << name << " has other columns than docs/results.md says";
  }
}

}  // namespace skein::test

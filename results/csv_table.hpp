// A CSV file with a header line and plain cells, row by row.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace skein::results {

class CsvTable {
 public:
  /// A file that is missing has no rows.
  explicit CsvTable(const std::filesystem::path& file);

  /// @returns false at the end.
  bool next();

  /// Of this row, by the column's name. @throws std::runtime_error naming file and line when there is no such cell.
  const std::string& text(const std::string& column) const;
  /// @throws also when the cell is no number.
  double number(const std::string& column) const;
  std::optional<double> number_if_any(const std::string& column) const;
  std::uint64_t count(const std::string& column) const { return static_cast<std::uint64_t>(number(column)); }

 private:
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path file_;
  std::ifstream in_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::string> cells_;
  int line_ = 1;
};

}  // namespace skein::results

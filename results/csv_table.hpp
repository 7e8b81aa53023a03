// Reads a CSV file with a header line and unquoted cells, row by row.   Threads: one for each object.
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
  /// A missing file counts as a table without rows. @throws InputError if it is not a regular file.
  explicit CsvTable(const std::filesystem::path& file);

  /// Goes to the next row. @returns false at the end.
  bool next();

  /// Whether the table has a column of this name.
  bool has(const std::string& column) const { return columns_.contains(column); }
  /// The cell of this row in a column. @throws std::runtime_error, with file and line, if there is no such cell.
  const std::string& text(const std::string& column) const;
  /// @throws std::runtime_error also if the cell is not a finite number.
  double number(const std::string& column) const;
  /// @throws std::runtime_error also if the cell is not a whole number from 0 to 2^64 - 1.
  std::uint64_t count(const std::string& column) const;
  /// nullopt: the cell is empty.
  std::optional<std::uint64_t> count_if_any(const std::string& column) const;

  /// @throws std::runtime_error: the file, the line of this row, and `what`, which says what is wrong.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::string> cells_;
  int line_ = 1;
};

}  // namespace skein::results

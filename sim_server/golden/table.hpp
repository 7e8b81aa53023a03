// A CSV table of reference vectors, and its comparison with computed values.
// Frames and units of the values are those of the code that computes them.   Threads: one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/types.hpp"
#include "sim_server/golden/check.hpp"

namespace skein::sim {

/// A table in memory: a header row, then rows with the same number of cells; columns may be in any order. Ignores empty
/// lines, lines that begin with #, blanks and quotes around a cell, carriage returns and a UTF-8 byte order mark.
class GoldenTable {
 public:
  /// @throws InputError if the file cannot be read, has no rows, names a column twice, or a row's length differs from
  ///         the header's.
  explicit GoldenTable(const std::filesystem::path& file);

  std::size_t rows() const { return rows_.size(); }
  bool has(const std::string& column) const { return columns_.count(column) > 0; }
  /// Line number of a row in the file, counted from 1.
  std::size_t line(std::size_t row) const { return lines_[row]; }
  /// "file:line" of a row, for messages.
  std::string place(std::size_t row) const { return file_.string() + ":" + std::to_string(line(row)); }

  /// @throws InputError if the table has no such column.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// nullopt where the cell is empty. @throws InputError if it holds no number.
  std::optional<double> cell(std::size_t row, const std::string& column) const;
  /// @throws InputError if the cell is empty or holds no number.
  double number(std::size_t row, const std::string& column) const;
  /// Columns prefix + x, y, z.
  Vector3d vector(std::size_t row, const std::string& prefix) const;
  /// Columns q_w, q_x, q_y, q_z.
  Quaterniond quaternion(std::size_t row) const;

 private:
  std::filesystem::path file_;
  std::unordered_map<std::string, std::size_t> columns_;  // never iterated: its order is arbitrary
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> lines_;  ///< line number of each row in the file
};

struct Tolerance {
  double absolute = 0.0;
  double relative = 0.0;  ///< of the expected value
};

/// Compares computed values with a table, one row after the other.
class GoldenComparison {
 public:
  GoldenComparison(const GoldenTable& table, std::string name);

  /// The comparisons that follow are with this row.
  void begin_row(std::size_t row);
  void number(const std::string& column, const std::optional<double>& computed, const Tolerance& tolerance);
  void vector(const std::string& prefix, const Vector3d& computed, const Tolerance& tolerance);
  /// Compares angles modulo 2 pi [rad].
  void angle(const std::string& column, double computed, const Tolerance& tolerance);
  /// The cell must hold a boolean: 0, 1, true or false.
  void flag(const std::string& column, bool computed);
  void count(const std::string& column, int computed);
  void text(const std::string& column, const std::string& computed);

  const GoldenReport& report() const { return report_; }

 private:
  void note_difference(const std::string& column, double share);
  void fail(const std::string& column, const std::string& computed);

  const GoldenTable& table_;
  GoldenReport report_;
  std::size_t row_ = 0;
  bool row_failed_ = false;
};

}  // namespace skein::sim

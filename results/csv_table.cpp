#include "results/csv_table.hpp"

#include <stdexcept>

#include "core/files/file_bytes.hpp"
#include "core/text/text.hpp"
#include "core/text/whole_number.hpp"

namespace skein::results {

CsvTable::CsvTable(const std::filesystem::path& file) : file_(file), in_(open_text(file)) {
  std::string line;
  if (!next_line(in_, line, file_)) return;
  for (const std::string& name : split(line)) columns_.emplace(name, columns_.size());
}

bool CsvTable::next() {
  std::string line;
  if (!next_line(in_, line, file_)) return false;
  ++line_;
  cells_ = split(line);
  return true;
}

const std::string& CsvTable::text(const std::string& column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end() || found->second >= cells_.size()) fail("has no column '" + column + "'");
  return cells_[found->second];
}

double CsvTable::number(const std::string& column) const {
  const std::string& cell = text(column);
  const auto value = parse_number(cell);
  if (!value) fail("column '" + column + "': '" + cell + "' is not a number");
  return *value;
}

std::uint64_t CsvTable::count(const std::string& column) const {
  const std::string& cell = text(column);
  const auto value = parse_whole(cell);
  if (!value) fail("column '" + column + "': '" + cell + "' is not a whole number of at least 0");
  return *value;
}

std::optional<std::uint64_t> CsvTable::count_if_any(const std::string& column) const {
  return text(column).empty() ? std::nullopt : std::optional(count(column));
}

void CsvTable::fail(const std::string& what) const {
  throw std::runtime_error(file_.string() + ":" + std::to_string(line_) + ": " + what);
}

}  // namespace skein::results

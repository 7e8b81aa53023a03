#include "sim_server/golden_table.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/euler.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kMaxMessages = 10;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t end; (end = line.find(',', begin)) != std::string::npos; begin = end + 1) {
    cells.push_back(line.substr(begin, end - begin));
  }
  cells.push_back(line.substr(begin));
  return cells;
}

void drop_carriage_return(std::string& line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
}

std::string to_text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

}  // namespace

GoldenTable::GoldenTable(const std::filesystem::path& file) : file_(file) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) {
    throw InputError(file.string() + ": cannot be read; a CSV table with a header row is expected");
  }
  drop_carriage_return(line);
  const auto header = split(line);
  for (std::size_t i = 0; i < header.size(); ++i) columns_.emplace(header[i], i);
  while (std::getline(in, line)) {
    drop_carriage_return(line);
    auto cells = split(line);
    if (cells.size() != header.size()) {
      throw InputError(place(rows_.size()) + ": " + std::to_string(cells.size()) + " cells, the header has " +
                       std::to_string(header.size()));
    }
    rows_.push_back(std::move(cells));
  }
}

const std::string& GoldenTable::text(std::size_t row, const std::string& column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end()) throw InputError(file_.string() + ":1: column '" + column + "' is missing");
  return rows_[row][found->second];
}

std::optional<double> GoldenTable::cell(std::size_t row, const std::string& column) const {
  const std::string& content = text(row, column);
  if (content.empty()) return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(content.data(), content.data() + content.size(), value);
  if (error != std::errc{} || end != content.data() + content.size()) {
    throw InputError(place(row) + ": column '" + column + "': '" + content + "' is not a number");
  }
  return value;
}

double GoldenTable::number(std::size_t row, const std::string& column) const {
  const auto value = cell(row, column);
  if (!value) {
    throw InputError(place(row) + ": column '" + column + "' needs a number");
  }
  return *value;
}

Vector3d GoldenTable::vector(std::size_t row, const std::string& prefix) const {
  return {number(row, prefix + "x"), number(row, prefix + "y"), number(row, prefix + "z")};
}

Quaterniond GoldenTable::quaternion(std::size_t row) const {
  return {number(row, "q_w"), number(row, "q_x"), number(row, "q_y"), number(row, "q_z")};
}

GoldenComparison::GoldenComparison(const GoldenTable& table, std::string name) : table_(table) {
  report_.table = std::move(name);
}

void GoldenComparison::begin_row(std::size_t row) {
  row_ = row;
  row_failed_ = false;
  ++report_.rows;
}

void GoldenComparison::number(const std::string& column, const std::optional<double>& computed,
                              const Tolerance& tolerance) {
  const auto expected = table_.cell(row_, column);
  if (!expected || !computed) {
    if (expected.has_value() != computed.has_value()) fail(column, computed ? to_text(*computed) : "nothing");
    return;
  }
  const double allowed = tolerance.absolute + tolerance.relative * std::abs(*expected);
  const double difference = std::abs(*computed - *expected);
  // An infinite value, or the exact one, differs by nothing even where the tolerance is not a number.
  const double share = *computed == *expected ? 0.0 : difference / allowed;
  note_difference(column, share);
  if (!(share <= 1.0)) fail(column, to_text(*computed));
}

void GoldenComparison::vector(const std::string& prefix, const Vector3d& computed, const Tolerance& tolerance) {
  number(prefix + "x", computed.x(), tolerance);
  number(prefix + "y", computed.y(), tolerance);
  number(prefix + "z", computed.z(), tolerance);
}

void GoldenComparison::angle(const std::string& column, double computed, const Tolerance& tolerance) {
  const double expected = table_.number(row_, column);
  number(column, expected + wrap_angle(computed - expected), tolerance);
}

void GoldenComparison::flag(const std::string& column, bool computed) { text(column, computed ? "1" : "0"); }

void GoldenComparison::text(const std::string& column, const std::string& computed) {
  if (table_.text(row_, column) != computed) fail(column, computed);
}

void GoldenComparison::note_difference(const std::string& column, double share) {
  if (share > report_.worst) {
    report_.worst = share;
    report_.worst_column = column;
  }
}

void GoldenComparison::fail(const std::string& column, const std::string& computed) {
  if (!row_failed_) ++report_.failures;
  row_failed_ = true;
  if (report_.messages.size() >= kMaxMessages) return;
  const std::string& expected = table_.text(row_, column);
  report_.messages.push_back("line " + std::to_string(GoldenTable::line(row_)) + ", " + column + ": expected " +
                             (expected.empty() ? "nothing" : expected) + ", computed " + computed);
}

}  // namespace skein::sim

#include "sim_server/golden/table.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/files/file_bytes.hpp"
#include "core/math/euler.hpp"
#include "core/text/text.hpp"

namespace skein::sim {
namespace {

constexpr std::size_t kMaxMessages = 10;

/// The cell without surrounding blanks, and without a pair of quotes.
std::string trimmed(const std::string& cell) {
  constexpr const char* kBlanks = " \t\r";
  const std::size_t begin = cell.find_first_not_of(kBlanks);
  if (begin == std::string::npos) return {};
  std::string text = cell.substr(begin, cell.find_last_not_of(kBlanks) + 1 - begin);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells = split(line);
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

/// Whether a line is empty or a comment: such lines are not rows.
bool says_nothing(const std::string& line) {
  const std::string text = trimmed(line);
  return text.empty() || text.front() == '#';
}

/// Parses numbers as spreadsheets and scripts write them: also "+1", "nan", "-inf", and values that underflow to 0.
std::optional<double> parsed(const std::string& text) {
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char* const end = text.data() + text.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  return error == std::errc::result_out_of_range ? std::strtod(begin, nullptr) : value;
}

/// Parses true, false, 1 and 0 in several spellings; nullopt for anything else.
std::optional<bool> as_flag(const std::string& text) {
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  const auto number = parsed(text);
  if (number == 0.0 || number == 1.0) return *number == 1.0;
  return std::nullopt;
}

}  // namespace

GoldenTable::GoldenTable(const std::filesystem::path& file) : file_(file) {
  std::ifstream in = open_text(file);
  if (!in) throw InputError(file.string() + ": cannot be read; a CSV table with a header row is expected");
  std::size_t width = 0, number = 0;
  for (std::string line; next_line(in, line, file);) {
    if (++number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // UTF-8 byte order mark
    if (says_nothing(line)) continue;
    auto cells = cells_of(line);
    const std::string here = file.string() + ":" + std::to_string(number);
    if (width == 0) {
      width = cells.size();
      for (std::size_t i = 0; i < width; ++i) {
        if (!columns_.emplace(cells[i], i).second) throw InputError(here + ": column '" + cells[i] + "' comes twice");
      }
      continue;
    }
    if (cells.size() != width) {
      throw InputError(here + ": " + std::to_string(cells.size()) + " cells, the header has " + std::to_string(width));
    }
    rows_.push_back(std::move(cells));
    lines_.push_back(number);
  }
  if (rows_.empty()) throw InputError(file.string() + ": has no rows; a header row and at least one more are expected");
}

const std::string& GoldenTable::text(std::size_t row, const std::string& column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end()) throw InputError(file_.string() + ":1: column '" + column + "' is missing");
  return rows_[row][found->second];
}

std::optional<double> GoldenTable::cell(std::size_t row, const std::string& column) const {
  const std::string& content = text(row, column);
  if (content.empty()) return std::nullopt;
  const auto value = parsed(content);
  if (!value) throw InputError(place(row) + ": column '" + column + "': '" + content + "' is not a number");
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
    if (expected.has_value() != computed.has_value()) fail(column, computed ? significant(*computed, 17) : "nothing");
    return;
  }
  const double allowed = tolerance.absolute + tolerance.relative * std::abs(*expected);
  const double difference = std::abs(*computed - *expected);
  // Equal values, infinite ones included, have no difference, even if the tolerance is not a number.
  const bool same = *computed == *expected || (std::isnan(*computed) && std::isnan(*expected));
  const double share = same ? 0.0 : difference / allowed;
  note_difference(column, share);
  if (!(share <= 1.0)) fail(column, significant(*computed, 17));
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

void GoldenComparison::flag(const std::string& column, bool computed) {
  if (as_flag(table_.text(row_, column)) != computed) fail(column, computed ? "1" : "0");
}

void GoldenComparison::count(const std::string& column, int computed) {
  if (table_.cell(row_, column) != computed) fail(column, std::to_string(computed));
}

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
  report_.messages.push_back("line " + std::to_string(table_.line(row_)) + ", " + column + ": expected " +
                             (expected.empty() ? "nothing" : expected) + ", computed " + computed);
}

}  // namespace skein::sim

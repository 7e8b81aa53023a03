#include "cli/run_record.hpp"

#include <fstream>
#include <map>
#include <stdexcept>

namespace skein::cli {
namespace {

/// A CSV file with a header line; cells by the column's name.
class Table {
 public:
  explicit Table(const std::filesystem::path& file) : file_(file), in_(file) {
    std::string line;
    if (!std::getline(in_, line)) return;
    for (const std::string& name : split(line)) columns_.emplace(name, columns_.size());
  }

  bool next() {
    std::string line;
    if (!std::getline(in_, line)) return false;
    ++line_;
    cells_ = split(line);
    return true;
  }

  const std::string& text(const std::string& column) const {
    const auto found = columns_.find(column);
    if (found == columns_.end() || found->second >= cells_.size()) fail("has no column '" + column + "'");
    return cells_[found->second];
  }

  double number(const std::string& column) const {
    const std::string& cell = text(column);
    try {
      return std::stod(cell);
    } catch (const std::exception&) {
      fail("column '" + column + "': '" + cell + "' is no number");
    }
  }

  std::optional<double> number_if_any(const std::string& column) const {
    return text(column).empty() ? std::nullopt : std::optional(number(column));
  }

  std::uint64_t count(const std::string& column) const { return static_cast<std::uint64_t>(number(column)); }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(file_.string() + ":" + std::to_string(line_) + ": " + what);
  }

  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
    return cells;
  }

  std::filesystem::path file_;
  std::ifstream in_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::string> cells_;
  int line_ = 1;
};

}  // namespace

RunRecord read_run(const std::filesystem::path& dir) {
  RunRecord record;
  record.dir = dir;
  record.result = read_json(dir / "result.json");
  if (!record.result.is_object()) throw std::runtime_error((dir / "result.json").string() + ": is missing or damaged");
  for (Table table(dir / "captures.csv"); table.next();) {
    record.captures.push_back({table.text("uav"), table.count("capture"), table.number("time_s"),
                               static_cast<int>(table.number("point")), table.number("q"),
                               table.number_if_any("delivered_at_s"), table.text("reason")});
  }
  for (Table table(dir / "events.csv"); table.next();) {
    record.events.push_back({table.count("step"), table.text("event"), table.text("subject"), table.text("object")});
  }
  for (Table table(dir / "capture_messages.csv"); table.next();) {
    MessageRow row{table.count("step"), table.text("uav"), std::nullopt};
    if (const auto arrives = table.number_if_any("arrives")) row.arrives = static_cast<std::uint64_t>(*arrives);
    record.messages.push_back(std::move(row));
  }
  return record;
}

}  // namespace skein::cli

#include "results/diff.hpp"

#include <algorithm>
#include <fstream>

#include "core/files/file_bytes.hpp"
#include "core/scenario/scenario.hpp"
#include "core/text/text.hpp"
#include "results/result.hpp"
#include "results/run_folder.hpp"

namespace skein::results {
namespace {

/// Reads digests.csv row by row.
class DigestFile {
 public:
  explicit DigestFile(const std::filesystem::path& run) : file_(run / run_folder::kDigests), in_(opened(run)) {
    std::string line;
    next_line(in_, line, file_);
    columns_ = split(line);
    if (columns_.size() < 2 || columns_[0] != "k" || columns_[1] != "digest") {
      throw InputError(file_.string() + ":1: must begin with the columns k,digest");
    }
  }

  const std::vector<std::string>& columns() const { return columns_; }

  /// @returns the next row, or nullopt at the end. A last line cut short by an aborted run counts as the end.
  std::optional<std::vector<std::string>> next() {
    std::string line;
    if (!next_line(in_, line, file_)) return std::nullopt;
    ++line_;
    std::vector<std::string> cells = split(line);
    if (in_.eof()) return std::nullopt;  // the line has no end
    if (cells.size() == columns_.size()) return cells;
    throw InputError(file_.string() + ":" + std::to_string(line_) + ": has " + std::to_string(cells.size()) +
                     " columns, must have " + std::to_string(columns_.size()));
  }

  std::int64_t step_of(const std::vector<std::string>& row) const {
    try {
      return std::stoll(row[0]);
    } catch (const std::exception&) {
      throw InputError(file_.string() + ":" + std::to_string(line_) + ": '" + row[0] + "' is not a step number");
    }
  }

 private:
  static std::ifstream opened(const std::filesystem::path& run) {
    if (!run_folder::has_file(run, run_folder::kDigests)) {
      throw InputError(run.string() + ": no digests.csv there; give a folder that `skein run` wrote");
    }
    std::ifstream in = open_text(run / run_folder::kDigests);
    if (!in) throw InputError((run / run_folder::kDigests).string() + ": cannot be read");
    return in;
  }

  std::filesystem::path file_;
  std::ifstream in_;
  std::vector<std::string> columns_;
  int line_ = 1;
};

/// The exchange period in the run's result [s]; the default if there is no result, because the launcher was killed.
double exchange_period_s(const std::filesystem::path& run) {
  return value_or(read_json(run / run_folder::kResult), "exchange_period_s", Scenario{}.exchange_period_s);
}

/// Turns "jurong.position" into "jurong position": the entity, then the field.
std::string readable(std::string column) {
  const std::size_t dot = column.rfind('.');
  if (dot != std::string::npos) column[dot] = ' ';
  return column;
}

std::vector<std::string> differing_columns(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::string> fields;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const std::string& column : *one) {
      if (std::find(other->begin(), other->end(), column) == other->end()) {
        fields.push_back(readable(column) + " (only in " + (one == &a ? "the first run)" : "the second run)"));
      }
    }
  }
  if (fields.empty()) fields.push_back("order of the columns");
  return fields;
}

std::vector<std::string> differing_fields(const std::vector<std::string>& columns, const std::vector<std::string>& a,
                                          const std::vector<std::string>& b) {
  std::vector<std::string> fields;
  for (std::size_t i = 2; i < columns.size(); ++i) {
    if (a[i] != b[i]) fields.push_back(readable(columns[i]));
  }
  // The running digest covers fields that have no column of their own.
  if (fields.empty()) fields.push_back("digest");
  return fields;
}

}  // namespace

std::optional<RunDifference> first_difference(const std::filesystem::path& run_a, const std::filesystem::path& run_b) {
  DigestFile a(run_a), b(run_b);
  if (a.columns() != b.columns()) return RunDifference{0, 0.0, differing_columns(a.columns(), b.columns())};
  const double period_s = exchange_period_s(run_a);
  for (;;) {
    const auto row_a = a.next(), row_b = b.next();
    if (!row_a && !row_b) return std::nullopt;
    const std::int64_t step = row_a ? a.step_of(*row_a) : b.step_of(*row_b);
    const double time_s = static_cast<double>(step) * period_s;
    if (!row_a || !row_b) {
      return RunDifference{
          step, time_s, {std::string("end: the ") + (row_a ? "second" : "first") + " run stops before"}};
    }
    if (*row_a != *row_b) {
      if ((*row_a)[0] != (*row_b)[0]) return RunDifference{step, time_s, {"k"}};
      return RunDifference{step, time_s, differing_fields(a.columns(), *row_a, *row_b)};
    }
  }
}

}  // namespace skein::results

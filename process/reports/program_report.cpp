#include "process/reports/program_report.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>

#include "process/files/atomic_file.hpp"
#include "process/status/status_lines.hpp"

namespace skein {

void hand_in_report(Json report, const std::filesystem::path& file, StatusPipe& status) {
  const std::string trouble = write_if_possible(file, json_text(with_checksum(report), 2) + "\n");
  if (!trouble.empty()) {
    if (!status.is_open()) throw std::runtime_error(trouble);
    spdlog::warn("{}", trouble);
    report["unwritten"].push_back(trouble);
  }
  status.send_surely(status::line_json(status::Report{std::move(report)}));
}

void add_new(const std::vector<std::string>& more, std::vector<std::string>& texts) {
  for (const std::string& text : more) {
    if (std::ranges::find(texts, text) == texts.end()) texts.push_back(text);
  }
}

void withdraw_report(const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
}

}  // namespace skein

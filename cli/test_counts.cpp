#include "cli/test_counts.hpp"

#include <algorithm>
#include <functional>
#include <pugixml.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/text/text.hpp"
#include "results/result.hpp"

namespace skein::cli {
namespace {

/// Counts the tests in a GoogleTest program's report.
TestCounts count_cases(const Json& report) {
  TestCounts counts;
  for (const Json& suite : value_or(report, "testsuites", Json::array())) {
    for (const Json& test : value_or(suite, "testsuite", Json::array())) {
      const Json result = value_or(test, "result", "");
      if (result == "SUPPRESSED") continue;  // DISABLED_
      if (!value_or(test, "failures", Json::array()).empty()) {
        ++counts.failed;
      } else {
        ++(result == "SKIPPED" ? counts.skipped : counts.passed);
      }
    }
  }
  return counts;
}

pugi::xml_document read_junit(const std::filesystem::path& junit) {
  pugi::xml_document document;
  if (const pugi::xml_parse_result read = document.load_file(junit.c_str()); !read) {
    throw std::runtime_error(junit.string() + ": ctest wrote no valid report: " + read.description());
  }
  return document;
}

}  // namespace

TestCounts count_tests(const std::filesystem::path& junit, const std::filesystem::path& reports) {
  const pugi::xml_document document = read_junit(junit);
  TestCounts total;
  for (const pugi::xml_node& entry : document.child("testsuite").children("testcase")) {
    const std::string name = entry.attribute("name").value(), status = entry.attribute("status").value();
    const std::string_view why = entry.child("skipped").attribute("message").value();
    const bool skipped = status == "disabled" || why.starts_with("SKIP_");
    const bool failed = !skipped && status != "run";  // also a program that ctest could not start
    const Json report = read_json(reports / (name + ".json"));
    if (report.is_null()) {  // no GoogleTest program, or one that crashed or timed out
      ++(failed ? total.failed : skipped ? total.skipped : total.passed);
      continue;
    }
    TestCounts counts = count_cases(report);
    if (failed && counts.failed == 0) counts.failed = 1;  // all cases passed, but the program then failed
    total.passed += counts.passed;
    total.failed += counts.failed;
    total.skipped += counts.skipped;
  }
  return total;
}

std::string parts_table(const std::filesystem::path& junit, std::size_t count) {
  const pugi::xml_document document = read_junit(junit);
  std::vector<std::pair<double, std::string>> parts;
  double total_s = 0.0;
  for (const pugi::xml_node& entry : document.child("testsuite").children("testcase")) {
    parts.emplace_back(entry.attribute("time").as_double(), entry.attribute("name").value());
    total_s += parts.back().first;
  }
  if (parts.empty()) return "";
  count = std::min(count, parts.size());
  std::ranges::partial_sort(parts, parts.begin() + static_cast<std::ptrdiff_t>(count), std::greater());
  std::string table = "the slowest " + std::to_string(count) + " of " + std::to_string(parts.size()) +
                      " parts, which took " + fixed(total_s, 0) + " s together:\n";
  for (std::size_t i = 0; i < count; ++i) {
    const std::string seconds = fixed(parts[i].first, 1);
    table += std::string(seconds.size() < 9 ? 9 - seconds.size() : 0, ' ') + seconds + " s  " + parts[i].second + "\n";
  }
  return table;
}

std::string summary_line(const TestCounts& counts) {
  std::string line = std::to_string(counts.passed) + " passed, " + std::to_string(counts.failed) + " failed";
  if (counts.skipped > 0) line += ", " + std::to_string(counts.skipped) + " skipped";
  return line;
}

}  // namespace skein::cli

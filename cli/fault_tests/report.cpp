#include "cli/fault_tests/report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "cli/study/html.hpp"

namespace skein::cli {
namespace {

std::string lines_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

std::string case_xml(const std::string& suite, const FaultVerdict& verdict) {
  std::string xml = fmt::format("    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" time=\"{:.3f}\">\n",
                                escaped(suite), escaped(verdict.name), escaped(verdict.file.string()), verdict.wall_s);
  if (!verdict.flown) xml += "      <skipped message=\"not flown\"/>\n";
  if (!verdict.broken.empty()) {
    xml += fmt::format("      <failure message=\"{}\">{}results: {}</failure>\n", escaped(verdict.broken.front()),
                       escaped(lines_of(verdict.broken)), escaped(verdict.results.string()));
  }
  if (!verdict.held.empty()) xml += "      <system-out>" + escaped(lines_of(verdict.held)) + "</system-out>\n";
  return xml + "    </testcase>\n";
}

}  // namespace

void print_verdict(std::ostream& out, const FaultVerdict& verdict, bool verbose) {
  std::string text = (verdict.passed() ? "PASS " : "FAIL ") + verdict.name + "\n";
  for (const std::string& sentence : verdict.broken) text += "     " + sentence + "\n";
  if (verbose) {
    for (const std::string& sentence : verdict.held) text += "     holds: " + sentence + "\n";
  }
  if (!verdict.passed()) text += "     results: " + verdict.results.string() + "\n";
  out << text << std::flush;
}

std::string junit_xml(const std::string& suite, const std::vector<FaultVerdict>& verdicts) {
  const auto count = [&](const auto& is) { return std::count_if(verdicts.begin(), verdicts.end(), is); };
  double wall_s = 0.0;
  for (const FaultVerdict& verdict : verdicts) wall_s += verdict.wall_s;
  const std::string counts =
      fmt::format("name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"{:.3f}\"",
                  escaped(suite), verdicts.size(), count([](const auto& v) { return v.flown && !v.broken.empty(); }),
                  count([](const auto& v) { return !v.flown; }), wall_s);
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts + ">\n  <testsuite " + counts + ">\n";
  for (const FaultVerdict& verdict : verdicts) xml += case_xml(suite, verdict);
  return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace skein::cli

#include "cli/fault_tests/report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/text/text.hpp"
#include "core/text/xml_text.hpp"

namespace skein::cli {
namespace {

std::string lines_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

std::string seconds_text(double time_s) { return fmt::format("{:.3f}", time_s); }

void add_attribute(pugi::xml_node element, const char* name, const std::string& text) {
  element.append_attribute(name) = printable(text).c_str();
}

void add_case(pugi::xml_node suite, const std::string& suite_name, const FaultVerdict& verdict) {
  pugi::xml_node test = suite.append_child("testcase");
  add_attribute(test, "classname", suite_name);
  add_attribute(test, "name", verdict.name);
  add_attribute(test, "file", verdict.file.string());
  add_attribute(test, "time", seconds_text(verdict.wall_s));
  if (!verdict.flown) add_attribute(test.append_child("skipped"), "message", "not flown");
  if (!verdict.broken.empty()) {
    pugi::xml_node failure = test.append_child("failure");
    add_attribute(failure, "message", verdict.broken.front());
    failure.text() = printable(lines_of(verdict.broken) + "results: " + verdict.results.string()).c_str();
  }
  const std::string seen = lines_of(verdict.held) + lines_of(verdict.vacuous);
  if (!seen.empty()) add_element(test, "system-out", printable(seen));
}

}  // namespace

void print_verdict(std::ostream& out, const FaultVerdict& verdict, bool verbose) {
  std::string text = (verdict.passed() ? "PASS " : "FAIL ") + verdict.name + "\n";
  for (const std::string& sentence : verdict.broken) text += "     " + sentence + "\n";
  for (const std::string& sentence : verdict.vacuous) text += "     " + sentence + "\n";
  if (verbose) {
    for (const std::string& sentence : verdict.held) text += "     holds: " + sentence + "\n";
  }
  if (!verdict.passed()) text += "     results: " + verdict.results.string() + "\n";
  out << text << std::flush;
}

std::string junit_xml(const std::string& suite, const std::vector<FaultVerdict>& verdicts) {
  const auto count = [&](const auto& is) {
    return std::to_string(std::count_if(verdicts.begin(), verdicts.end(), is));
  };
  double wall_s = 0.0;
  for (const FaultVerdict& verdict : verdicts) wall_s += verdict.wall_s;
  pugi::xml_document document;
  pugi::xml_node suites = document.append_child("testsuites"), only = suites.append_child("testsuite");
  for (pugi::xml_node element : {suites, only}) {
    add_attribute(element, "name", suite);
    add_attribute(element, "tests", std::to_string(verdicts.size()));
    add_attribute(element, "failures", count([](const auto& v) { return v.flown && !v.broken.empty(); }));
    add_attribute(element, "errors", "0");
    add_attribute(element, "skipped", count([](const auto& v) { return !v.flown; }));
    add_attribute(element, "time", seconds_text(wall_s));
  }
  for (const FaultVerdict& verdict : verdicts) add_case(only, suite, verdict);
  return xml_file(document);
}

}  // namespace skein::cli

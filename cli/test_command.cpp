#include "cli/test_command.hpp"

#include <pugixml.hpp>
#include <stdexcept>
#include <string_view>

#include "cli/fault_test_command.hpp"
#include "cli/run/environment.hpp"
#include "cli/run/fleet_plan.hpp"
#include "cli/run/preflight.hpp"
#include "cli/run/result.hpp"

namespace skein::cli {
namespace {

/// Counts of a GoogleTest program's own report.
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

}  // namespace

TestCounts count_tests(const std::filesystem::path& junit, const std::filesystem::path& reports) {
  pugi::xml_document document;
  if (const pugi::xml_parse_result read = document.load_file(junit.c_str()); !read) {
    throw std::runtime_error(junit.string() + ": ctest left no report: " + read.description());
  }
  TestCounts total;
  for (const pugi::xml_node& entry : document.child("testsuite").children("testcase")) {
    const std::string name = entry.attribute("name").value(), status = entry.attribute("status").value();
    const std::string_view why = entry.child("skipped").attribute("message").value();
    const bool skipped = status == "disabled" || why.starts_with("SKIP_");
    const bool failed = !skipped && status != "run";  // also one that could not be started
    const Json report = read_json(reports / (name + ".json"));
    if (report.is_null()) {  // no GoogleTest program, or one that crashed or timed out
      ++(failed ? total.failed : skipped ? total.skipped : total.passed);
      continue;
    }
    TestCounts counts = count_cases(report);
    if (failed && counts.failed == 0) counts.failed = 1;  // all cases passed, yet the program ended badly
    total.passed += counts.passed;
    total.failed += counts.failed;
    total.skipped += counts.skipped;
  }
  return total;
}

std::string summary_line(const TestCounts& counts) {
  std::string line = std::to_string(counts.passed) + " passed, " + std::to_string(counts.failed) + " failed";
  if (counts.skipped > 0) line += ", " + std::to_string(counts.skipped) + " skipped";
  return line;
}

int run_tests(const TestOptions& options, const Console& console) {
  if (options.faults) return run_fault_tests(options, console);
  const ScratchDir scratch;
  const std::filesystem::path build_dir = std::filesystem::absolute(program_dir()).parent_path();
  if (!std::filesystem::exists(build_dir / "CTestTestfile.cmake")) {
    throw InputError(
        "test: there are no tests beside this skein; ./skein test in the source tree builds and runs them");
  }
  const std::filesystem::path junit = scratch.path() / "ctest.xml", reports = scratch.path() / "gtest";
  std::map<std::string, std::string> variables = {{"GTEST_OUTPUT", "json:" + reports.string() + "/"}};
  if (options.long_tests) variables["SKEIN_LONG"] = "1";
  const ExitStatus exit = run_to_end({"ctest",
                                      {"/usr/bin/env", "ctest", "--test-dir", build_dir, "-j2", "--output-on-failure",
                                       "--no-tests=error", "--output-junit", junit},
                                      environment_with(variables),
                                      {}});
  TestCounts counts = count_tests(junit, reports);
  if (!exit.ok() && counts.failed == 0) counts.failed = 1;  // ctest itself failed
  console.out << summary_line(counts) << std::endl;
  return counts.failed == 0 ? kExitDone : kExitCheckFailed;
}

}  // namespace skein::cli

#include "cli/test_counts.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "cli/test_folders.hpp"
#include "core/types.hpp"
#include "host/testing/fake_programs.hpp"

namespace skein::cli {
namespace {

/// A GoogleTest report with one passed, one failed, one skipped and one disabled case.
constexpr const char* kReport = R"({"testsuites": [{"name": "S", "testsuite": [
  {"name": "a", "status": "RUN", "result": "COMPLETED"},
  {"name": "b", "status": "RUN", "result": "COMPLETED", "failures": [{"failure": "x", "type": ""}]},
  {"name": "c", "status": "RUN", "result": "SKIPPED"},
  {"name": "DISABLED_d", "status": "NOTRUN", "result": "SUPPRESSED"}]}]})";

class TestCommand : public ::testing::Test {
 protected:
  std::string counted(const std::string& entries) {
    write_text(scratch_.path() / "ctest.xml", "<testsuite name=\"x\">" + entries + "</testsuite>");
    return summary_line(count_tests(scratch_.path() / "ctest.xml", scratch_.path()));
  }
  /// An entry of ctest's JUnit file.
  static std::string entry(const std::string& name, const std::string& status, const std::string& inside = "") {
    return "<testcase name=\"" + name + "\" classname=\"" + name + "\" time=\"0.1\" status=\"" + status + "\">\n\t\t" +
           inside + "</testcase>\n";
  }
  ScratchDir scratch_;
};

TEST_F(TestCommand, EntriesWithoutAGoogleTestReportCountAsOne) {
  EXPECT_EQ(counted(entry("a", "run") + entry("b", "run")), "2 passed, 0 failed");
  EXPECT_EQ(counted(entry("a", "run") + entry("b", "fail") + entry("d", "disabled") +
                    entry("c", "notrun", R"(<skipped message="SKIP_RETURN_CODE=77"/>)")),
            "1 passed, 1 failed, 2 skipped");
}

TEST_F(TestCommand, AProgramThatWasNotBuiltIsAFailure) {
  EXPECT_EQ(counted(entry("a", "notrun", R"(<skipped message="Unable to find executable"/>)")), "0 passed, 1 failed");
}

TEST_F(TestCommand, EachCaseOfAGoogleTestProgramCounts) {
  write_text(scratch_.path() / "g.json", kReport);
  EXPECT_EQ(counted(entry("g", "fail") + entry("b", "run")), "2 passed, 1 failed, 1 skipped");
}

TEST_F(TestCommand, AProgramThatFailsAfterPassedCasesIsAFailure) {
  write_text(scratch_.path() / "g.json", R"({"testsuites": [{"testsuite": [{"name": "a", "result": "COMPLETED"}]}]})");
  EXPECT_EQ(counted(entry("g", "fail")), "1 passed, 1 failed");
}

TEST_F(TestCommand, TheSlowestPartsComeFirst) {
  const auto timed = [](const std::string& name, const std::string& seconds) {
    return R"(<testcase name=")" + name + R"(" time=")" + seconds + R"(" status="run"/>)";
  };
  const std::string junit = scratch_.path() / "ctest.xml";
  write_text(junit,
             "<testsuite>" + timed("quick", "0.24") + timed("slow", "123.46") + timed("middle", "7") + "</testsuite>");
  EXPECT_EQ(parts_table(junit, 2),
            "the slowest 2 of 3 parts, which took 131 s together:\n    123.5 s  slow\n      7.0 s  middle\n");
  EXPECT_NE(parts_table(junit, 20).find("      0.2 s  quick\n"), std::string::npos);
  write_text(junit, "<testsuite/>");
  EXPECT_EQ(parts_table(junit, 20), "");
}

TEST_F(TestCommand, ChoosesTestsByFolder) {
  const std::filesystem::path list = scratch_.path() / "folders.txt";
  write_text(list, "core\nsim_server/flight\nsim_server\ntests/fleet\ntests\n");
  EXPECT_EQ(labels_of_folders({"core"}, list), "^(core)(/|$)");
  EXPECT_EQ(labels_of_folders({"sim_server/", "tests/fleet"}, list), "^(sim_server|tests/fleet)(/|$)");
  const auto refusal = [&](const std::string& folder) {
    try {
      labels_of_folders({"core", folder}, list);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("sim_sever").find("did you mean 'sim_server'?"), std::string::npos) << refusal("sim_sever");
  EXPECT_NE(refusal("docs").find("known are: core, sim_server, tests"), std::string::npos) << refusal("docs");
  EXPECT_NE(refusal("").find("known are"), std::string::npos);
  EXPECT_NE(refusal("tests/flee").find("did you mean 'tests/fleet'?"), std::string::npos) << refusal("tests/flee");
}

TEST_F(TestCommand, NoReportIsAnError) {
  EXPECT_THROW(count_tests(scratch_.path() / "none.xml", scratch_.path()), std::runtime_error);
}

}  // namespace
}  // namespace skein::cli

// report.html in a browser: it requests no other resource, agrees with the tables of the run, and no part of it is
// blank.
#include "core/files/command_file.hpp"
#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

const fs::path kWeb = source_path("web"), kBundle = source_path("build/web/report.js");

class ReportInABrowser : public FleetTest {
 protected:
  void SetUp() override {
    for (const char* name : {"node", "chromium"}) {
      if (command_file(name).empty()) GTEST_SKIP() << name << " is not installed";
    }
    if (!fs::exists(kWeb / "node_modules" / "puppeteer-core") || !fs::exists(kBundle)) {
      GTEST_SKIP() << "web/ is not built: ./skein test does that, or `npm ci && npm run build` there";
    }
  }

  /// Expects look.mjs to find no problem with the page of a run.
  void look(const std::string& run) {
    ChildProcess& node = start_program("look", {command_file("node"), source_path("tests/report/look.mjs"), kWeb,
                                                command_file("chromium"), program("skein"), kBundle, folder() / run});
    EXPECT_EQ(node.wait(kBrowserPatience).code, 0) << node.err() << node.out();
    EXPECT_EQ(node.out(), "");
  }
};

TEST_F(ReportInABrowser, OfACompleteRunAgreesWithItsTables) {
  run("usual", {"towers", "--one-process", "--planner", "kios", "--duration", "60"});
  look("usual");
}

TEST_F(ReportInABrowser, OfARunWithFaultsAgreesWithItsTables) {
  run("faulty",
      {"towers", "--one-process", "--planner", "patrol", "--duration", "40", "--seed", "3", "--no-oracle", "--faults",
       write("faults.yaml",
             "faults:\n  - {at_s: 12, until_s: 20, station_outage: true}\n  - {at_s: 15, kill: changi}\n")});
  look("faulty");
}

TEST_F(ReportInABrowser, OfARunWithoutScoreAgreesWithItsTables) {
  run("short", {"towers", "--one-process", "--planner", "hover", "--stop-at", "1"});
  look("short");
}

}  // namespace
}  // namespace skein::test

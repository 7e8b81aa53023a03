// Fixtures for tests of the page that `skein run --view` or `skein replay` serves.
#pragma once

#include <filesystem>
#include <regex>
#include <string>

#include "core/files/command_file.hpp"
#include "fleet_fixture.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/places.hpp"

namespace skein::test {

class ViewTest : public FleetTest {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(source_path("build/web/live.js"))) {
      GTEST_SKIP() << "web/ is not built: ./skein test does that, or `npm ci && npm run build` there";
    }
  }

  /// The file that opens the page, from skein's output; empty: skein has not named it yet.
  static std::filesystem::path door_in(const std::string& said) {
    std::smatch found;
    return std::regex_search(said, found, std::regex("open (\\S+)")) ? found[1].str() : "";
  }
  static std::filesystem::path door_of(SkeinRun& run) {
    EXPECT_TRUE(run.wait_for("view.html")) << run.err();
    return door_in(run.err());
  }

  /// Why pages cannot be examined with a browser here; empty: they can.
  static std::string no_browser() {
    for (const char* name : {"node", "chromium"}) {
      if (command_file(name).empty()) return std::string("there is no ") + name;
    }
    if (std::filesystem::exists(source_path("web/node_modules/puppeteer-core"))) return "";
    return "web/ is not built: ./skein test does that, or `npm ci && npm run build` there";
  }

  /// Runs a script of this folder in a browser, which must find nothing wrong with a page.
  /// @param arguments  follow those that all scripts take
  void look_with_browser(const std::string& script, const Arguments& arguments) {
    ChildProcess& node =
        start_program(script, joined({command_file("node"), source_path("tests/view/" + script + ".mjs"),
                                      source_path("web"), command_file("chromium")},
                                     arguments));
    EXPECT_EQ(node.wait(kBrowserPatience).code, 0) << node.err() << node.out();
    EXPECT_EQ(node.out(), "") << node.err();
  }
};

/// For tests that examine a page with a browser, by the scripts in this folder.
class BrowserTest : public ViewTest {
 protected:
  void SetUp() override {
    ViewTest::SetUp();
    if (IsSkipped()) return;
    if (const std::string why = no_browser(); !why.empty()) GTEST_SKIP() << why;
  }

  /// Runs a script, which must find nothing wrong with a page.
  void look(const std::string& script, const std::filesystem::path& door, const std::filesystem::path& run,
            const Arguments& more = {}) {
    look_with_browser(script, joined({door, run}, more));
  }
};

}  // namespace skein::test

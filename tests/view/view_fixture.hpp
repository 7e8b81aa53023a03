// A page that is served by `skein run --view` or `skein replay`.
#pragma once

#include <filesystem>
#include <regex>
#include <string>

#include "core/command_file.hpp"
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

  /// What opens the page, of what skein said about it; empty: nothing yet.
  static std::filesystem::path door_in(const std::string& said) {
    std::smatch found;
    return std::regex_search(said, found, std::regex("open (\\S+)")) ? found[1].str() : "";
  }
  static std::filesystem::path door_of(SkeinRun& run) {
    EXPECT_TRUE(run.wait_for("view.html")) << run.err();
    return door_in(run.err());
  }
};

}  // namespace skein::test

// Follows docs/how-to-add-a-planner.md literally.
#include <fstream>
#include <sstream>
#include <string>

#include "fleet_fixture.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::minutes kCompilersPatience{10};

using PlannerPage = FleetTest;

/// Creates the page's folder with its files, beside a checkout that has only its build folder.
void lay_out(const fs::path& folder, bool with_tests) {
  fs::create_directories(folder / "my_planners");
  fs::create_directories(folder / "skein" / "build");
  fs::create_directory_symlink(build_path(), folder / "skein" / "build" / "release");
  const fs::path page = build_path("tests/howto/page");
  fs::copy_file(page / "orbit.cpp", folder / "my_planners" / "orbit.cpp");
  fs::copy_file(page / "outside.sh", folder / "outside.sh");
  std::ofstream(folder / "my_planners" / "CMakeLists.txt")
      << text_of(page / "CMakeLists.txt") << (with_tests ? text_of(page / "tests.cmake") : "");
}

TEST_F(PlannerPage, ItsPlannerFliesTheSameInTheTreeAndOutOfIt) {
  lay_out(folder(), long_tests());
  // The commands are executed twice, as a reader may do. No variable may help the installed programs to find their
  // configuration.
  const std::string follow = "cd " + folder().string() +
                             " && unset SKEIN_CONFIG_DIR SKEIN_BIN_DIR && set -e && . ./outside.sh && . ./outside.sh" +
                             (long_tests() ? " && ctest --test-dir my_planners/build --output-on-failure" : "");
  Environment environment = {{"XDG_CACHE_HOME", folder() / "cache"}};
  environment["CMAKE_CXX_COMPILER_LAUNCHER"] = compiler_launcher();
  ChildProcess outside({"/bin/sh", "-c", follow}, environment, folder() / "outside.out", folder() / "outside.err");
  ASSERT_TRUE(eventually([&] { return outside.ended().has_value(); }, kCompilersPatience));
  ASSERT_EQ(outside.ended()->code, 0) << outside.out() << outside.err();
  SkeinRun& inside =
      run("inside", {"towers", "--agent", helper_program("howto_agent"), "--planner", "orbit", "--duration", "45"});

  const Json there = Json::parse(text_of(folder() / "runs" / "towers-orbit-0" / "result.json"));
  EXPECT_EQ(there["status"], "completed");
  EXPECT_EQ(there["digest"], inside.digest());
  const Json sooner = Json::parse(text_of(folder() / "sooner" / "result.json"));
  EXPECT_EQ(sooner["digest"], inside.digest());
  EXPECT_EQ(sooner["dds"]["sim_server"], "inproc");
  EXPECT_EQ(there["planner"]["gcs"], "orbit");
  EXPECT_EQ(fs::path(there["agent"].get<std::string>()).filename(), "my_agent");
  EXPECT_TRUE(there["collisions"].empty());
  EXPECT_GT(there["score_earned"], 0.0) << "the planner photographs nothing";
  expect_complete_result(inside);
}

/// Readers should see the whole planner at a glance. Code that other planners need, too, belongs in Skein.
TEST_F(PlannerPage, ItsPlannerHasAtMost60LinesOfCode) {
  const std::string file = text_of(build_path("tests/howto/page/orbit.cpp"));
  std::istringstream planner(file.substr(0, file.find("// orbit.cpp, continued")));
  int lines = 0;
  for (std::string line; std::getline(planner, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    lines += begin != std::string::npos && line.compare(begin, 2, "//") != 0;
  }
  EXPECT_GT(lines, 40) << "the page's code was not found";
  EXPECT_LE(lines, 60);
}

TEST_F(PlannerPage, AnAgentOutsideTheTreeKnowsTheOtherPlannersAndNamesThem) {
  SkeinRun& unknown =
      run("unknown", {"towers", "--agent", helper_program("howto_agent"), "--planner", "orbits"}, {}, 2);
  EXPECT_NE(unknown.err().find("did you mean 'orbit'"), std::string::npos) << unknown.err();
  const std::string plain = skein({"run", "towers", "--planner", "orbit", "--out", folder() / "plain"}).err();
  EXPECT_NE(plain.find("patrol"), std::string::npos) << plain;
}

}  // namespace
}  // namespace skein::test

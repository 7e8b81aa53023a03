// The rules on this source tree.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "tests/layers/rules.hpp"
#include "tests/support/places.hpp"

namespace skein::layers {
namespace {

using testing::Test;

class Layers : public Test {
 protected:
  static void SetUpTestSuite() { tree_ = read_source_tree(source_path()); }

  static void expect_none(const Violations& violations) {
    for (const std::string& violation : violations) ADD_FAILURE() << violation;
  }

  inline static Tree tree_;
};

TEST_F(Layers, TheSourceTreeIsFound) {
  for (const char* path :
       {"core/types.hpp", "idl/skein_msgs.idl", "bus/bus.hpp", "sim_server/main.cpp", "uav_agent/api/planner.hpp",
        "comm_router/main.cpp", "station/main.cpp", "cli/main.cpp", "tests/layers/rules.cpp", ".ci/run", "README.md"}) {
    EXPECT_TRUE(std::ranges::any_of(tree_, [&](const SourceFile& file) { return file.path == path; })) << path;
  }
}

TEST_F(Layers, EachLayerIncludesOnlyThoseBelow) { expect_none(check_layers(tree_)); }
TEST_F(Layers, IncludesBetweenFoldersFormNoCycle) { expect_none(check_circles(tree_)); }
TEST_F(Layers, OnlyNodesUseTheBus) { expect_none(check_bus_users(tree_)); }
TEST_F(Layers, OnlyAVendorsFolderIncludesItsDds) { expect_none(check_dds_headers(tree_)); }
TEST_F(Layers, LargeLibrariesAreIncludedInFewFiles) { expect_none(check_libraries(tree_, library_rules())); }
TEST_F(Layers, HeadersAreSafeToInclude) { expect_none(check_headers(tree_)); }
TEST_F(Layers, NoLibraryPrints) { expect_none(check_printing(tree_)); }
TEST_F(Layers, NoCodeSleeps) { expect_none(check_sleeping(tree_)); }
TEST_F(Layers, TestsReadNoClock) { expect_none(check_clocks(tree_)); }
TEST_F(Layers, FilesAreShort) { expect_none(check_length(tree_)); }
TEST_F(Layers, FunctionsAreShort) { expect_none(check_functions(tree_, long_functions())); }
TEST_F(Layers, NumbersOfTheAgentNameTheirSource) { expect_none(check_sources(tree_)); }
TEST_F(Layers, LinesAreShort) { expect_none(check_columns(tree_)); }
TEST_F(Layers, NothingIsMarkedUnfinished) { expect_none(check_marks(tree_)); }
TEST_F(Layers, FilesThatAreNamedExist) { expect_none(check_references(tree_)); }
TEST_F(Layers, TestsThatPagesNameExist) { expect_none(check_named_tests(tree_)); }
TEST_F(Layers, OneHeaderNamesTheFilesOfARun) { expect_none(check_run_files(tree_)); }
TEST_F(Layers, DecisionsAreShortAndHaveTheirSections) { expect_none(check_decisions(tree_)); }
TEST_F(Layers, TestNamesNameTheirActor) { expect_none(check_test_names(tree_)); }
TEST_F(Layers, NoMachineIsNamed) { expect_none(check_machine_paths(tree_)); }

TEST_F(Layers, CodeIsFormatted) {
  const std::string list = testing::TempDir() + "skein_cpp_files_" + std::to_string(::getpid());
  std::ofstream out(list);
  for (const SourceFile& file : tree_) {
    if (file.is_cpp()) out << file.path << '\n';
  }
  out.close();
  if (std::system("command -v clang-format >/dev/null") != 0) GTEST_SKIP() << "clang-format is not installed";
  const std::string command = "cd '" + source_path() + "' && xargs clang-format --dry-run -Werror <" + list;
  EXPECT_EQ(std::system(command.c_str()), 0) << "format these files with clang-format -i";
  std::filesystem::remove(list);
}

TEST_F(Layers, GitTracksNoProductsAndNoLargeFiles) {
  const auto tracked = tracked_files(source_path());
  if (!tracked) GTEST_SKIP() << "this is not a git checkout, or git is not installed";
  EXPECT_FALSE(tracked->empty());
  expect_none(check_tracked_files(source_path(), *tracked));
}

}  // namespace
}  // namespace skein::layers

// Each rule on a small tree that breaks it, to show that the rule can find violations.
#include "tests/layers/rules.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace skein::layers {
namespace {

namespace fs = std::filesystem;

/// A folder with files that a test writes.
class MadeUpTree : public ::testing::Test {
 protected:
  MadeUpTree() {
    std::string name = fs::temp_directory_path() / "skein-layers-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot create " + name);
    root_ = name;
  }
  ~MadeUpTree() override {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }

  void file(const std::string& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  Tree tree() const { return read_source_tree(root_); }

  /// "path:line" of each violation.
  static std::vector<std::string> places(const Violations& violations) {
    std::vector<std::string> result;
    for (const std::string& violation : violations) result.push_back(violation.substr(0, violation.find(": ")));
    return result;
  }

  fs::path root_;
};

using Places = std::vector<std::string>;

std::string include(const std::string& path) { return "#include \"" + path + "\"\n"; }
std::string include_system(const std::string& path) { return "#include <" + path + ">\n"; }

TEST(Blanking, LeavesOnlyCode) {
  EXPECT_EQ(blank_comments_and_literals("a // b\nc /* d\ne */ f"), "a     \nc     \n     f");
  EXPECT_EQ(blank_comments_and_literals(R"(f("x\"y", 'z') + 1'000)"), "f(      ,    ) + 1'000");
  EXPECT_EQ(blank_comments_and_literals("a R\"x(\" // )\" )x\" b"), "a                 b");
  EXPECT_EQ(blank_comments_and_literals("\"never closed\nint x;"), "             \nint x;");
  EXPECT_EQ(blank_comments_and_literals("/* never closed"), "               ");
}

TEST(Blanking, LeavesOnlyComments) {
  EXPECT_EQ(only_comments("a // b\nc /* d\ne */ f"), "  // b\n  /* d\ne */  ");
  EXPECT_EQ(only_comments("f(\"// a\"); // b"), "           // b");
  EXPECT_EQ(only_comments("R\"(// a)\""), "         ");
}

TEST_F(MadeUpTree, IsReadWithoutBuildTreesAndBinaries) {
  file("core/a.hpp", "");
  file("build/b.hpp", "");
  file(".git/c.hpp", "");
  file(".ci/run", "x\n");
  file("runs/d.csv", "");
  file("web/node_modules/x/f.js", "");
  file("e.bin", std::string("\0", 1));
  Places paths;
  for (const SourceFile& source : tree()) paths.push_back(source.path);
  EXPECT_EQ(paths, (Places{".ci/run", "core/a.hpp"}));
}

TEST_F(MadeUpTree, IncludesOfHigherLayersAreFound) {
  for (const char* path :
       {"core/a.hpp", "idl/a.hpp", "bus/a.hpp", "sim_server/a.hpp", "uav_agent/a.hpp", "report/a.hpp",
        "recording/a.hpp", "recording/mcap/a.hpp", "results/a.hpp", "process/a.hpp", "scenes/a.hpp", "host/a.hpp",
        "debug/a.hpp", "signals/a.hpp", "signals/properties/a.hpp", "run/a.hpp", "one_process/a.hpp", "tests/a.hpp"}) {
    file(path, "\n");
  }
  file("bus/good.cpp", include("core/a.hpp") + include("idl/a.hpp") + include("bus/a.hpp"));
  file("one_process/good.cpp", include("sim_server/a.hpp") + include("uav_agent/a.hpp") + include("bus/a.hpp"));
  file("tests/good.cpp", include("sim_server/a.hpp") + include("uav_agent/a.hpp") + include("tests/a.hpp"));
  file("station/good_test.cpp", include("tests/a.hpp"));
  file("cli/good.cpp", include("report/a.hpp") + include("host/a.hpp") + include("run/a.hpp"));
  file("debug/good.cpp", include("host/a.hpp"));
  file("host/good.cpp", include("process/a.hpp") + include("results/a.hpp"));
  file("results/good.cpp", include("process/a.hpp"));
  file("report/good.cpp", include("results/a.hpp"));
  file("recording/good.cpp", include("recording/mcap/a.hpp") + include("bus/a.hpp"));
  file("run/good.cpp", include("debug/a.hpp") + include("host/a.hpp") + include("recording/a.hpp"));
  file("sim_server/good.cpp", include("scenes/a.hpp") + include("signals/a.hpp"));
  file("signals/good.cpp", include("signals/properties/a.hpp") + include("recording/mcap/a.hpp"));
  file("view/good.cpp", include("recording/mcap/a.hpp"));
  EXPECT_EQ(check_layers(tree()), Violations{});

  file("core/bad.cpp", std::string("\n") + include("idl/a.hpp"));
  file("host/bad.cpp", include("results/a.hpp") + include("debug/a.hpp"));
  file("idl/bad.cpp", include("core/a.hpp") + include("bus/a.hpp"));
  file("bus/bad.hpp", include_system("sim_server/a.hpp"));
  file("cli/bad.cpp", std::string("// ") + include("uav_agent/a.hpp") + include("../uav_agent/a.hpp"));
  file("report/bad.cpp", include("core/a.hpp") + include("bus/a.hpp") + include("sim_server/a.hpp"));
  file("recording/mcap/bad.cpp", include("core/a.hpp") + include("recording/a.hpp") + include("bus/a.hpp"));
  file("results/bad.cpp", include("process/a.hpp") + include("report/a.hpp") + include("bus/a.hpp"));
  file("run/bad.cpp", include("view/a.hpp") + include("cli/good.cpp"));
  file("scenes/bad.cpp", include("core/a.hpp") + include("sim_server/a.hpp") + include("bus/a.hpp"));
  file("signals/bad.cpp", include("results/a.hpp") + include("sim_server/a.hpp"));
  file("signals/properties/bad.cpp", include("core/a.hpp") + include("signals/a.hpp"));
  file("station/bad.cpp", include("tests/a.hpp"));
  file("uav_agent/bad.cpp", include("sim_server/a.hpp") + include("one_process/a.hpp") + include("run/a.hpp"));
  const Places expected = {"bus/bad.hpp:1",
                           "cli/bad.cpp:2",
                           "core/bad.cpp:2",
                           "host/bad.cpp:2",
                           "idl/bad.cpp:2",
                           "recording/mcap/bad.cpp:2",
                           "recording/mcap/bad.cpp:3",
                           "report/bad.cpp:2",
                           "report/bad.cpp:3",
                           "results/bad.cpp:2",
                           "results/bad.cpp:3",
                           "run/bad.cpp:2",
                           "scenes/bad.cpp:2",
                           "scenes/bad.cpp:3",
                           "signals/bad.cpp:2",
                           "signals/properties/bad.cpp:2",
                           "station/bad.cpp:1",
                           "uav_agent/bad.cpp:1",
                           "uav_agent/bad.cpp:2",
                           "uav_agent/bad.cpp:3"};
  EXPECT_EQ(places(check_layers(tree())), expected);
}

TEST_F(MadeUpTree, UsesOfTheBusOutsideNodesAreFound) {
  file("bus/bus.hpp", "\n");
  file("bus/good.cpp", include("bus/bus.hpp"));
  for (const char* path :
       {"station/main.cpp", "station/station_node.hpp", "station/station_node.cpp", "station/station_node_test.cpp",
        "station/station_program.hpp", "station/station_program.cpp"}) {
    file(path, include("bus/bus.hpp"));
  }
  file("run/ground_program.hpp", "\n");
  file("run/plan.cpp", include("run/ground_program.hpp"));
  EXPECT_EQ(check_bus_users(tree()), Violations{});

  file("station/journal.cpp", include("bus/bus.hpp"));
  file("station/tally.cpp", include("station_node.hpp"));
  file("sim_server/node_list.cpp", include("bus/bus.hpp"));
  file("run/ground_program.cpp", include("bus/bus.hpp"));
  EXPECT_EQ(places(check_bus_users(tree())), (Places{"run/ground_program.cpp:1", "sim_server/node_list.cpp:1",
                                                     "station/journal.cpp:1", "station/tally.cpp:1"}));
}

TEST_F(MadeUpTree, IncludesOfDdsOutsideItsVendorsFolderAreFound) {
  file("bus/fastdds/a.cpp", include_system("fastdds/dds/topic/Topic.hpp") + include_system("fastrtps/a.h"));
  file("bus/cyclonedds/a.cpp", include_system("dds/dds.h") + include_system("ddsc/dds.h"));
  file("bus/b.cpp", include("bus/fastdds/a.hpp"));
  file("tests/fleet/client.cpp", include_system("dds/dds.h"));
  EXPECT_EQ(check_dds_headers(tree()), Violations{});

  file("bus/bus.hpp", include_system("dds/dds.h"));
  file("bus/fastdds/bad.cpp", include_system("ddsc/dds.h"));
  file("uav_agent/agent_node.cpp", std::string("\n\n") + include_system("fastrtps/a.h"));
  EXPECT_EQ(places(check_dds_headers(tree())),
            (Places{"bus/bus.hpp:1", "bus/fastdds/bad.cpp:1", "uav_agent/agent_node.cpp:3"}));
}

TEST_F(MadeUpTree, LargeLibrariesInTooManyFilesAreFound) {
  file("sim_server/world.cpp", include_system("btBulletDynamicsCommon.h"));
  file("sight/rays.cpp", include_system("embree3/rtcore.h"));
  file("scenes/files/point_file_pcl_test.cpp", include_system("pcl/io/pcd_io.h"));
  file("scenes/files/meshes.cpp", include_system("assimp/scene.h"));
  file("uav_agent/map.cpp", include_system("octomap/OcTree.h") + include_system("pcl/point_types.h"));
  file("uav_agent/python/values.hpp", include_system("pybind11/numpy.h"));
  EXPECT_EQ(check_libraries(tree(), library_rules()), Violations{});

  file("uav_agent/api/planner.hpp", include_system("pybind11/numpy.h"));
  file("core/scenario/scene.hpp", include_system("pcl/point_types.h"));
  file("sim_server/map.cpp", include_system("octomap/OcTree.h"));
  file("sight/rays.hpp", include_system("embree3/rtcore.h"));
  file("scenes/files/points.cpp", include_system("pcl/io/pcd_io.h"));
  file("uav_agent/flight.cpp", include_system("LinearMath/btVector3.h"));
  file("uav_agent/map2.cpp", include_system("pcl/point_types.h"));
  file("uav_agent/map3.cpp", include_system("pcl/point_types.h"));
  EXPECT_EQ(places(check_libraries(tree(), library_rules())),
            (Places{"uav_agent/flight.cpp:1", "sight/rays.hpp:1", "sim_server/map.cpp:1", "core/scenario/scene.hpp:1",
                    "scenes/files/points.cpp:1", "uav_agent/map3.cpp:1", "uav_agent/api/planner.hpp:1"}));
}

TEST_F(MadeUpTree, HeadersWithoutAGuardOrThatLeakNamesAreFound) {
  file("core/good.hpp", "// using namespace std;\n#pragma once\nusing std::string;\n");
  file("core/good.cpp", "using namespace std;\n");
  EXPECT_EQ(check_headers(tree()), Violations{});

  file("core/bad.hpp", "#pragma once\nusing  namespace std;\n");
  file("core/bare.hpp", "// #pragma once\n");
  EXPECT_EQ(places(check_headers(tree())), (Places{"core/bad.hpp:2", "core/bare.hpp:1"}));
}

TEST_F(MadeUpTree, PrintingOutsideTheCommandLineIsFound) {
  for (const char* path : {"cli/a.cpp", "station/main.cpp", "sim_server/server_tasks.cpp",
                           "uav_agent/agent_program.cpp", "core/a_test.cpp", "tests/a.cpp"}) {
    file(path, "std::cout << 1; printf(text);\n");
  }
  file("core/good.cpp", "// printf(x)\nsnprintf(b, n, f); log(\"std::cout\"); sprintf_like(x);\n");
  EXPECT_EQ(check_printing(tree()), Violations{});

  file("core/bad.cpp", "\nstd::cout << 1;\nstd::printf (text);\n");
  EXPECT_EQ(places(check_printing(tree())), (Places{"core/bad.cpp:2", "core/bad.cpp:3"}));
}

TEST_F(MadeUpTree, SleepingCodeIsFoundOutsideTests) {
  file("tests/a.cpp", "std::this_thread::sleep_for(t);\n");
  file("core/good.cpp", "fall_asleep_if_still(); // sleep_for(t)\nbool asleep();\n");
  EXPECT_EQ(check_sleeping(tree()), Violations{});

  file("bus/bad.cpp", "std::this_thread::sleep_for(t);\nusleep(3);\n");
  file("bus/bad_test.cpp", "sleep(1);\n");
  EXPECT_EQ(places(check_sleeping(tree())), (Places{"bus/bad.cpp:1", "bus/bad.cpp:2", "bus/bad_test.cpp:1"}));
}

TEST_F(MadeUpTree, TestsThatReadAClockAreFound) {
  file("tests/support/eventually.cpp", "auto t = std::chrono::steady_clock::now();\n");
  file("core/good.cpp", "auto t = std::chrono::steady_clock::now();\n");
  file("core/good_test.cpp", "// steady_clock::now()\nstd::chrono::steady_clock::time_point t; std::timed(x);\n");
  EXPECT_EQ(check_clocks(tree()), Violations{});

  file("core/bad_test.cpp", "auto t = Clock::now();\nauto u = steady_clock :: now();\n::clock_gettime(0, &t);\n");
  file("tests/bad.cpp", "std::time(nullptr);\n");
  EXPECT_EQ(places(check_clocks(tree())),
            (Places{"core/bad_test.cpp:1", "core/bad_test.cpp:2", "core/bad_test.cpp:3", "tests/bad.cpp:1"}));
}

TEST_F(MadeUpTree, LongFilesAreFound) {
  file("docs/long.md", "1\n2\n3\n4\n");
  file("core/good.cpp", "1\n2\n3\n");
  file("core/long.cpp", "1\n2\n3\n4\n");
  for (const char* path : {"python/long.py", "tests/long.mjs", "web/long.js"}) file(path, "1\n2\n3\n4\n");
  EXPECT_EQ(places(check_length(tree(), 3)),
            (Places{"core/long.cpp:4", "python/long.py:4", "tests/long.mjs:4", "web/long.js:4"}));
}

TEST_F(MadeUpTree, LongFunctionsAreFoundUnlessTheListHasThem) {
  const std::string three = " {\n1;\nif (x) {\n}\n}\n";
  file("core/a.cpp", "namespace a {\nint X::f(int x) const" + three + "struct B {\n  void g()" + three + "};\n}\n");
  file("core/b.cpp", "X::X(int x)\n    : a_(x), b_{x}" + three + "const int kTable[] = {\n1,\n2,\n3,\n4,\n};\n");
  file("core/short.cpp", "void h() {\n1;\n2;\n}\nvoid long_one() { // {\n}\n");
  file("core/a_test.cpp", "void f()" + three);
  EXPECT_EQ(places(check_functions(tree(), {}, 2)), (Places{"core/a.cpp:2", "core/a.cpp:8", "core/b.cpp:2"}));
  EXPECT_EQ(places(check_functions(tree(), {{"core/a.cpp", "f", ""}, {"core/a.cpp", "g", ""}, {"x", "f", ""}}, 2)),
            (Places{"core/b.cpp:2", "x:1"}));
  EXPECT_EQ(places(check_functions(tree(), {{"core/short.cpp", "h", ""}}, 3)), Places{"core/short.cpp:1"});
}

TEST_F(MadeUpTree, LongFunctionsOfPythonAndJavaScriptAreFound) {
  file("python/a.py", "def f(x,\n      y):\n    1\n\nclass B:\n    def g(self) -> int:\n        1\n\n        2\n\n1\n");
  file("web/a.js",
       "const h = (x) => {\n  1;\n  2;\n  3;\n};\nif (h(1)) {\n1;\n2;\n3;\n}\n"
       "export function k() {\n  function inner() {\n    1;\n  }\n}\nclass C {\n  m() {\n    1;\n    2;\n    3;\n  }\n"
       "  n() {\n    for (;;) {\n    }\n  }\n}\n");
  file("tests/a.mjs", "function t() {\n  1;\n  2;\n  3;\n}\n");
  EXPECT_EQ(places(check_functions(tree(), {}, 2)),
            (Places{"python/a.py:6", "web/a.js:1", "web/a.js:11", "web/a.js:17"}));
  EXPECT_EQ(
      places(check_functions(tree(), {{"python/a.py", "g", ""}, {"web/a.js", "k", ""}, {"web/a.js", "n", ""}}, 2)),
      (Places{"web/a.js:1", "web/a.js:17", "web/a.js:22"}));
}

TEST_F(MadeUpTree, LongLinesAreFoundInAllCodeAndPages) {
  file("core/good.cpp", "1234\n12\u00e94\n");
  file("docs/page.md", "1234\n| 12345 |\n  ![12345](x)\n```sh\n12345\n```\n");
  file("core/text.cpp", "R\"(\n12345\n)\"\n");
  EXPECT_EQ(check_columns(tree(), 4), Violations{});
  file("core/CMakeLists.txt", "\n12345\n");
  file("core/long.hpp", "12345\n");
  file("python/long.py", "12345\n");
  file("skein", "12345\n");
  file("docs/long.md", "```\n12345\n```\n\n12345\n");
  EXPECT_EQ(places(check_columns(tree(), 4)),
            (Places{"core/CMakeLists.txt:2", "core/long.hpp:1", "docs/long.md:5", "python/long.py:1", "skein:1"}));
}

TEST_F(MadeUpTree, FoldersThatIncludeEachOtherAreFound) {
  for (const char* path : {"station/a/x.hpp", "station/b/x.hpp", "station/top.hpp", "cli/a/x.hpp"}) file(path, "\n");
  file("station/a/x.cpp", include("station/a/x.hpp") + include("station/b/x.hpp") + include("station/top.hpp"));
  file("station/top.cpp", include("station/b/x.hpp"));
  file("station/b/x_test.cpp", include("station/a/x.hpp"));
  EXPECT_EQ(check_circles(tree()), Violations{});
  file("station/b/y.cpp", std::string("\n") + include("station/top.hpp"));  // via the file beside the folders
  EXPECT_EQ(places(check_circles(tree())), (Places{"station/b/y.cpp:2", "station/top.cpp:1"}));
}

TEST_F(MadeUpTree, UnfinishedWorkIsFoundInAnyText) {
  file("core/good.cpp",
       "int todo; // METHOD"
       "OLOGY\n");
  EXPECT_EQ(check_marks(tree()), Violations{});

  file("core/bad.cpp",
       "\n// TO"
       "DO: think\n");
  file("docs/bad.md",
       "FIX"
       "ME\n");
  EXPECT_EQ(places(check_marks(tree())), (Places{"core/bad.cpp:2", "docs/bad.md:1"}));
}

TEST_F(MadeUpTree, PathsOfAMachineAreFoundInAnyText) {
  const std::string home = std::string("/") + "home/me", work = std::string("/") + "work";
  file("docker/Dockerfile", std::string("WORKDIR ") + home + "\n");
  file("core/good.cpp",
       std::string("// teamwork/") + home.substr(1) + ", a" + work + ", " + work + "ing, ./x" + home + "\n");
  EXPECT_EQ(check_machine_paths(tree()), Violations{});

  file("core/bad.cpp", "\nopen(\"" + home + "/x\");\n");
  file("config/bad.yaml", "file: " + work + "/x\n");
  file("docs/bad.md", work + "\n");
  EXPECT_EQ(places(check_machine_paths(tree())), (Places{"config/bad.yaml:1", "core/bad.cpp:2", "docs/bad.md:1"}));
}

TEST_F(MadeUpTree, NamesOfFilesThatDoNotExistAreFound) {
  file("core/good.hpp",
       "// See docs/good.md, core/good.hpp (good.hpp), core/good.*, and what is in my_runs/result.json.\n");
  file("core/literal.cpp", "open(\"core/none.hpp\");  // and core/*.hpp, x.y.z\n");
  file("docs/good.md",
       "`core/good.hpp`, `good.hpp`, mine.cpp and mine/scenario.yaml\n```cpp orbit.cpp\n```\nSave it as "
       "`core/orbit.cpp`.\n");
  file("sight/rays/fan.hpp", "// Used by rays/fan.hpp.\n");
  EXPECT_EQ(check_references(tree()), Violations{});

  file("core/bad.cpp", "// core/none.hpp\nint x;  // rays/good.hpp\n/* docs/none.md */ // gone.hpp\n// core/gone.*\n");
  file("docs/bad.md", "\nsee `core/gone.hpp`, [this](docs/gone.md), core/orbit.cpp\nand `gone.hpp`\n");
  file("README.md", "config/x.yaml, docs/good.md, docs/x.json\n");
  EXPECT_EQ(places(check_references(tree())),
            (Places{"README.md:1", "core/bad.cpp:1", "core/bad.cpp:2", "core/bad.cpp:3", "core/bad.cpp:3",
                    "core/bad.cpp:4", "docs/bad.md:2", "docs/bad.md:2", "docs/bad.md:2", "docs/bad.md:3"}));
}

TEST_F(MadeUpTree, NamesOfARunsFilesOutsideTheirHeaderAreFound) {
  file("results/run_folder.hpp", "inline constexpr const char* kScore = \"score.csv\";\n/// \"station.log\"\n");
  file("cli/good.cpp", "say(\"no score.csv\");  // \"score.csv\"\nopen(\"other.csv\"); open(\"station.log\");\n");
  file("station/good_test.cpp", "open(\"score.csv\");\n");
  EXPECT_EQ(check_run_files(tree()), Violations{});

  file("cli/bad.cpp", "\nopen(dir / \"score.csv\");\n");
  EXPECT_EQ(places(check_run_files(tree())), Places{"cli/bad.cpp:2"});
}

TEST_F(MadeUpTree, DecisionsWithoutASectionAreFound) {
  file("docs/decisions/0001-good.md", "# 1.\n## Context\n## Decision: x\n## Consequences\n## Alternatives tried\n");
  file("docs/decisions/0002-gone.md", "# 2.\n\nSuperseded by [decision 1](0001-good.md).\n");
  EXPECT_EQ(check_decisions(tree()), Violations{});

  file("docs/decisions/0003-bad.md",
       "# 3.\n\nSuperseded for x by [decision 1](0001-good.md).\n## Context\n## Decision\n");
  EXPECT_EQ(places(check_decisions(tree())), (Places{"docs/decisions/0003-bad.md:1", "docs/decisions/0003-bad.md:1"}));
}

TEST_F(MadeUpTree, DecisionsLongerThanAPageAreFound) {
  const std::string sections = "## Context\n## Decision\n## Consequences\n## Alternatives\n";
  file("docs/decisions/0001-good.md", sections + "5\n6\n");
  file("docs/long.md", sections + "5\n6\n7\n");
  EXPECT_EQ(check_decisions(tree(), 6), Violations{});
  file("docs/decisions/0002-long.md", sections + "5\n6\n7\n");
  file("docs/decisions/0003-gone.md", "# 3.\n\nSuperseded by [decision 1](0001-good.md).\n4\n5\n6\n7\n");
  const Places too_long = {"docs/decisions/0002-long.md:7", "docs/decisions/0003-gone.md:7"};
  EXPECT_EQ(places(check_decisions(tree(), 6)), too_long);
}

TEST_F(MadeUpTree, TestNamesWithoutAnActorAreFound) {
  file("core/good_test.cpp",
       "TEST(Who, WholeNumbersAreDecimal) {}\nTEST_F(Map, TellsWhatItKnows) {}\n// TEST(Map, WhatIsWrong) {}\n"
       "EXPECT_EQ(f(What), Nobody);\ntext = \"TEST(Map, WhoIsThere)\";\n");
  file("python/tests/test_good.py", "def test_whole_numbers():\ndef what_is_wrong():\ndef test_says_what():\n");
  EXPECT_EQ(check_test_names(tree()), Violations{});
  file("core/bad_test.cpp",
       "TEST(Map, WhatIsWrong) {}\nTEST_F(Map, WhoeverAsks) {}\nTEST_P(Map, WhoseMapIsLost) {}\n"
       "TEST(Map, NobodyHearsIt) {}\nTEST(Map,\n     WhomItTells) {}\nTEST(Map, Somebody) {}\n");
  file("python/tests/test_bad.py", "def test_what_is_wrong() -> None:\n    def test_nobody_hears_it(self):\n");
  EXPECT_EQ(places(check_test_names(tree())),
            (Places{"core/bad_test.cpp:1", "core/bad_test.cpp:2", "core/bad_test.cpp:3", "core/bad_test.cpp:4",
                    "core/bad_test.cpp:5", "core/bad_test.cpp:7", "python/tests/test_bad.py:1",
                    "python/tests/test_bad.py:2"}));
}

TEST_F(MadeUpTree, ProductsAndLargeFilesAreFoundAmongTheTracked) {
  file("docs/large.png", std::string(11, 'x'));
  file("docs/small.png", std::string(10, 'x'));
  const std::vector<std::string> tracked = {"build/a.txt",      "core/build-x/a.txt", "core/CMakeLists.txt",
                                            "docs/building.md", "docs/large.png",     "docs/small.png",
                                            "lib/a.so",         "x/CMakeFiles/a",     "x/CMakeCache.txt"};
  EXPECT_EQ(places(check_tracked_files(root_, tracked, 10)),
            (Places{"build/a.txt:1", "core/build-x/a.txt:1", "docs/large.png:1", "lib/a.so:1", "x/CMakeFiles/a:1",
                    "x/CMakeCache.txt:1"}));
  EXPECT_EQ(tracked_files(root_), std::nullopt);
}

}  // namespace
}  // namespace skein::layers

#include "run/python_planners.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/types.hpp"
#include "host/preflight.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

class PythonPlanners : public testing::Test {
 protected:
  void SetUp() override {
    write("mine/orbit.py", "1");
    write("mine/helper.py", "2");
    write("mine/parts/__init__.py", "3");
    write("mine/parts/deep.py", "4");
    write("mine/data/no_package.py", "5");
    write("mine/notes.txt", "6");
  }
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((dir() / file).parent_path());
    std::ofstream(dir() / file) << text;
  }
  const fs::path& dir() const { return scratch_.path(); }
  fs::path orbit() const { return dir() / "mine/orbit.py"; }
  std::string spec(const std::string& more = "") const { return "py:" + orbit().string() + more; }

  /// The keys of result.json about planners, as write_results() writes them for a fleet of one UAV.
  Json result() const {
    return {{"planner", {{"jurong", spec(":Orbit:x=1")}}}, {"planner_files", kept({{"jurong", spec(":Orbit:x=1")}})}};
  }
  Json kept(const std::vector<UavPlanner>& planners) const {
    std::vector<std::string> warnings;
    Json files = keep_python_files(planners, dir() / "run", warnings);
    EXPECT_EQ(warnings, std::vector<std::string>());
    return files;
  }
  std::string again(const std::string& text, const Json& result) {
    told_.clear();
    return with_python_files_of(text, {"jurong"}, dir() / "run", result,
                                [this](const std::string& said) { told_ += said; });
  }

  std::string told_;

 private:
  const ScratchDir scratch_;
};

TEST_F(PythonPlanners, FilesAreFoundFromTheLaunchersFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(dir());
  Planners planners = parse_planners("hover,jurong=py:mine/../mine/orbit.py:Orbit:x=1,y=2", {"jurong", "raffles"});
  find_python_files(planners);
  fs::current_path(before);
  EXPECT_EQ(planners.uavs[0].spec, "py:" + fs::canonical(orbit()).string() + ":Orbit:x=1,y=2");
  EXPECT_EQ(planners.uavs[1].spec, "hover");
  Planners none = parse_planners(spec().substr(0, spec().size() - 1), {"jurong"});
  EXPECT_THROW(find_python_files(none), InputError);
  Planners ground = parse_planners("gcs=" + spec(), {"jurong"});
  EXPECT_THROW(find_python_files(ground), InputError);
}

TEST_F(PythonPlanners, ModulesAndPackagesInItsFolderBelongToAPlanner) {
  std::vector<std::string> names;
  for (const fs::path& source : python_sources(orbit())) names.push_back(source.lexically_relative(dir() / "mine"));
  EXPECT_EQ(names, (std::vector<std::string>{"orbit.py", "helper.py", "parts/__init__.py", "parts/deep.py"}));
}

TEST_F(PythonPlanners, TheDigestCoversEachFileOfAPlanner) {
  const std::string before = python_digest(orbit());
  for (const char* file : {"mine/orbit.py", "mine/helper.py", "mine/parts/deep.py"}) {
    write(file, "other");
    EXPECT_NE(python_digest(orbit()), before) << file;
    write(file, file == std::string("mine/orbit.py") ? "1" : file == std::string("mine/helper.py") ? "2" : "4");
    EXPECT_EQ(python_digest(orbit()), before) << file;
  }
  write("mine/notes.txt", "other");
  write("mine/data/no_package.py", "other");
  EXPECT_EQ(python_digest(orbit()), before);
}

TEST_F(PythonPlanners, OfAFolderWithTooManyFilesOnlyThePlannerIsKept) {
  for (int i = 0; i < 150; ++i) write("mine/m" + std::to_string(i) + ".py", "");
  EXPECT_EQ(python_sources(orbit()), std::vector<fs::path>{orbit()});
}

TEST_F(PythonPlanners, ARepeatedRunUsesTheKeptFilesIfTheOriginalsHaveChanged) {
  const Json flown = result();
  EXPECT_EQ(again("py:mine/orbit.py:Orbit:x=1", flown), "py:mine/orbit.py:Orbit:x=1,jurong=" + spec(":Orbit:x=1"));
  EXPECT_EQ(told_, "");
  write("mine/parts/deep.py", "changed");
  const fs::path kept = dir() / "run" / flown["planner_files"][0]["kept"].get<std::string>();
  EXPECT_EQ(again(spec(":Orbit:x=1"), flown),
            spec(":Orbit:x=1") + ",jurong=py:" + fs::absolute(kept).string() + ":Orbit:x=1");
  EXPECT_NE(told_.find("has changed"), std::string::npos);
  EXPECT_TRUE(fs::exists(kept.parent_path() / "parts/deep.py")) << "the modules that the planner imports are kept, too";
  fs::remove_all(dir() / "mine");
  EXPECT_NE(again(spec(":Orbit:x=1"), flown).find(kept.string()), std::string::npos);
}

TEST_F(PythonPlanners, FleetsWithoutPythonAreNotChanged) {
  EXPECT_EQ(kept({{"jurong", "hover"}}), Json::array());
  EXPECT_FALSE(fs::exists(dir() / "run"));
  EXPECT_EQ(again("kios:x=1,y=2", Json::object()), "kios:x=1,y=2");
}

}  // namespace
}  // namespace skein::cli

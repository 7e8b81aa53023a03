// The wrapper ./skein in a small artificial tree, whose build tool and launcher only record their arguments: which
// targets it builds for a command, and which arguments reach the launcher.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/text_files.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text, bool executable = false) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
  if (executable) fs::permissions(file, fs::perms::owner_all);
}

class Wrapper : public testing::Test {
 protected:
  struct Outcome {
    int code = 0;
    std::string targets, words, errors;
  };

  void SetUp() override {
    fs::copy_file(source_path("skein"), root_ / "skein");
    // All packages are installed; no target is up to date; ninja records its arguments.
    write(root_ / "bin/dpkg-query", "#!/bin/sh\nshift 3\nfor package in \"$@\"; do echo $package installed; done\n",
          true);
    write(root_ / "bin/ninja",
          "#!/bin/sh\ncase \" $* \" in *' -n '*|*' build.ninja '*) exit 0 ;; esac\n"
          "shift 2\necho \"$*\" >" +
              (root_ / "targets").string() + "\n",
          true);
    write(root_ / "build/release/build.ninja", "");
    write(root_ / "build/release/CMakeCache.txt", "BUILD_TESTING:BOOL=ON\n");
    write(root_ / "build/release/test_folders.txt", "tests\ntests/fleet\ncore\n");
    write(root_ / "build/release/bin/skein", "#!/bin/sh\necho \"$*\" >" + (root_ / "words").string() + "\n", true);
    write(root_ / "build/pcl/there", "");
    write(root_ / "web/src/live.js", "");
    write(root_ / "web/package-lock.json", "");
    write(root_ / "build/web/report.js", "");
    write(root_ / "build/web/live.js", "");
  }

  Outcome run(const std::string& words) {
    fs::remove(root_ / "targets");
    fs::remove(root_ / "words");
    const std::string command = "PATH='" + (root_ / "bin").string() + "':\"$PATH\" SKEIN_TURN=1 '" +
                                (root_ / "skein").string() + "' " + words + " 2>'" + (root_ / "errors").string() + "'";
    const int status = std::system(command.c_str());
    const auto line = [&](const char* file) {
      const std::string text = read_text(root_ / file);
      return text.substr(0, text.find('\n'));
    };
    return {WEXITSTATUS(status), line("targets"), line("words"), read_text(root_ / "errors")};
  }

  const ScratchFolder scratch_;
  const fs::path& root_ = scratch_.path();
};

TEST_F(Wrapper, BuildsWhatACommandNeedsAndPassesItsArgumentsOn) {
  struct Case {
    std::string words, targets, handed_on;
  };
  const std::vector<Case> cases = {
      {"run towers --planner kios", "programs", "run towers --planner kios"},
      {"bench --quick", "bench", "bench --quick"},
      {"test", "all", "test"},
      {"test --long", "all long_tests", "test --long"},
      {"test --help", "programs", "test --help"},
      {"test core tests/fleet/", "skein tests_in_core tests_in_tests_fleet", "test"},
      {"test --faults mine.yaml", "programs", "test --faults mine.yaml"},
      {"test --faults=mine.yaml", "programs", "test --faults=mine.yaml"},
      {"test --jobs 2 --faults mine.yaml", "programs", "test --jobs 2 --faults mine.yaml"},
      {"test --faults mine.yaml --long", "programs", "test --faults mine.yaml --long"},
  };
  for (const Case& c : cases) {
    const Outcome outcome = run(c.words);
    EXPECT_EQ(outcome.code, 0) << c.words << ": " << outcome.errors;
    EXPECT_EQ(outcome.targets, c.targets) << c.words;
    EXPECT_EQ(outcome.words.substr(0, c.handed_on.size()), c.handed_on) << c.words;
  }
}

// A user's first report must be interactive, so the wrapper builds the script of pages before the flight.
TEST_F(Wrapper, BuildsTheScriptOfReportsBeforeTheFirstReport) {
  write(root_ / "bin/node", "#!/bin/sh\n", true);
  const std::string script = (root_ / "build/web/report.js").string(), answer = (root_ / "words").string();
  write(root_ / "build/release/bin/skein", "#!/bin/sh\n[ -f " + script + " ] && echo there >" + answer + "\n", true);
  const auto with_npm = [&](const std::string& build) {
    write(root_ / "bin/npm", "#!/bin/sh\n[ \"$1\" = ci ] || { " + build + "; }\n", true);
    fs::remove(script);
    fs::remove(root_ / "build/web/failed");
  };
  for (const std::string words : {"run", "run towers --planner kios", "compare --seeds 1", "contest", "merge there"}) {
    with_npm("touch ../build/web/report.js");
    EXPECT_EQ(run(words).words, "there") << words;
  }
  for (const std::string words : {"check a.yaml", "run --help", "run towers --no-report"}) {
    with_npm("touch ../build/web/report.js");
    EXPECT_EQ(run(words).words, "") << words;
  }
  with_npm("exit 1");
  const Outcome without = run("run towers");
  EXPECT_EQ(without.words, "");
  EXPECT_NE(without.targets, "") << "the flight needs other targets, even if the script cannot be built";
  EXPECT_NE(without.errors.find("build.log"), std::string::npos) << without.errors;
}

TEST_F(Wrapper, RefusesAFolderWithoutTests) {
  const Outcome outcome = run("test tests/nowhere");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.errors.find("no tests in a folder 'tests/nowhere'"), std::string::npos) << outcome.errors;
  EXPECT_EQ(outcome.words, "");
}

}  // namespace
}  // namespace skein::test

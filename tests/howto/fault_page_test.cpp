// docs/how-to-test-faults.md, followed word for word: the files that it shows are written, the commands that it shows
// are run, and what they print must be what it shows.
#include <fstream>
#include <sstream>

#include "fleet_fixture.hpp"
#include "report/testing/xml_check.hpp"
#include "results_page.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::minutes kPatience{10};

/// A fenced block of a page: ```yaml my_tests/outage.yaml
struct Block {
  std::string language, name, text;
};

std::vector<Block> blocks_of(const fs::path& page) {
  std::ifstream in(page);
  std::vector<Block> blocks;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("```")) {
      if (inside) blocks.back().text += line + "\n";
      continue;
    }
    inside = !inside;
    if (!inside) continue;
    const std::size_t space = std::min(line.find(' '), line.size());
    blocks.push_back({line.substr(3, space - 3), line.substr(std::min(space + 1, line.size())), ""});
  }
  return blocks;
}

/// Whether two texts are the same, where "..." in the first stands for anything within a line.
bool matches(const std::string& shown, const std::string& printed) {
  std::istringstream a(shown), b(printed);
  for (std::string want, have;;) {
    const bool more = static_cast<bool>(std::getline(a, want));
    if (more != static_cast<bool>(std::getline(b, have))) return false;
    if (!more) return true;
    const std::size_t gap = want.find("...");
    const bool same = gap == std::string::npos
                          ? want == have
                          : have.starts_with(want.substr(0, gap)) && have.ends_with(want.substr(gap + 3)) &&
                                have.size() + 3 >= want.size();
    if (!same) return false;
  }
}

class FaultPage : public FleetTest {
 protected:
  /// The page is followed in a folder with `./skein` in it, and the agent of the other page.
  void SetUp() override {
    fs::create_directories(folder() / "build");
    fs::create_symlink(program("skein"), folder() / "skein");
    fs::create_symlink(helper_program("howto_agent"), folder() / "build" / "my_agent");
  }

  /// @returns what it printed.
  std::string typed(const std::string& command) {
    const std::string name = "typed-" + std::to_string(++commands_);
    ChildProcess shell({"/bin/sh", "-c", "cd " + folder().string() + " && " + command}, {}, folder() / (name + ".out"),
                       folder() / (name + ".err"));
    EXPECT_TRUE(eventually([&] { return shell.ended().has_value(); }, kPatience)) << command;
    errors_ += shell.err();
    return shell.out();
  }

  /// `$ command` and what it prints, until the next one.
  void follow(const Block& console) {
    std::istringstream lines(console.text);
    std::string command, shown;
    const auto run = [&] {
      if (command.empty()) return;
      const std::string printed = typed(command);
      EXPECT_TRUE(matches(shown, printed)) << "$ " << command << "\nthe page shows:\n"
                                           << shown << "it prints:\n"
                                           << printed << errors_;
    };
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("$ ")) {
        run();
        command = line.substr(2);
        shown.clear();
      } else {
        shown += line + "\n";
      }
    }
    run();
  }

  int commands_ = 0;
  std::string errors_;
};

TEST_F(FaultPage, DoesWhatItSays) {
  std::size_t followed = 0;
  for (const Block& block : blocks_of(source_path("docs/how-to-test-faults.md"))) {
    if (!block.name.empty()) {
      const fs::path file = folder() / block.name;
      fs::create_directories(file.parent_path());
      std::ofstream(file) << block.text;
    }
    if (block.language == "console") {
      follow(block);
      ++followed;
    }
  }
  EXPECT_GE(followed, 6u);
  for (const auto& run : fs::directory_iterator(folder() / "runs" / "faults")) expect_documented_columns(run.path());
  const std::string report = text_of(folder() / "faults.xml");  // the page's CI job
  ASSERT_FALSE(report.empty());
  const auto elements = report::xml_elements(report);
  EXPECT_EQ(elements.front().name, "testsuites");
  EXPECT_EQ(elements.front().attributes.at("failures"), "0");
  EXPECT_EQ(std::count_if(elements.begin(), elements.end(), [](const auto& e) { return e.name == "testcase"; }), 4);
}

TEST_F(FaultPage, NothingIsSaidOfAFolderThatCannotBeTested) {
  fs::create_directories(folder() / "empty");
  for (const auto& [arguments, words] : std::vector<std::pair<std::string, std::string>>{
           {"--faults empty", "there is no fault test"},
           {"--faults none.yaml", "there is no such file or folder"},
           {"--faults " + source_path("config/faults/dead_camera.yaml --seeds 5-1"), "seed"},
           {"--faults " + source_path("config/faults/dead_camera.yaml --junit none/faults.xml"), "--junit"},
           {"--faults " + source_path("config/faults/dead_camera.yaml --agent none"), "--agent"}}) {
    errors_.clear();
    EXPECT_EQ(typed("./skein test " + arguments + "; echo $?"), "2\n") << arguments;
    EXPECT_NE(errors_.find(words), std::string::npos) << arguments << "\n" << errors_;
  }
}

}  // namespace
}  // namespace skein::test

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "page_test.hpp"
#include "tests/support/places.hpp"

namespace skein::test {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::minutes kPagesPatience{10};
/// Mission time of flights whose command gives none [s].
constexpr const char* kBriefly = "3";

/// Names of the processes whose working directory is in a folder.
std::vector<std::string> processes_in(const fs::path& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (fs::directory_iterator it("/proc", ignored), end; it != end; it.increment(ignored)) {
    const fs::path place = fs::read_symlink(it->path() / "cwd", ignored);
    if (place.string().starts_with(folder.string())) found.push_back(text_of(it->path() / "comm"));
  }
  return found;
}

/// The commands of a console block, each with the output that the page shows.
std::vector<std::pair<std::string, std::string>> commands_of(const PageBlock& console) {
  std::vector<std::pair<std::string, std::string>> commands;
  std::istringstream lines(console.text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$ ")) {
      commands.emplace_back(line.substr(2), "");
    } else if (commands.empty()) {
      throw std::runtime_error("line " + std::to_string(console.line) + ": a console begins with `$ command`");
    } else {
      commands.back().second += line + "\n";
    }
  }
  return commands;
}

}  // namespace

std::string PageBlock::note(const std::string& kind) const {
  for (const auto& [known, text] : notes) {
    if (known == kind) return text;
  }
  return "";
}

int PageBlock::exit_code() const {
  const std::string stated = note("exits with");
  return stated.empty() ? 0 : std::stoi(stated);
}

std::vector<std::string> all_pages() {
  std::vector<std::string> pages = {"README.md"};
  for (const auto& entry : fs::directory_iterator(source_path("docs"))) {
    if (entry.path().extension() == ".md") pages.push_back("docs/" + entry.path().filename().string());
  }
  std::ranges::sort(pages);
  return pages;
}

std::vector<PageBlock> blocks_of(const fs::path& page) {
  static const std::regex kNote(R"(<!-- (not run|given|with|exits with|chapter): (.+) -->)");
  std::ifstream in(page);
  std::vector<PageBlock> blocks;
  std::vector<std::pair<std::string, std::string>> notes;
  bool inside = false;
  int number = 0;
  std::smatch match;
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(page.string() + ":" + std::to_string(number) + ": " + why);
  };
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with("```")) {
      inside = !inside;
      if (!inside) continue;
      const std::size_t space = std::min(line.find(' '), line.size());
      blocks.push_back({line.substr(3, space - 3), line.substr(std::min(space + 1, line.size())), "", number + 1,
                        std::exchange(notes, {})});
    } else if (inside) {
      blocks.back().text += line + "\n";
    } else if (std::regex_match(line, match, kNote)) {
      notes.emplace_back(match[1], match[2]);
    } else if (line.starts_with("<!--")) {
      fail("no test knows what this comment says: " + line);
    } else if (!line.empty() && !notes.empty()) {
      fail("no block follows the comment before this line");
    }
  }
  return blocks;
}

bool matches(const std::string& shown, const std::string& printed) {
  std::istringstream a(shown), b(printed);
  for (std::string want, have;;) {
    const bool more = static_cast<bool>(std::getline(a, want));
    if (more && want == "...") return true;
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

PageTest::PageTest() : checkout_(folder() / "checkout") {
  fs::create_directories(checkout_ / "build");
  fs::create_symlink(program("skein"), checkout_ / "skein");
  fs::create_directory_symlink(build_path(), checkout_ / "build" / "release");
  for (const char* name : {"config", "docker", "python", "tests"})
    fs::create_directory_symlink(source_path(name), checkout_ / name);
  fs::create_directories(folder() / "bin");
  fs::create_symlink(python_program(), folder() / "bin" / "python3");
}

std::string PageTest::typed(const std::string& commands, int exit_code, const Environment& environment) {
  const std::string name = "typed-" + std::to_string(++commands_);
  const fs::path script = write(name + ".sh", commands + "\n");
  // The test's environment must not tell the reader's commands where the programs or their configuration are.
  const std::string line =
      "unset SKEIN SKEIN_CONFIG_DIR SKEIN_BIN_DIR SKEIN_ASSETS SKEIN_GOLDEN SKEIN_CHAOS SKEIN_LOG SKEIN_NETWORK; "
      "cd '" +
      checkout_.string() + "' && exec sh -e '" + script.string() + "' </dev/null";
  Environment all = environment;
  all.try_emplace("SKEIN_DURATION", kBriefly);
  all.try_emplace("SKEIN_AGENT", "");
  all.try_emplace("XDG_CACHE_HOME", folder() / "cache");
  all.try_emplace("PATH", build_path("bin:") + (folder() / "bin").string() + ":" + std::getenv("PATH"));
  all.try_emplace("PYTHONDONTWRITEBYTECODE", "1");  // else Python would write compiled files into the source tree
  all.try_emplace("MPLBACKEND", "Agg");
  ChildProcess shell({"/bin/sh", "-c", line}, all, folder() / (name + ".out"), folder() / (name + ".err"));
  const bool over = eventually([&] { return shell.ended().has_value(); }, kPagesPatience);
  EXPECT_TRUE(over) << "these commands have not ended in time:\n" << commands;
  if (over) {
    EXPECT_EQ(shell.ended()->code, exit_code) << commands << "\n" << shell.out() << shell.err();
    std::vector<std::string> left;
    EXPECT_TRUE(eventually([&] { return (left = processes_in(folder())).empty(); }, std::chrono::seconds(20)))
        << commands << "\nhave left a process: " << left.front();
  }
  errors_ = shell.err();
  return shell.out();
}

void PageTest::give_agent(const fs::path& file) const {
  fs::create_directories(file.parent_path());
  for (const char* kind : {"", "_fleet"}) {
    // A copy: two links to one program would be the same planner twice in a study.
    fs::copy_file(helper_program(std::string("howto_agent") + kind), file.string() + kind);
  }
}

/// Provides the files that the block's notes name. @returns false when this machine lacks one of them.
bool PageTest::give(const PageBlock& block) {
  static const std::regex kGiven(R"((\S+) is (an agent|a program|the data files|the script))");
  for (const auto& [kind, text] : block.notes) {
    if (kind != "given") continue;
    std::smatch match;
    if (!std::regex_match(text, match, kGiven))
      throw std::runtime_error("this note names an unknown kind of file: " + text);
    const fs::path file = checkout_ / match.str(1);
    const char* const assets = std::getenv("SKEIN_ASSETS");
    if (match[2] == "the data files" && assets == nullptr) return false;
    if (match[2] == "the script") {
      if (!fs::exists(source_path(match.str(1)))) return false;
      continue;
    }
    if (fs::exists(fs::symlink_status(file))) continue;
    if (match[2] == "an agent") {
      give_agent(file);
      continue;
    }
    fs::create_directories(file.parent_path());
    fs::create_symlink(match[2] == "a program" ? fs::path(helper_program("minimal_client")) : fs::path(assets), file);
  }
  return true;
}

bool PageTest::follow(const PageBlock& block) {
  if (block.is_file()) {
    fs::create_directories((checkout_ / block.name).parent_path());
    std::ofstream(checkout_ / block.name) << block.text;
    return true;
  }
  if (!block.is_run() || !give(block)) return false;
  if (block.is_python()) {
    python_ += "# line " + std::to_string(block.line) + " of the page\n" + block.text;
    return true;
  }
  run_python();
  if (block.language == "console") {
    follow_console(block, [](int) { return true; });
    return true;
  }
  Environment environment;
  for (const auto& [kind, text] : block.notes) {
    if (kind == "with") environment[text.substr(0, text.find('='))] = text.substr(text.find('=') + 1);
  }
  typed(block.text, block.exit_code(), environment);
  return true;
}

void PageTest::run_python() {
  if (python_.empty()) return;
  const fs::path script = write("noted-" + std::to_string(commands_ + 1) + ".py", std::exchange(python_, {}));
  typed("python3 '" + script.string() + "'", 0, {{"PYTHONPATH", checkout_ / "python"}});
}

void PageTest::follow_console(const PageBlock& block, const std::function<bool(int)>& chosen) {
  const auto commands = commands_of(block);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (!chosen(static_cast<int>(i))) continue;
    const auto& [command, shown] = commands[i];
    const bool is_last = i + 1 == commands.size();
    const std::string printed = typed(command, is_last ? block.exit_code() : 0);
    EXPECT_TRUE(matches(shown, printed)) << "$ " << command << "\nthe page shows:\n"
                                         << shown << "it prints:\n"
                                         << printed << errors_;
  }
}

}  // namespace skein::test

// The commands that our pages show are commands.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "cli/options.hpp"
#include "core/text.hpp"
#include "core/types.hpp"
#include "tests/support/places.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pages() {
  const fs::path root = source_path();
  std::vector<fs::path> files = {root / "README.md", root / "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  return files;
}

/// What stands in blocks of a page after "./skein", without comments and what a shell would do with it.
std::vector<std::string> commands_of(const fs::path& page) {
  static const std::regex kCommand(R"(^\s*(?:\$ )?\./skein (.*))"), kRest(R"(\s+(#|&$|<|\d?>|\||\\$).*)");
  std::vector<std::string> commands;
  std::ifstream in(page);
  bool in_block = false;
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) in_block = !in_block;
    if (in_block && std::regex_match(line, match, kCommand)) {
      commands.push_back(std::regex_replace(match.str(1), kRest, ""));
    }
  }
  return commands;
}

TEST(Pages, ShowCommandsThatThereAre) {
  std::size_t read = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& command : commands_of(page)) {
      const bool is_shown_as_a_form = command.find("...") != std::string::npos;
      if (is_shown_as_a_form || command.starts_with("test --sanitize")) continue;  // ./skein's own
      EXPECT_NO_THROW(parse_command_line(shell_words(command))) << page << ": skein " << command;
      ++read;
    }
  }
  EXPECT_GT(read, 80u);
}

}  // namespace
}  // namespace skein::cli

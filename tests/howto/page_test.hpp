// Reads the commands that a documentation page tells its reader to type, and types them in a scratch folder.
//
// ```sh blocks hold commands; ```console blocks hold `$ command` lines with the output of each, where "..." stands for
// anything within a line, and a line "..." for all that follows. Successive ```python blocks without commands between
// them are one program. A block with a file's name after its language is that file. HTML comments before a block, which
// readers do not see, are notes for the test:
//   <!-- not run: needs docker -->               the block is only to be read, and why
//   <!-- given: build/my_agent is an agent -->   a file that the reader already has: an agent (with `orbit`), a program
//                                                (that flies a UAV), the data files (of CARIC), or the script (of web/,
//                                                built by npm); without the last two the block is left out
//   <!-- with: SKEIN_DURATION=60 -->             a variable that is set for the block
//   <!-- exits with: 1 -->                       exit code of the block, or of a console's last command; else 0
//   <!-- chapter: faults -->                     belongs to no block: a new test begins here, in another folder
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fleet_fixture.hpp"

namespace skein::test {

struct PageBlock {
  std::string language = {}, name = {}, text = {};
  int line = 0;                                                 ///< line number of its first line in the page
  std::vector<std::pair<std::string, std::string>> notes = {};  ///< kind and text of the notes before the block

  bool is_file() const { return !name.empty(); }
  bool is_python() const { return !is_file() && language == "python"; }
  bool is_typed() const { return !is_file() && (language == "sh" || language == "console" || is_python()); }
  bool is_run() const { return is_typed() && note("not run").empty(); }
  /// Text of the first note of that kind; empty: there is none.
  std::string note(const std::string& kind) const;
  /// Expected exit code of the block, or of a console's last command.
  int exit_code() const;
};

/// Paths of README.md and all pages in docs/, relative to the root.
std::vector<std::string> all_pages();

/// @throws std::runtime_error when a note precedes no block, or is of an unknown kind.
std::vector<PageBlock> blocks_of(const std::filesystem::path& page);

/// Whether the printed text is the shown one, in which "..." stands for anything.
bool matches(const std::string& shown, const std::string& printed);

class PageTest : public FleetTest {
 protected:
  /// Makes the reader's folder: a checkout with the programs of this build, both as `./skein` and as an installed
  /// `skein`. `python3` is Debian's, and finds the checkout's package.
  PageTest();

  const std::filesystem::path& checkout() const { return checkout_; }
  /// The stderr of the commands that typed() executed last.
  const std::string& errors() const { return errors_; }

  /// Puts the agent of how-to-add-a-planner.md at `file`, as a reader's build would.
  void give_agent(const std::filesystem::path& file) const;
  /// Runs commands in the checkout by `sh -e`, with an empty stdin. They must leave no process. @returns their stdout.
  std::string typed(const std::string& commands, int exit_code = 0, const Environment& environment = {});
  /// Writes the block's file, or types its commands; only collects Python.
  /// @returns false when the block is only to be read, or this machine lacks a given file.
  bool follow(const PageBlock& block);
  /// Runs the Python that was collected since the last commands.
  void run_python();
  /// Types the commands of a console block and compares their output with the page.
  /// @param chosen  says whether the command of this number, from 0, is typed
  void follow_console(const PageBlock& block, const std::function<bool(int)>& chosen);

 private:
  bool give(const PageBlock& block);

  const std::filesystem::path checkout_;
  std::string errors_, python_;
  int commands_ = 0;
};

}  // namespace skein::test

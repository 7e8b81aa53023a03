// What a page tells its reader to type, and a folder in which that is typed.
//
// Blocks of commands are ```sh; ```console has `$ command` with what it prints, where "..." stands for anything within
// a line, and a line "..." for all that follows. ```python blocks are one program, as far as no commands stand between
// them. A block with a file's name behind its language is that file. Comments
// that readers do not see, before a block, say what the test has to know of it:
//   <!-- not run: needs docker -->               only to be read, and why
//   <!-- given: build/my_agent is an agent -->   what its reader has: an agent (with `orbit`), a program (that flies a
//                                                UAV), the data files (of CARIC; without them the block is left out),
//                                                the script (of web/, which npm builds; likewise)
//   <!-- with: SKEIN_DURATION=60 -->             a variable that is set for it
//   <!-- exits with: 1 -->                       code of the block, or of a console's last command; else 0
//   <!-- chapter: faults -->                     stands for itself: a test of its own begins here, in another folder
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fleet_fixture.hpp"

namespace skein::test {

struct PageBlock {
  std::string language = {}, name = {}, text = {};
  int line = 0;                                                 ///< of its first line, in its page
  std::vector<std::pair<std::string, std::string>> notes = {};  ///< the comments before it

  bool is_file() const { return !name.empty(); }
  bool is_python() const { return !is_file() && language == "python"; }
  bool is_typed() const { return !is_file() && (language == "sh" || language == "console" || is_python()); }
  bool is_run() const { return is_typed() && note("not run").empty(); }
  /// Of the first note of that kind; empty: there is none.
  std::string note(const std::string& kind) const;
  /// Of the block, or of a console's last command.
  int exit_code() const;
};

/// README.md and all of docs/, below the root.
std::vector<std::string> all_pages();

/// @throws std::runtime_error when a note has no block, or says what no test knows.
std::vector<PageBlock> blocks_of(const std::filesystem::path& page);

/// Whether two texts are the same, as far as "..." in the first lets them differ.
bool matches(const std::string& shown, const std::string& printed);

class PageTest : public FleetTest {
 protected:
  /// The reader's folder: a checkout, with the programs of this build as `./skein`, and as an installed `skein`, too.
  /// `python3` is Debian's, and finds the checkout's package.
  PageTest();

  const std::filesystem::path& checkout() const { return checkout_; }
  /// What the last commands said on their standard error.
  const std::string& errors() const { return errors_; }

  /// The agent of how-to-add-a-planner.md under another name, as a build of it is.
  void give_agent(const std::filesystem::path& file) const;
  /// In the checkout, by `sh -e`, with nothing to read. Nothing of it may run on. @returns what it printed.
  std::string typed(const std::string& commands, int exit_code = 0, const Environment& environment = {});
  /// Writes its file, or types it; Python is only noted. @returns false when it is only to be read.
  bool follow(const PageBlock& block);
  /// Runs the Python that was noted since the last commands.
  void run_python();
  /// `$ command` and what it prints, until the next one. @param chosen  by its number: whether it is typed
  void follow_console(const PageBlock& block, const std::function<bool(int)>& chosen);

 private:
  bool give(const PageBlock& block);

  const std::filesystem::path checkout_;
  std::string errors_, python_;
  int commands_ = 0;
};

}  // namespace skein::test

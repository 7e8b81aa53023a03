// Rules for the source tree. Each rule returns its violations as "path:line: what is wrong", sorted by path; an empty
// list is a pass. The architecture behind the rules: docs/architecture.md.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/layers/source_tree.hpp"

namespace skein::layers {

using Tree = std::vector<SourceFile>;
using Violations = std::vector<std::string>;

/// core <- process, idl, recording/mcap, signals/properties, sight <- results, oracle <- bus, host, report, scenes,
/// signals <- debug, view, recording <- run <- applications <- one_process. No application includes another, and only
/// the launcher includes host, debug and run.
/// tests/ may include everything, and only test code may include tests/.
Violations check_layers(const Tree& tree);

/// Inside an application, and in scenes/, includes between folders form no cycle, neither directly nor through other
/// folders. A file beside the folders (its header and source together) counts as a folder of its own.
Violations check_circles(const Tree& tree);

/// In an application only main.cpp, *_node.* and *_program.* include bus/, and no other file includes their headers. No
/// file of host, debug and run includes bus/.
Violations check_bus_users(const Tree& tree);

/// Only bus/<vendor>/ includes a DDS vendor's headers; tests/ may use raw DDS, to check Skein from outside.
Violations check_dds_headers(const Tree& tree);

/// Only few .cpp files, in the folders named here, include a large library. Headers include it only if the library has
/// a folder of its own.
struct LibraryRule {
  std::string name;
  std::vector<std::string> prefixes;  ///< of the included paths: "pcl/"
  std::vector<std::string> folders;   ///< "uav_agent/", "scenes/files/"
  std::size_t most_files = 1;         ///< in each of these folders
  bool own_folder = false;            ///< headers in `folders` may include the library
};
/// The rules of this project.
const std::vector<LibraryRule>& library_rules();
Violations check_libraries(const Tree& tree, const std::vector<LibraryRule>& rules);

/// #pragma once, no `using namespace`.
Violations check_headers(const Tree& tree);

/// No printf and no std::cout, except in cli/, main.cpp, *_program.cpp, *_tasks.cpp and tests.
Violations check_printing(const Tree& tree);

/// No code sleeps in order to wait for other threads or processes. Helpers under tests/ may poll other processes.
Violations check_sleeping(const Tree& tree);

/// Tests do not read the clock: they wait for conditions with tests/support/eventually.hpp.
Violations check_clocks(const Tree& tree);

/// No file of C++, Python or JavaScript has more than `most_lines`.
Violations check_length(const Tree& tree, std::size_t most_lines = 400);

/// A function that may be longer than others.
struct LongFunction {
  std::string path, name;  ///< "cli/run_command.cpp", "add_run"
  std::string why;
};
/// The list of this project.
const std::vector<LongFunction>& long_functions();
/// The body of no function of C++, Python or JavaScript has more than `most_lines`, except those in `known`, each of
/// which must have more, and those of tests.
Violations check_functions(const Tree& tree, const std::vector<LongFunction>& known, std::size_t most_lines = 60);

/// Numbers in uav_agent/ say where they come from: each constant, each default of a member, and each other number,
/// apart from 0, 0.5, 1, 2, the number of axes, and bits and indices. The comment in its line, or right above its
/// statement, has one of the words chosen, measured, formula, geometry, vehicle, sensor, rounding, numeric, format and
/// memory. docs/flight-core.md has the sources of the parameters in FlightConfig. The limits of parameters need none: a
/// line with `r.field(` is left out.
Violations check_sources(const Tree& tree);

/// No line of C++, Python, CMake, shell or Markdown has more than `most_columns`, except lines inside a string literal,
/// and code, tables and images of Markdown.
Violations check_columns(const Tree& tree, std::size_t most_columns = 120);

/// No marks of unfinished work.
Violations check_marks(const Tree& tree);

/// No text file contains a path of a particular machine. docker/ may name paths inside a container.
Violations check_machine_paths(const Tree& tree);

/// Files that comments of C++ files, docs/, README.md and CONTRIBUTING.md name exist: those with a folder of the tree
/// ("docs/lockstep.md"), C++ files in any folder ("flight/site.hpp"), headers by their names alone ("tours.hpp"), and
/// in comments also other C++ files by their names alone; ".*" means any ending. A page may also name the files that it
/// tells its reader to write: its code blocks with a name.
Violations check_references(const Tree& tree);

/// Tests that pages name in backquotes exist: `Suite.Test`, or `Suite.Begin...` for those whose names begin so. Left
/// out are names whose suite does not exist, and names that the page calls former ones: behind them stands "(gone)" or
/// "(now ...)".
Violations check_named_tests(const Tree& tree);

/// Only results/run_folder.hpp names the files of a run's folder; tests may, too.
Violations check_run_files(const Tree& tree);

/// Each decision is one page, of at most `most_lines` lines. It has the sections Context, Decision, Consequences and
/// Alternatives, unless another one supersedes it as a whole.
Violations check_decisions(const Tree& tree, std::size_t most_lines = 60);

/// No test has a name that begins with Who, What, Nobody, Somebody or a form of these words: such a name does not say
/// which part of Skein the test is about.
Violations check_test_names(const Tree& tree);

/// No build products and no large files among `tracked` (paths below the root).
Violations check_tracked_files(const std::filesystem::path& root, const std::vector<std::string>& tracked,
                               std::uintmax_t most_bytes = 1'500'000);

/// What git tracks below `root`; nullopt without git or a repository.
std::optional<std::vector<std::string>> tracked_files(const std::filesystem::path& root);

}  // namespace skein::layers

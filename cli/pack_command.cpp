#include "cli/pack_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "core/config/config_files.hpp"
#include "core/files/file_bytes.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "host/supervisor.hpp"
#include "process/files/atomic_file.hpp"
#include "process/host/environment.hpp"
#include "process/program.hpp"
#include "report/web_bundle.hpp"
#include "results/run_folder.hpp"
#include "run/fleet_plan.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;
using report::find_web_bundle;

constexpr std::size_t kLastLines = 3;
constexpr std::uintmax_t kMostOfAList = 16 << 20, kMostOfAFile = std::uintmax_t{4} << 30;

/// The script that starts the packed skein. It uses the libraries beside it, including the system's own: another libm
/// would give another flight.
constexpr const char* kLauncher = R"sh(#!/bin/sh
# Skein with its libraries: from wherever this folder is, and whatever is installed there.
here=$(cd "$(dirname "$(readlink -f "$0")")" && pwd)
export SKEIN_LAUNCHER="$here/skein" SKEIN_LOADER="$here/lib/{0}" SKEIN_BIN_DIR="$here/bin"
export SKEIN_CONFIG_DIR="$here/share/skein/config" SKEIN_WEB="$here/share/skein/web/report.js"
export PYTHONPATH="$here/share/skein/python${{PYTHONPATH:+:$PYTHONPATH}}"
exec "$SKEIN_LOADER" --library-path "$here/lib" --argv0 skein "$here/bin/skein" "$@"
)sh";

/// Runs a tool to its end. @returns what is wrong; empty: nothing. @param log  where its output goes
std::string trouble_of(const std::string& tool, const std::vector<std::string>& argv, const fs::path& log) {
  const ExitStatus exit = run_to_end({"pack", argv, environment_with({{"LC_ALL", "C"}}), log});
  return exit.ok() ? "" : tool + " ended with " + exit.text() + ":" + last_lines_below(log, kLastLines);
}

/// The output of ldd for a program, and a last line from echo. Unlike ldd, echo fails if its output is lost, as on a
/// full disk; so the last line shows that the list is complete.
std::string list_of_libraries(const fs::path& program) {
  const ScratchDir scratch;
  const fs::path log = scratch.path() / "log";
  const std::string end = "end of list\n";
  const std::string trouble =
      trouble_of("ldd", {"/bin/sh", "-c", "ldd \"$1\" && echo end of list", "sh", program}, log);
  if (!trouble.empty()) throw InputError(program.string() + ": its libraries cannot be listed: " + trouble);
  std::string list = read_file_bytes(log, kMostOfAList);
  if (!list.ends_with(end)) throw std::runtime_error(log.string() + ": could not be written; is the disk full?");
  list.resize(list.size() - end.size());
  return list;
}

/// Adds a program's libraries by the names under which it asks for them, including the loader.
void add_libraries(const fs::path& program, std::map<std::string, fs::path>& libraries, std::string& loader) {
  std::istringstream lines(list_of_libraries(program));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, arrow, file;
    words >> name >> arrow >> file;
    if (name.starts_with("/")) {
      loader = fs::path(name).filename();
      libraries[loader] = name;
    } else if (arrow == "=>") {
      if (file == "not") throw InputError(program.string() + " needs " + name + ", which is not here");
      libraries[name] = file;
    }
  }
}

/// The modules that run planners and programs in Python; empty if Skein was built or installed without Python.
std::vector<fs::path> python_modules() {
  std::vector<fs::path> modules;
  for (const char* name : {"libskein_python.so", "_skein_client.so"}) {
    for (const fs::path& folder : {program_dir(), program_dir() / "../lib/skein"}) {
      if (!fs::is_regular_file(folder / name)) continue;
      modules.push_back(folder / name);
      break;
    }
  }
  return modules;
}

/// The package `skein`, of this checkout or as installed.
std::optional<fs::path> python_package() {
  for (const fs::path& folder :
       {default_config_dir() / "../python/skein", default_config_dir() / "../../../lib/python3/dist-packages/skein"}) {
    if (fs::is_regular_file(folder / "planner.py")) return folder;
  }
  return std::nullopt;
}

/// Copies a file with its permissions. On a full disk, fs::copy() would name the wrong file, and give no reason.
void pack_file(const fs::path& from, const fs::path& to) {
  fs::create_directories(to.parent_path());
  write_file_atomically(to, read_file_bytes(from, kMostOfAFile), Readers::all, Flush::none);
  fs::permissions(to, fs::status(from).permissions());
}

/// Copies the files of a folder, but not .pyc files, which are for this machine's interpreter.
void pack_folder(const fs::path& from, const fs::path& to) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(from)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".pyc") continue;
    pack_file(entry.path(), to / entry.path().lexically_relative(from));
  }
}

/// The archive while it is being made: a folder with its parts, and a temporary file. Removes both, first what an
/// earlier call left, and in the end its own.
struct Unfinished {
  explicit Unfinished(const fs::path& archive)
      : file(archive.string() + ".tmp"), parts(archive.parent_path() / (archive.filename().string() + ".parts")) {
    remove();
  }
  ~Unfinished() { remove(); }

  const fs::path file, parts;

 private:
  void remove() const {
    std::error_code ignored;
    fs::remove(file, ignored);
    fs::remove_all(parts, ignored);
  }
};

/// @throws InputError if no archive can be made there, or if the name promises another kind of archive.
void check_target(const fs::path& archive) {
  std::error_code none;
  const fs::file_status status = fs::status(archive, none);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InputError(archive.string() + ": is " + (fs::is_directory(status) ? "a folder" : "no file") +
                     "; name the archive, as skein.tar.gz");
  }
  if (archive.filename().empty()) throw InputError(archive.string() + ": name the archive, as skein.tar.gz");
  const std::string name = archive.filename();
  if (!name.ends_with(".tar.gz") && !name.ends_with(".tgz")) {
    throw InputError(archive.string() + ": the archive is a compressed tar file; let its name end in .tar.gz or .tgz");
  }
  const fs::path folder = archive.parent_path();
  if (!fs::is_directory(folder, none) && fs::exists(folder, none)) {
    throw InputError(folder.string() + ": is not a folder, so no archive can be made in it");
  }
}

/// What goes into the archive.
struct Contents {
  std::vector<fs::path> files;  ///< programs, and modules for Python
  std::map<std::string, fs::path> libraries;
  std::string loader;
  std::optional<fs::path> package;  ///< for Python
};

/// @throws std::system_error with the archive's name if the disk is full; std::runtime_error if tar fails.
void write_archive(const fs::path& archive, const Contents& contents) try {
  const Unfinished unfinished(archive);
  const fs::path pack = unfinished.parts / "skein";
  for (const fs::path& file : contents.files) pack_file(fs::canonical(file), pack / "bin" / file.filename());
  for (const auto& [name, file] : contents.libraries) pack_file(fs::canonical(file), pack / "lib" / name);
  pack_folder(default_config_dir(), pack / "share/skein/config");
  if (const auto script = find_web_bundle(report::kReportScript))
    pack_file(*script, pack / "share/skein/web/report.js");
  if (const auto script = find_web_bundle(report::kLiveScript)) pack_file(*script, pack / "share/skein/web/live.js");
  if (contents.package) pack_folder(*contents.package, pack / "share/skein/python/skein");
  write_file_atomically(pack / "skein", fmt::format(fmt::runtime(kLauncher), contents.loader));
  fs::permissions(pack / "skein", fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                                      fs::perms::others_read | fs::perms::others_exec);
  const ScratchDir scratch;
  const std::string trouble = trouble_of("tar",
                                         {"/usr/bin/env", "tar", "--create", "--use-compress-program=gzip -1", "--file",
                                          unfinished.file, "--directory", unfinished.parts, "skein"},
                                         scratch.path() / "log");
  if (!trouble.empty()) throw std::runtime_error("cannot write " + archive.string() + ": " + trouble);
  put_in_place(unfinished.file, archive);
} catch (const fs::filesystem_error&) {  // says itself which path is wrong
  throw;
} catch (const std::system_error& error) {
  throw std::system_error(error.code(), "cannot write " + archive.string());
}

}  // namespace

void add_pack(CLI::App& app, PackOptions& pack) {
  CLI::App* command = app.add_subcommand(
      "pack", "Write the programs with all their libraries into one archive, for machines without Skein");
  command->add_option("FILE", pack.file, "Archive to write; its name ends in .tar.gz or .tgz")->required();
  command->add_option("--agent", pack.agents, "Pack this agent program of yours, too")->allow_extra_args(false);
  command->footer("Example:\n  skein pack skein.tar.gz\n\nSee docs/how-to-sweep.md.");
}

int pack_programs(const PackOptions& options, const Console& console) {
  const fs::path archive = fs::absolute(options.file);
  check_target(archive);
  std::vector<fs::path> files;
  for (const char* name : {"skein", programs::kSimServer, programs::kCommRouter, programs::kStation, programs::kAgent,
                           programs::kDoctor}) {
    files.push_back(program_dir() / name);
  }
  files.push_back(program_dir() / (std::string(programs::kAgent) + programs::kFleetSuffix));
  for (const fs::path& agent : options.agents) {
    if (!fs::is_regular_file(agent)) throw InputError("--agent " + agent.string() + ": is not a program");
    files.push_back(agent);
    const fs::path fleet = agent.string() + programs::kFleetSuffix;
    if (fs::exists(fleet)) files.push_back(fleet);
  }
  const std::vector<fs::path> modules = python_modules();
  const std::optional<fs::path> package = python_package();
  const bool with_python = package && !modules.empty();
  if (with_python) files.insert(files.end(), modules.begin(), modules.end());
  std::map<std::string, fs::path> libraries;
  std::string loader;
  std::set<std::string> names;
  for (const fs::path& file : files) {
    if (!fs::exists(file)) throw InputError("there is no " + file.string() + " to be packed");
    if (!names.insert(file.filename()).second) throw InputError("two programs are called " + file.filename().string());
    add_libraries(file, libraries, loader);
  }

  write_archive(archive, {files, libraries, loader, with_python ? package : std::nullopt});
  console.out << fmt::format(
      "{}: {} programs, {} libraries, {}{:.0f} MB; unpack it anywhere, and call skein/skein\n", archive.string(),
      files.size() - (with_python ? modules.size() : 0), libraries.size(),
      with_python ? "the package for Python (whose interpreter and NumPy are the machine's), " : "",
      static_cast<double>(fs::file_size(archive)) / 1e6);
  return kExitDone;
}

}  // namespace skein::cli

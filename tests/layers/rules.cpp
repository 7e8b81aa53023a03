#include "tests/layers/rules.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <tuple>

namespace skein::layers {

namespace fs = std::filesystem;

namespace {

/// The folder of a path that has a layer of its own. That is a folder at the root, or one of two subfolders that have
/// fewer dependencies than the folders that contain them: the file format of recordings, and the language of
/// properties.
std::string layer_folder(const std::string& path) {
  for (const char* folder : {"recording/mcap", "signals/properties"}) {
    if (path.starts_with(std::string(folder) + "/")) return folder;
  }
  return path.substr(0, path.find('/'));
}

const std::set<std::string>& applications() {
  static const std::set<std::string> kNames = {"sim_server", "uav_agent", "comm_router", "station", "cli", "doctor"};
  return kNames;
}

/// The launcher: its own folder, and folders that serve only it.
const std::set<std::string>& launcher() {
  static const std::set<std::string> kNames = {"cli", "debug", "host", "run"};
  return kNames;
}

/// The number of a folder's layer, from the lowest. All applications share one layer; one_process, which combines them,
/// is above it.
std::optional<int> layer_of(const std::string& folder) {
  static const std::vector<std::set<std::string>> kLayers = {
      {"core"},
      {"process", "idl", "recording/mcap", "signals/properties", "sight"},
      {"oracle", "results"},
      {"bus", "host", "report", "scenes", "signals"},
      {"debug", "view", "recording"},
      {"run"},
      applications(),
      {"one_process"}};
  const auto found = std::ranges::find_if(kLayers, [&](const auto& layer) { return layer.contains(folder); });
  return found == kLayers.end() ? std::nullopt : std::optional(static_cast<int>(found - kLayers.begin()));
}

std::string at(const SourceFile& file, std::size_t line, const std::string& what) {
  return file.path + ":" + std::to_string(line) + ": " + what;
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::ranges::any_of(prefixes, [&](const std::string& prefix) { return text.starts_with(prefix); });
}

/// Whether a file is main.cpp, *_node.* or *_program.*, or the test of one.
bool may_use_bus(const std::string& path) {
  static const std::regex kName(R"((^|.*/)(main\.cpp|[^/]*_node(_test)?\.[ch]pp)|[^/]*/[^/]*_program(_test)?\.[ch]pp)");
  return std::regex_match(path, kName);
}

/// Reports the lines, of code or of all text, that a pattern matches.
enum class Look { code, text };
void find_lines(const SourceFile& file, Look look, const std::regex& pattern, const std::string& what,
                Violations& violations) {
  const auto& lines = look == Look::code ? file.code : file.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (std::regex_search(lines[i], pattern)) violations.push_back(at(file, i + 1, what));
  }
}

/// Which lines of a Markdown page may be long: those of code, tables and images.
std::vector<bool> unbroken(const SourceFile& page) {
  std::vector<bool> unbroken;
  bool in_code = false;
  for (const std::string& line : page.lines) {
    const std::size_t start = line.find_first_not_of(' ');
    const std::string_view text =
        start == std::string::npos ? std::string_view() : std::string_view(line).substr(start);
    const bool fence = text.starts_with("```");
    unbroken.push_back(in_code || fence || text.starts_with('|') || text.starts_with("!["));
    if (fence) in_code = !in_code;
  }
  return unbroken;
}

}  // namespace

Violations check_layers(const Tree& tree) {
  Violations violations;
  for (const SourceFile& file : tree) {
    const std::string own_folder = layer_folder(file.path);
    const std::optional<int> own = layer_of(own_folder);
    for (const Include& include : file.includes) {
      const std::string folder = layer_folder(include.path);
      if (folder == "tests" && !file.is_test()) {
        violations.push_back(at(file, include.line, "only tests may include " + include.path));
      }
      const std::optional<int> other = layer_of(folder);
      if (!own || !other || folder == own_folder) continue;
      const bool of_the_launcher = launcher().contains(folder) && !launcher().contains(own_folder);
      if (*other < *own && !of_the_launcher) continue;
      violations.push_back(at(file, include.line, own_folder + " must not include " + include.path));
    }
  }
  return violations;
}

namespace {

/// "sim_server/flight" for a file in that folder; "sim_server/mission" for a header and source beside the folders.
std::string room_of(const std::string& path) {
  const std::size_t application = path.find('/'), folder = path.find('/', application + 1);
  return folder != std::string::npos ? path.substr(0, folder) : path.substr(0, path.rfind('.'));
}

struct Door {
  std::string from, to;
  std::string where;  ///< place of the first include that leads from one to the other
};

/// All rooms that `from` includes, directly or indirectly.
std::set<std::string> reach(const std::string& from, const std::vector<Door>& doors) {
  std::set<std::string> reached;
  std::vector<std::string> next = {from};
  while (!next.empty()) {
    const std::string room = next.back();
    next.pop_back();
    for (const Door& door : doors) {
      if (door.from == room && reached.insert(door.to).second) next.push_back(door.to);
    }
  }
  return reached;
}

}  // namespace

Violations check_circles(const Tree& tree) {
  std::map<std::pair<std::string, std::string>, std::string> first;
  for (const SourceFile& file : tree) {
    if ((!applications().contains(file.folder()) && file.folder() != "scenes") || file.is_test()) continue;
    for (const Include& include : file.includes) {
      if (!include.path.starts_with(file.folder() + "/")) continue;
      const std::string from = room_of(file.path), to = room_of(include.path);
      if (from != to)
        first.try_emplace({from, to}, at(file, include.line, from + " and " + to + " include each other"));
    }
  }
  std::vector<Door> doors;
  for (const auto& [rooms, where] : first) doors.push_back({rooms.first, rooms.second, where});
  Violations violations;
  for (const Door& door : doors) {
    if (reach(door.to, doors).contains(door.from)) violations.push_back(door.where);
  }
  std::ranges::sort(violations);
  return violations;
}

Violations check_bus_users(const Tree& tree) {
  Violations violations;
  for (const SourceFile& file : tree) {
    const bool has_nodes = applications().contains(file.folder());
    if (has_nodes ? may_use_bus(file.path) : !launcher().contains(file.folder())) continue;
    for (const Include& include : file.includes) {
      const bool of_a_node = has_nodes && include.path.starts_with(file.folder() + "/") && may_use_bus(include.path);
      if (!include.path.starts_with("bus/") && !of_a_node) continue;
      violations.push_back(
          at(file, include.line, "only main.cpp, *_node.* and *_program.* may include " + include.path));
    }
  }
  return violations;
}

Violations check_dds_headers(const Tree& tree) {
  using Vendor = std::pair<std::string, std::vector<std::string>>;
  static const std::array<Vendor, 2> kVendors = {Vendor{"bus/fastdds/", {"fastdds/", "fastrtps/"}},
                                                 Vendor{"bus/cyclonedds/", {"dds/", "ddsc/", "dds.h"}}};
  Violations violations;
  for (const SourceFile& file : tree) {
    if (file.folder() == "tests" || file.folder() == "bench") continue;  // these compare the bus with raw DDS
    for (const Include& include : file.includes) {
      for (const auto& [folder, headers] : kVendors) {
        if (!starts_with_any(include.path, headers) || file.path.starts_with(folder)) continue;
        violations.push_back(at(file, include.line, "only " + folder + " may include " + include.path));
      }
    }
  }
  return violations;
}

const std::vector<LibraryRule>& library_rules() {
  static const std::vector<LibraryRule> kRules = {
      {"Bullet", {"bt", "bullet/", "BulletCollision/", "BulletDynamics/", "LinearMath/"}, {"sim_server/"}, 2},
      {"Embree", {"embree"}, {"sight/"}, 2},
      {"OctoMap",
       {"octomap/", "octomath/"},
       {"uav_agent/maps/map_subtrees_test.cpp", "uav_agent/", "tests/recording/map_test.cpp"},
       2},
      {"PCL", {"pcl/"}, {"uav_agent/", "sim_server/sensors/key_frames.cpp", "scenes/files/point_file_pcl_test.cpp"}, 2},
      {"Python", {"pybind11/", "Python.h"}, {"uav_agent/python/", "uav_agent/client/"}, 12, true},
      {"Boost", {"boost/"}, {"view/"}, 1},
      {"Assimp", {"assimp/"}, {"scenes/files/"}, 2}};
  return kRules;
}

Violations check_libraries(const Tree& tree, const std::vector<LibraryRule>& rules) {
  Violations violations;
  for (const LibraryRule& rule : rules) {
    std::map<std::string, std::size_t> users;  // by folder
    for (const SourceFile& file : tree) {
      const auto include =
          std::ranges::find_if(file.includes, [&](const Include& i) { return starts_with_any(i.path, rule.prefixes); });
      if (include == file.includes.end()) continue;
      const auto folder =
          std::ranges::find_if(rule.folders, [&](const std::string& f) { return file.path.starts_with(f); });
      if (folder == rule.folders.end()) {
        violations.push_back(at(file, include->line, rule.name + " does not belong here"));
      } else if (file.is_header() && rule.own_folder) {
        continue;  // counts through the .cpp files that include it
      } else if (file.is_header()) {
        violations.push_back(at(file, include->line, rule.name + " must not be seen in a header"));
      } else if (++users[*folder] > rule.most_files) {
        violations.push_back(
            at(file, include->line,
               rule.name + " is used in more than " + std::to_string(rule.most_files) + " files of " + *folder));
      }
    }
  }
  return violations;
}

Violations check_headers(const Tree& tree) {
  static const std::regex kUsing(R"(\busing\s+namespace\b)"), kOnce(R"(^\s*#\s*pragma\s+once\b)");
  Violations violations;
  for (const SourceFile& file : tree) {
    if (!file.is_header()) continue;
    const bool once = std::ranges::any_of(file.code, [](const auto& line) { return std::regex_search(line, kOnce); });
    if (!once) violations.push_back(at(file, 1, "has no #pragma once"));
    find_lines(file, Look::code, kUsing, "a header must not say using namespace", violations);
  }
  return violations;
}

Violations check_printing(const Tree& tree) {
  // Code that answers a user on a terminal and does not fly: options of programs that list, check or write something.
  static const std::regex kAnswers(R"(.*_(program|tasks)\.cpp)");
  static const std::regex kPrinting(R"(\b(printf|fprintf|puts|fputs|putchar)\s*\(|\bstd\s*::\s*cout\b)");
  Violations violations;
  for (const SourceFile& file : tree) {
    const bool answers = file.folder() == "cli" || file.is_main() || std::regex_match(file.path, kAnswers);
    if (answers || file.is_test()) continue;
    find_lines(file, Look::code, kPrinting, "prints; use the logger", violations);
  }
  return violations;
}

Violations check_sleeping(const Tree& tree) {
  static const std::regex kSleeping(R"(\b(sleep_for|sleep_until|usleep|nanosleep|clock_nanosleep|sleep)\s*\()");
  Violations violations;
  for (const SourceFile& file : tree) {
    if (file.folder() == "tests") continue;
    find_lines(file, Look::code, kSleeping, "sleeps; wait for an event", violations);
  }
  return violations;
}

Violations check_clocks(const Tree& tree) {
  // The one place where tests wait, a program in a container, one that plays a made-up flight at a given pace, and the
  // planner with planted defects, one of which reads the calendar.
  static const std::set<std::string> kAllowed = {"tests/support/eventually.cpp", "tests/containers/intruder.cpp",
                                                 "tests/hunt/planted.cpp", "tests/view/feeder.cpp"};
  static const std::regex kClock(R"(\b(\w*[cC]lock\s*::\s*now|clock_gettime|gettimeofday|std\s*::\s*time)\b)");
  Violations violations;
  for (const SourceFile& file : tree) {
    if (!file.is_test() || kAllowed.contains(file.path)) continue;
    find_lines(file, Look::code, kClock, "a test reads the clock; wait for a fact with eventually()", violations);
  }
  return violations;
}

Violations check_length(const Tree& tree, std::size_t most_lines) {
  Violations violations;
  for (const SourceFile& file : tree) {
    if (!(file.is_cpp() || file.is_python() || file.is_javascript()) || file.lines.size() <= most_lines) continue;
    violations.push_back(at(file, file.lines.size(), "is longer than " + std::to_string(most_lines) + " lines"));
  }
  return violations;
}

Violations check_columns(const Tree& tree, std::size_t most_columns) {
  Violations violations;
  for (const SourceFile& file : tree) {
    const bool page = file.path.ends_with(".md");
    const bool other_code = file.name() == "CMakeLists.txt" || file.path.ends_with(".cmake") ||
                            file.path.ends_with(".sh") || file.is_python() || file.path == "skein" ||
                            file.path.starts_with(".ci/");
    if (!file.is_cpp() && !other_code && !page) continue;
    const std::vector<bool> may_be_long = page ? unbroken(file) : std::vector<bool>(file.lines.size());
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const auto blank = [i](const std::vector<std::string>& lines) {
        return i < lines.size() && lines[i].find_first_not_of(' ') == std::string::npos;
      };
      if (file.is_cpp() && blank(file.code) && blank(file.comments)) continue;  // a line inside a string literal
      if (may_be_long[i]) continue;
      const auto columns = std::ranges::count_if(file.lines[i], [](char c) { return (c & 0xc0) != 0x80; });  // of UTF-8
      if (static_cast<std::size_t>(columns) <= most_columns) continue;
      violations.push_back(at(file, i + 1, "is longer than " + std::to_string(most_columns) + " columns"));
    }
  }
  return violations;
}

Violations check_marks(const Tree& tree) {
  static const std::regex kMarks(
      "\\b(TO"
      "DO|FIX"
      "ME)\\b");  // in two parts, so that this line has no marks itself
  Violations violations;
  for (const SourceFile& file : tree) find_lines(file, Look::text, kMarks, "marks unfinished work", violations);
  return violations;
}

Violations check_machine_paths(const Tree& tree) {
  static const std::regex kPaths(
      "(^|[^A-Za-z0-9_./}-])/"
      "(work|root|home)\\b");
  Violations violations;
  for (const SourceFile& file : tree) {
    if (file.folder() != "docker") find_lines(file, Look::text, kPaths, "names a path of one machine", violations);
  }
  return violations;
}

Violations check_tracked_files(const fs::path& root, const std::vector<std::string>& tracked,
                               std::uintmax_t most_bytes) {
  static const std::regex kProduct(
      R"((^|.*/)(build[^/]*/|CMakeFiles/|CMakeCache\.txt$|compile_commands\.json$|\.ninja_).*|.*\.(o|a|so|gch|pyc)$)");
  Violations violations;
  for (const std::string& path : tracked) {
    if (std::regex_match(path, kProduct)) violations.push_back(path + ":1: is a product of a build");
    std::error_code gone;
    const std::uintmax_t bytes = fs::file_size(root / path, gone);
    if (!gone && bytes > most_bytes) {
      violations.push_back(path + ":1: has " + std::to_string(bytes) + " bytes, more than " +
                           std::to_string(most_bytes));
    }
  }
  return violations;
}

std::optional<std::vector<std::string>> tracked_files(const fs::path& root) {
  if (!fs::exists(root / ".git")) return std::nullopt;
  const std::string command = "git -C '" + root.string() + "' ls-files -z 2>/dev/null";
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string output;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) output.append(buffer.data(), n);
  if (::pclose(pipe) != 0) return std::nullopt;
  std::vector<std::string> files;
  for (std::size_t begin = 0, end; (end = output.find('\0', begin)) != std::string::npos; begin = end + 1) {
    files.push_back(output.substr(begin, end - begin));
  }
  return files;
}

}  // namespace skein::layers

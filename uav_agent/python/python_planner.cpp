#include "uav_agent/python/python_planner.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "core/config/config_files.hpp"
#include "uav_agent/python/module.hpp"

namespace skein::agent {
namespace {

namespace fs = std::filesystem;

/// Folder of packages of Debian's Python, below the folder in which Skein is installed.
constexpr const char* kPackages = "lib/python3/dist-packages";

fs::path module_file() {
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("SKEIN_BIN_DIR"); named != nullptr && *named != '\0') folders.emplace_back(named);
  std::error_code none;
  folders.push_back(fs::read_symlink("/proc/self/exe", none).parent_path());
  for (const fs::path& folder : folders) {
    for (const fs::path& file : {folder / python::kModule, folder.parent_path() / "lib" / "skein" / python::kModule}) {
      if (fs::is_regular_file(file, none)) return file;
    }
  }
  throw InputError("--planner py:...: there is no " + std::string(python::kModule) + " in " + folders.front().string() +
                   " or beside it; Debian's package python3-skein has it, and a build of Skein makes it");
}

/// The folder of the package `skein` that belongs to this program; empty: Python finds the package by itself.
fs::path package_folder() {
  const fs::path config = default_config_dir();
  std::error_code none;
  for (const fs::path& folder : {config.parent_path() / "python", config / "../../.." / kPackages}) {
    if (fs::is_regular_file(folder / "skein" / "planner.py", none)) return fs::absolute(folder).lexically_normal();
  }
  return {};
}

/// @throws InputError
void* function_of(void* module, const fs::path& file, const char* name) {
  if (void* const function = ::dlsym(module, name)) return function;
  throw InputError(file.string() + ": " + ::dlerror());
}

python::MakePlanner* loaded_module() {
  static python::MakePlanner* const make = [] {
    const fs::path file = module_file();
    void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) throw InputError("--planner py:...: Python cannot be loaded: " + std::string(::dlerror()));
    const auto interface = reinterpret_cast<python::Interface*>(function_of(module, file, python::kInterface));
    if (std::string_view(interface()) != python::kInterfaceVersion) {
      throw InputError(file.string() + " is of another version of Skein than this agent: build the agent anew");
    }
    return reinterpret_cast<python::MakePlanner*>(function_of(module, file, python::kMakePlanner));
  }();
  return make;
}

ConfigDocument parameters_of(const PythonSpec& spec) {
  if (!spec.parameters.empty() && spec.parameters.find('=') == std::string::npos) {
    return read_config_document(spec.parameters);
  }
  return parse_assignments(spec.parameters, "--planner " + text_of({spec.file, spec.class_name}));
}

}  // namespace

std::unique_ptr<Planner> make_python_planner(const std::string& spec, const AgentConfig& agent,
                                             const PythonSurroundings& surroundings) {
  std::optional<PythonSpec> named = python_spec(spec);
  if (!named) return nullptr;
  named->file = fs::absolute(named->file).lexically_normal();
  if (::access(named->file.c_str(), R_OK) != 0) {  // with --secure the agent is another user
    throw InputError("--planner " + spec + ": " + named->file.string() + ": " + std::strerror(errno));
  }
  python::Order order{.planner = *named,
                      .parameters = parameters_of(*named),
                      .agent = agent,
                      .seed = surroundings.seed,
                      .radio_topics = surroundings.radio_topics,
                      .debug_from_s = surroundings.debug_from_s,
                      .package_folder = package_folder(),
                      .maps = &python::map_queries()};
  std::unique_ptr<Planner> planner;
  loaded_module()(order, planner);
  return planner;
}

}  // namespace skein::agent

#include "cli/completion.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string_view>

#include "cli/command_line.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/text.hpp"

namespace skein::cli {
namespace {

using Names = std::vector<std::string>;

/// The possible values of an option: the set that CLI11 checks it against ("TEXT:{a,b}"), or known names of its kind.
Names values_of(const CLI::Option& option, const KnownNames& known) {
  const std::string type = option.get_type_name(), name = option.get_name();
  if (const std::size_t open = type.find('{'); open != std::string::npos) {
    return split(type.substr(open + 1, type.find('}') - open - 1));
  }
  if (name == "SCENARIO" || name == "--scenario" || name == "--scenarios") return known.scenarios();
  if (name == "--planner" || name == "--planners") return known.planners();
  if (name == "--clock") return {"lockstep", "realtime"};
  if (name == "--speed") return {"1", "8", "max"};
  Names presets;
  if (name == "--rules") {
    for (const RulesConfig& rules : rules_presets()) presets.push_back(rules.preset);
  }
  if (name == "--conditions") presets.assign(kConditionPresets.begin(), kConditionPresets.end());
  return presets;
}

Names option_names(const CLI::App& app) {
  Names names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The option of this name if it takes a value; else null.
const CLI::Option* valued_option(const CLI::App& app, const std::string& name) {
  const CLI::Option* option = name.starts_with("-") ? app.get_option_no_throw(name) : nullptr;
  return option != nullptr && option->get_type_size() != 0 ? option : nullptr;
}

/// Candidates for a planner's Python file in the folder typed so far: "py:dir/pl" -> "py:dir/plan.py", "py:dir/plans/".
Names python_files(const std::string& typed) {
  namespace fs = std::filesystem;
  constexpr std::string_view kPrefix = "py:";
  const std::string path = typed.substr(kPrefix.size());
  const std::string folder = path.substr(0, path.rfind('/') + 1);  // npos + 1 is 0
  Names names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, none)) {
    const std::string name = entry.path().filename();
    const bool is_folder = entry.is_directory(none);
    if (name.starts_with(".") || (!is_folder && !name.ends_with(".py"))) continue;
    names.push_back(std::string(kPrefix) + folder + name + (is_folder ? "/" : ""));
  }
  std::ranges::sort(names);
  return names;
}

/// Completes the last name in a list ("kios,hov") or after a UAV's name ("jurong=hov").
Names fitting(const Names& names, const std::string& typed) {
  const std::size_t cut = typed.find_last_of(",=");
  const std::string before = cut == std::string::npos ? "" : typed.substr(0, cut + 1);
  const bool of_python = typed.substr(before.size()).starts_with("py:");
  Names result;
  for (const std::string& name : of_python ? python_files(typed.substr(before.size())) : names) {
    if ((before + name).starts_with(typed)) result.push_back(before + name);
  }
  return result;
}

Names candidates(const CLI::App& app, const Names& words, const KnownNames& known) {
  const std::string& typed = words.back();
  if (words.size() == 1) {
    Names names = typed.starts_with("-") ? option_names(app) : Names{};
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
      names.push_back(command->get_name());
    }
    return fitting(names, typed);
  }
  const auto named = app.get_subcommands([&](const CLI::App* command) { return command->get_name() == words.front(); });
  if (named.empty()) return {};
  const CLI::App& command = *named.front();
  const CLI::Option* option = valued_option(command, words.end()[-2]);
  if (const std::size_t equals = typed.find('='); option == nullptr && equals != std::string::npos) {
    option = valued_option(command, typed.substr(0, equals));
  }
  if (option != nullptr) return fitting(values_of(*option, known), typed);
  if (typed.starts_with("-")) return fitting(option_names(command), typed);
  for (const CLI::Option* positional : command.get_options()) {
    if (positional->get_positional()) return fitting(values_of(*positional, known), typed);
  }
  return {};
}

}  // namespace

std::vector<std::string> completions(const std::vector<std::string>& words, const KnownNames& known) {
  Names names;
  with_command_line([&](const CLI::App& app) { names = candidates(app, words.empty() ? Names{""} : words, known); });
  return names;
}

}  // namespace skein::cli

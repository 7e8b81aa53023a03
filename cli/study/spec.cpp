#include "cli/study/spec.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

#include "core/text/text.hpp"
#include "core/types.hpp"
#include "run/planner_spec.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSeeds = 1000;

/// @throws InputError that quotes the whole text.
std::uint64_t whole_number(const std::string& digits, const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) {
    throw InputError(text + ": '" + digits +
                     "' is not a seed; write one (5), a list (3,5,8) or a range (0-4 for five of them)");
  }
  // As for --seed and all other whole numbers (refuse_leading_zeros()).
  if (digits.size() > 1 && digits.front() == '0') {
    throw InputError(text + ": '" + digits + "' must be a whole number in decimal digits, without a zero before it");
  }
  return number;
}

void append_range(std::uint64_t first, std::uint64_t last, const std::string& text, std::vector<std::uint64_t>& seeds) {
  if (last < first) throw InputError(text + ": a range goes upwards, such as 1-5");
  if (last - first >= kMostSeeds - seeds.size()) {
    throw InputError(text + ": more than " + std::to_string(kMostSeeds) + " seeds");
  }
  for (std::uint64_t i = 0; i <= last - first; ++i) seeds.push_back(first + i);  // `last` may be the greatest seed
}

/// "a/agent" are the last two names of "/teams/a/agent".
fs::path last_names(const fs::path& file, std::size_t names) {
  fs::path last;
  for (auto name = file.end(); name != file.begin() && names > 0; --names) {
    --name;
    last = last.empty() ? *name : *name / last;
  }
  return last;
}

}  // namespace

std::vector<std::string> split_planners(const std::string& list) {
  std::vector<std::string> planners;
  for (const std::string& item : split(list)) {
    const bool is_parameter = key_end(item) != std::string::npos;
    if (is_parameter) {
      const bool goes_on = !planners.empty() && has_parameters(planners.back()) && !exec_command(planners.back());
      if (!goes_on) {
        throw InputError("--planners " + list + ": '" + item +
                         "' is not a planner; a planner's first parameter follows a " +
                         "colon (NAME:KEY=VALUE,KEY=VALUE), and a fleet of several planners is given by --planner");
      }
      planners.back() += "," + item;
      continue;
    }
    if (item.empty()) throw InputError("--planners " + list + ": a planner's name is missing; write A,B,...");
    planners.push_back(item);
  }
  return planners;
}

std::vector<std::uint64_t> parse_seeds(const std::string& text, const std::string& option) {
  const std::string said = option + " " + text;
  std::vector<std::uint64_t> seeds;
  for (const std::string& item : split(text)) {
    const std::size_t dash = item.find('-');
    const std::uint64_t first = whole_number(item.substr(0, dash), said);
    append_range(first, dash == std::string::npos ? first : whole_number(item.substr(dash + 1), said), said, seeds);
  }
  if (std::set<std::uint64_t>(seeds.begin(), seeds.end()).size() != seeds.size()) {
    throw InputError(said + ": a seed is named twice");
  }
  return seeds;
}

std::vector<std::string> planner_labels(const std::vector<std::string>& planners) {
  std::set<fs::path> agents;
  const auto note = [&](const fs::path& agent) { return *agents.insert(agent).first; };
  for (const std::string& planner : planners) with_agents_named(planner, note);
  const auto name_of = [&](const fs::path& agent) {
    std::size_t names = 1;
    const auto is_alike = [&](const fs::path& other) { return last_names(other, names) == last_names(agent, names); };
    while (std::ranges::count_if(agents, is_alike) > 1) ++names;
    return last_names(agent, names);
  };
  std::vector<std::string> labels;
  for (const std::string& planner : planners) labels.push_back(with_agents_named(planner, name_of));
  return labels;
}

std::vector<std::string> scene_titles(const std::vector<std::string>& scenarios) {
  std::vector<std::string> titles;
  for (const std::string& scenario : scenarios) {
    const auto name_of = [](const std::string& text) { return fs::path(text).stem().string(); };
    const auto is_alike = [&](const std::string& other) { return name_of(other) == name_of(scenario); };
    titles.push_back(std::ranges::count_if(scenarios, is_alike) > 1 || name_of(scenario).empty() ? scenario
                                                                                                 : name_of(scenario));
  }
  return titles;
}

std::vector<std::string> folder_names(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const std::string& text : texts) {
    const std::string label = planner_label(text);
    std::string name = label;
    for (int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n) {
      name = label + "-" + std::to_string(n);
    }
    names.push_back(name);
  }
  return names;
}

}  // namespace skein::cli

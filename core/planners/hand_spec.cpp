#include "core/planners/hand_spec.hpp"

#include <algorithm>
#include <filesystem>

#include "core/config/config_node.hpp"
#include "core/messages/hand_command.hpp"
#include "core/text/text.hpp"

namespace skein {
namespace {

constexpr const char* kFileParameter = "file=";

}  // namespace

std::optional<std::vector<std::string>> hand_parameters(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (spec.substr(0, colon) != kHandPlanner) return std::nullopt;
  const std::string text = colon == std::string::npos ? "" : spec.substr(colon + 1);
  if (text.empty()) return std::vector<std::string>{};
  if (text.find('=') != std::string::npos) return split(text);
  if (std::filesystem::path(text).extension() == ".csv") return std::vector{kFileParameter + text};
  const ConfigDocument document = read_config_document(text);
  std::vector<std::string> parameters;
  for (std::size_t i = 0; i < document.root.keys.size(); ++i) {
    parameters.push_back(document.root.keys[i] + "=" + document.root.items[i].scalar);
  }
  return parameters;
}

bool wants_hands(const std::string& spec) {
  const auto parameters = hand_parameters(spec);
  return parameters && std::ranges::none_of(*parameters, [](const std::string& parameter) {
           return parameter.starts_with(kFileParameter);
         });
}

}  // namespace skein

#include "cli/compose/compose_header.hpp"

#include <fstream>
#include <string_view>
#include <system_error>

#include "cli/compose/compose_yaml.hpp"

namespace skein::cli {
namespace {

constexpr std::string_view kHeaderBegin = "# The fleet of '";
constexpr std::string_view kHeaderEnd = "', a container a program (docs/containers.md), made by";

}  // namespace

std::string compose_header(const std::string& scenario, const std::string& command) {
  std::string text(kHeaderBegin);
  return text.append(in_comment(scenario)).append(kHeaderEnd).append("\n#   ").append(in_comment(command)) + "\n";
}

bool is_compose_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  return std::getline(in, line) && line.starts_with(kHeaderBegin) && line.ends_with(kHeaderEnd);
}

}  // namespace skein::cli

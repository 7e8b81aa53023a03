#include "cli/compose/compose_yaml.hpp"

#include <spdlog/fmt/fmt.h>

#include <yaml-cpp/yaml.h>
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <stdexcept>

#include "core/text/text.hpp"
#include "core/text/utf8.hpp"
#include "core/types.hpp"

namespace skein::cli {
namespace {

/// Whether readers of YAML 1.1 and 1.2 find the same text in double quotes. The library escapes the control characters
/// of ASCII and Latin-1, but not DEL, nor the line and paragraph separators that YAML 1.1 takes for line breaks.
bool yaml_holds(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::int64_t character = next_character(text, at);
    if (character <= 0 || character == 0x7f || character == 0x2028 || character == 0x2029) return false;
    if ((character & 0xfffe) == 0xfffe) return false;  // noncharacters
  }
  return true;
}

}  // namespace

std::string in_comment(const std::string& text) {
  std::string line;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    line += byte >= 0x20 && byte < 0x7f ? std::string(1, letter) : fmt::format("'$'\\x{:02x}''", byte);
  }
  return line;
}

ComposeYaml& ComposeYaml::key(const std::string& name) {
  const auto plain = [](unsigned char c) { return c == '_' || std::islower(c) != 0; };
  // YAML takes some words without quotes for truth values; those with a '_' are Skein's own.
  const bool is_word = name == "<<" || (name.size() > 3 && name != "true" && name != "null" && name != "false" &&
                                        std::ranges::all_of(name, plain));
  put(YAML::Key);
  if (!is_word) put(YAML::DoubleQuoted);
  return put(name).put(YAML::Value);
}

ComposeYaml& ComposeYaml::own(const std::string& text) { return put(YAML::DoubleQuoted).put(text); }

ComposeYaml& ComposeYaml::own(const std::vector<std::string>& texts) {
  begin_list();
  for (const std::string& text : texts) own(text);
  return end_list();
}

ComposeYaml& ComposeYaml::literal(const std::string& text) {
  if (!yaml_holds(text)) {
    throw InputError("'" + printable(text) +
                     "': a file for docker-compose cannot hold this; it must be text in UTF-8, without DEL and line "
                     "separators");
  }
  std::string written = text;
  for (std::size_t at = 0; (at = written.find('$', at)) != std::string::npos; at += 2) written.insert(at, "$");
  return own(written);
}

std::string ComposeYaml::text() const {
  if (!out_.good()) throw std::logic_error("the file for docker-compose: " + out_.GetLastError());
  return out_.c_str();
}

}  // namespace skein::cli

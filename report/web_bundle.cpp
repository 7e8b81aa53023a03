#include "report/web_bundle.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <span>

#include "core/files/file_bytes.hpp"
#include "core/text/base64.hpp"
#include "core/text/sha256.hpp"

namespace skein::report {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargest = 3 << 20;

/// Whether the text contains nothing that would end a <script> element, or start a comment in it.
bool fits_in_script(const std::string& script) {
  std::string lower = script;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower.find("</script") == std::string::npos && lower.find("<!--") == std::string::npos;
}

}  // namespace

std::optional<fs::path> find_web_bundle(std::string_view name) {
  const auto there = [](const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error);
  };
  if (const char* named = std::getenv("SKEIN_WEB"); named != nullptr && *named != '\0') {
    const fs::path file = name == kReportScript ? fs::path(named) : fs::path(named).parent_path() / name;
    return there(file) ? std::optional(file) : std::nullopt;
  }
  std::error_code error;
  const fs::path bin = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& file :
       {fs::path(SKEIN_SOURCE_ROOT) / "build" / "web" / name, bin.parent_path() / "share" / "skein" / "web" / name}) {
    if (there(file)) return file;
  }
  return std::nullopt;
}

std::optional<std::string> web_bundle(std::string_view name) try {
  const auto file = find_web_bundle(name);
  if (!file) return std::nullopt;
  std::string script = read_file_bytes(*file, kLargest);
  return fits_in_script(script) ? std::optional(std::move(script)) : std::nullopt;
} catch (const InputError&) {
  return std::nullopt;
}

std::string script_hash(std::string_view script) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(script.data()), script.size());
  return "sha256-" + base64(Sha256().add(bytes).digest());
}

std::string policy_of_file(const std::optional<std::string>& script) {
  return "default-src 'none'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'" +
         (script ? "; script-src '" + script_hash(*script) + "'" : std::string());
}

std::string script_json(std::string json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      out += "\\u003c";
    } else if (c == '>') {
      out += "\\u003e";
    } else if (c == '&') {
      out += "\\u0026";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace skein::report

#include "view/door.hpp"

#include <algorithm>

#include "view/endpoint.hpp"

namespace skein::view {
namespace {

std::string cookie_name(std::string_view host) { return "skein_" + std::to_string(read_host(host).port); }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// Calls `use` with the parts of a text until it returns true. @returns whether it did.
bool any_part(std::string_view text, char between, const auto& use) {
  while (true) {
    const std::size_t end = text.find(between);
    if (use(text.substr(0, end))) return true;
    if (end == std::string_view::npos) return false;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

Door::Door(std::vector<std::string> names, Key key) : names_(std::move(names)), key_(std::move(key)) {
  names_.insert(names_.end(), {"127.0.0.1", "localhost", "::1"});
}

bool Door::knows_host(std::string_view host) const {
  const std::string name = read_host(host).name;
  return !name.empty() && std::ranges::find(names_, name) != names_.end();
}

bool Door::is_own_origin(std::string_view origin, std::string_view host) const {
  return origin == "http://" + std::string(host);
}

bool Door::opens(std::string_view cookie, std::string_view host) const {
  const std::string begin = cookie_name(host) + "=";
  return any_part(cookie, ';', [&](std::string_view part) {
    part = trimmed(part);
    return part.starts_with(begin) && key_.opens(part.substr(begin.size()));
  });
}

std::string Door::cookie(std::string_view host) const {
  return cookie_name(host) + "=" + key_.text() + "; Path=/; HttpOnly; SameSite=Strict";
}

std::string_view form_field(std::string_view body, std::string_view name) {
  std::string_view value;
  any_part(body, '&', [&](std::string_view part) {
    const bool found = part.starts_with(name) && part.substr(name.size()).starts_with('=');
    if (found) value = part.substr(name.size() + 1);
    return found;
  });
  return value;
}

}  // namespace skein::view

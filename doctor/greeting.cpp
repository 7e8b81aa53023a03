#include "doctor/greeting.hpp"

#include <algorithm>
#include <string_view>

#include "process/json_fields.hpp"

namespace skein::doctor {

void describe(auto& f, Greeting& greeting) {
  f.field("id", greeting.id);
  f.field("name", greeting.name);
  f.field("domain", greeting.domain);
  f.field("base", greeting.base);
  f.field("address", greeting.address);
  f.field("vendors", greeting.vendors);
  f.field("by", greeting.by);
  f.field("size", greeting.size);
  f.field("sent_s", greeting.sent_s);
  f.field("heard_udp", greeting.heard_udp);
  f.field("heard_dds", greeting.heard_dds);
}

namespace {

constexpr std::string_view kMark = "skein doctor 1\n";

}  // namespace

std::vector<std::uint8_t> bytes_of(Greeting greeting, std::size_t size) {
  greeting.size = size;
  const std::string text = std::string(kMark) + json_of(greeting).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::vector<std::uint8_t> bytes(text.begin(), text.end());
  bytes.resize(std::max(bytes.size(), size), ' ');
  return bytes;
}

std::optional<Greeting> read_greeting(std::span<const std::uint8_t> bytes) {
  const std::string text(bytes.begin(), bytes.end());
  if (!text.starts_with(kMark)) return std::nullopt;
  const Json json = parse_json(text.substr(kMark.size()));
  if (!json.is_object()) return std::nullopt;
  Greeting greeting = struct_of<Greeting>(json);
  if (greeting.id == 0) return std::nullopt;
  return greeting;
}

}  // namespace skein::doctor

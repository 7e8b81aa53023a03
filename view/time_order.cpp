#include "view/time_order.hpp"

#include <array>
#include <utility>

#include "core/text/text.hpp"
#include "core/types.hpp"
#include "process/json_text.hpp"

namespace skein::view {
namespace {

constexpr std::size_t kLongest = 200;
constexpr const char* kMax = "max";

constexpr std::array<std::pair<const char*, TimeOrder::Kind>, 4> kKinds = {{{"pause", TimeOrder::Kind::pause},
                                                                            {"resume", TimeOrder::Kind::resume},
                                                                            {"step", TimeOrder::Kind::step},
                                                                            {"speed", TimeOrder::Kind::speed}}};

bool is_speed(double speed) { return speed >= kLeastSpeed && speed <= kMostSpeed; }

/// @returns whether `value` is a speed; if so, `order` gets it.
bool take_speed(const Json& value, TimeOrder& order) {
  if (value.is_string()) return value.get<std::string>() == kMax;
  if (!value.is_number() || !is_speed(value.get<double>())) return false;
  order.speed = value.get<double>();
  return true;
}

}  // namespace

std::string text_of(const TimeOrder& order) {
  Json json = Json::object();
  for (const auto& [name, kind] : kKinds) {
    if (kind == order.kind) json["do"] = name;
  }
  if (order.kind == TimeOrder::Kind::speed) json["speed"] = order.speed ? Json(*order.speed) : Json(kMax);
  return json.dump();
}

std::optional<TimeOrder> read_time_order(std::string_view text) {
  if (text.size() > kLongest) return std::nullopt;
  const Json json = parse_json(std::string(text));
  if (!json.is_object() || !json.contains("do") || !json["do"].is_string()) return std::nullopt;
  for (const auto& [name, kind] : kKinds) {
    if (json["do"].get<std::string>() != name) continue;
    TimeOrder order{kind};
    const bool with_speed = kind == TimeOrder::Kind::speed;
    if (json.size() != (with_speed ? 2U : 1U)) return std::nullopt;
    if (with_speed && (!json.contains("speed") || !take_speed(json["speed"], order))) return std::nullopt;
    return order;
  }
  return std::nullopt;
}

std::optional<double> read_speed(const std::string& text) {
  if (text == kMax) return std::nullopt;
  const std::optional<double> speed = parse_number(text);
  if (!speed || !is_speed(*speed)) {
    throw InputError("--speed: '" + text + "' is not a speed; give a number from " + shortest(kLeastSpeed) + " to " +
                     shortest(kMostSpeed) + ", or " + kMax);
  }
  return speed;
}

std::string speed_text(const std::optional<double>& speed) { return speed ? shortest(*speed) : kMax; }

}  // namespace skein::view

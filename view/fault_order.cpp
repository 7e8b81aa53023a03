#include "view/fault_order.hpp"

#include <utility>

#include "core/overloaded.hpp"
#include "process/json_text.hpp"

namespace skein::view {
namespace {

constexpr std::size_t kLongestFaultOrder = 400, kLongestName = 100;
constexpr double kShortest_s = 0.05, kLongest_s = 36000.0;
constexpr double kNoRange_m = 0.001;

/// Takes the keys of an order one by one. A key that is missing, of another type, out of bounds or left over makes the
/// order invalid.
class Keys {
 public:
  explicit Keys(Json json) : json_(std::move(json)) {}

  std::string text(const char* key) {
    const Json value = take(key);
    if (value.is_string() && value.get_ref<const std::string&>().size() <= kLongestName) return value;
    sound_ = false;
    return {};
  }
  double number(const char* key, double least, double most) {
    const Json value = take(key);
    if (value.is_number() && value.get<double>() >= least && value.get<double>() <= most) return value;
    sound_ = false;
    return least;
  }
  std::int64_t whole(const char* key, std::int64_t least, std::int64_t most) {
    const Json value = take(key);
    if (value.is_number_unsigned() && value.get<std::uint64_t>() <= static_cast<std::uint64_t>(most) &&
        value.get<std::int64_t>() >= least) {
      return value;
    }
    sound_ = false;
    return least;
  }
  bool has(const char* key) const { return json_.contains(key); }
  /// Whether all keys have been taken, and all were valid.
  bool sound() const { return sound_ && json_.empty(); }

 private:
  Json take(const char* key) {
    if (!json_.contains(key)) return {};
    Json value = std::move(json_[key]);
    json_.erase(key);
    return value;
  }

  Json json_;
  bool sound_ = true;
};

std::optional<FaultAction> read_action(const std::string& kind, Keys& keys) {
  if (kind == "link") {
    const std::string from = keys.text("from");
    return no_link(from, keys.text("to"));
  }
  if (kind == "station_outage") return StationOutage{};
  const std::string of = keys.text("of");
  if (kind == "blackout") return Blackout{of};
  if (kind == "kill") return Kill{of};
  if (kind == "pause") return Pause{of};
  if (kind == "lidar_failure") return LidarFailure{of};
  if (kind == "camera_failure") return CameraFailure{of};
  if (kind == "stuck_gimbal") return StuckGimbal{of};
  if (kind == "odometry_freeze") return OdometryFreeze{of};
  if (kind == "command_delay") return CommandDelay{of, static_cast<int>(keys.whole("exchanges", 1, 1200))};
  if (kind == "motor_failure") {
    const auto rotor = static_cast<int>(keys.whole("rotor", 0, 5));
    return MotorFailure{of, rotor, keys.number("thrust", 0.0, 0.999)};
  }
  return std::nullopt;
}

void write_action(const FaultAction& action, Json& json) {
  std::visit(Overloaded{[&](const LinkEffect& f) {
                          json["from"] = f.from.front();
                          json["to"] = f.to.front();
                        },
                        [](const Partition&) {}, [](const StationOutage&) {}, [](const ConditionsChange&) {},
                        [&](const Kill& f) { json["of"] = f.member; }, [&](const Pause& f) { json["of"] = f.member; },
                        [&](const MotorFailure& f) {
                          json["of"] = f.uav;
                          json["rotor"] = f.rotor;
                          json["thrust"] = f.thrust;
                        },
                        [&](const CommandDelay& f) {
                          json["of"] = f.uav;
                          json["exchanges"] = f.exchanges;
                        },
                        [&](const auto& f) { json["of"] = f.uav; }},
             action);
}

}  // namespace

LinkEffect no_link(const std::string& from, const std::string& to) {
  LinkEffect effect;
  effect.from = {from};
  effect.to = {to};
  effect.range_m = kNoRange_m;
  return effect;
}

std::string text_of(const FaultOrder& order) {
  Json json = {{"do", order.begins ? "fault" : "end_fault"}};
  if (order.begins) {
    json["kind"] = fault_kind(Fault{.at_s = 0.0, .until_s = {}, .action = *order.begins});
    write_action(*order.begins, json);
    if (order.for_s) json["for_s"] = *order.for_s;
  } else {
    json["fault"] = order.ended;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<FaultOrder> read_fault_order(std::string_view text) {
  if (text.size() > kLongestFaultOrder) return std::nullopt;
  Json json = parse_json(std::string(text));
  if (!json.is_object()) return std::nullopt;
  Keys keys(std::move(json));
  const std::string what = keys.text("do");
  FaultOrder order;
  if (what == "end_fault") {
    order.ended = static_cast<std::uint64_t>(keys.whole("fault", 0, 1'000'000'000));
  } else if (what == "fault") {
    order.begins = read_action(keys.text("kind"), keys);
    if (keys.has("for_s")) order.for_s = keys.number("for_s", kShortest_s, kLongest_s);
    if (!order.begins) return std::nullopt;
  } else {
    return std::nullopt;
  }
  return keys.sound() ? std::optional(order) : std::nullopt;
}

}  // namespace skein::view

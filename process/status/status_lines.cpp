#include "process/status/status_lines.hpp"

#include "process/json_fields.hpp"

namespace skein::status {

void describe(auto& f, Progress& progress) {
  f.field("t", progress.time_s);
  f.field("mission_s", progress.mission_s);
  f.field("phase", progress.phase);
  f.field("duration_s", progress.duration_s);
  f.field("in_contact", progress.in_contact);
  f.field("alive", progress.alive);
  f.field("lost", progress.lost);
}

void describe(auto& f, Tally& tally) {
  f.field("points", tally.points);
  f.field("score", tally.score);
  f.field("earned", tally.earned);
}

void describe(auto& f, WaitingFor& wait) {
  f.field("members", wait.members);
  f.field("missing", wait.missing);
  f.field("what", wait.what);
  f.field("seconds", wait.seconds);
  f.field("due", wait.due);
}

void describe(auto& f, Order& order) {
  f.field("member", order.member);
  f.field("order", order.order);
  f.field("t", order.time_s);
}

void describe(auto& f, Warning& warning) { f.field("text", warning.text); }

void describe(auto& f, Rejoined& rejoined) { f.field("member", rejoined.member); }

void describe(auto& f, Ended& ended) {
  f.field("status", ended.status);
  f.field("stalled", ended.stalled);
}

void describe(auto& f, Report& report) { f.field("report", report.report); }

namespace {

constexpr const char* kTypeKey = "type";

/// The line as the type that its key "type" names; nullopt: it names none of these types.
template <class... Types>
std::optional<Line> read_as(const Json& json, const std::variant<Types...>*) {
  std::optional<Line> line;
  const Json type = value_or(json, kTypeKey, "");
  const auto take = [&]<class Type>(const Type*) {
    if (type == Type::kType) line = struct_of<Type>(json);
  };
  (take(static_cast<const Types*>(nullptr)), ...);
  return line;
}

}  // namespace

nlohmann::json line_json(const Line& line) {
  return std::visit(
      [](const auto& what) {
        Json json = skein::json_of(what);
        json[kTypeKey] = what.kType;
        return nlohmann::json(json);
      },
      line);
}

std::optional<Line> read_line(const std::string& text) {
  return read_as(parse_json(text), static_cast<const Line*>(nullptr));
}

}  // namespace skein::status

namespace skein::orders {
namespace {

const std::string kStop = "stop", kLost = "lost ";

}  // namespace

std::string text_of(const Line& line) {
  const Lost* lost = std::get_if<Lost>(&line);
  return lost == nullptr ? kStop : kLost + lost->member;
}

std::optional<Line> read_line(const std::string& text) {
  if (text == kStop) return Stop{};
  if (text.starts_with(kLost)) return Lost{text.substr(kLost.size())};
  return std::nullopt;
}

}  // namespace skein::orders

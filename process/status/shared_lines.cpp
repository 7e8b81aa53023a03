#include "process/status/shared_lines.hpp"

#include "process/json_fields.hpp"

namespace skein::shared_lines {

void describe(auto& f, Said& said) {
  f.field("said_by", said.program);
  f.field("line", said.line);
}

void describe(auto& f, Ended& ended) {
  f.field("ended", ended.program);
  f.field("code", ended.code);
  f.field("signal", ended.signal);
  f.field("fatal", ended.fatal);
}

void describe(auto& f, Stopped& stopped) { f.field("stopped", stopped.program); }

void describe(auto& f, Start& start) {
  f.field("start", start.program);
  f.field("argv", start.argv);
  f.field("log", start.log);
  f.field("append_log", start.append_log);
}

void describe(auto& f, Tell& tell) {
  f.field("tell", tell.program);
  f.field("line", tell.line);
}

void describe(auto& f, Signal& signal) {
  f.field("signal_to", signal.program);
  f.field("signal", signal.signal);
}

namespace {

/// Parses a line. The first key of each kind of line identifies the kind; its value is the program's name.
template <class... Types>
std::optional<std::variant<Types...>> read_shared(const std::string& text, const std::variant<Types...>*) {
  const Json json = parse_json(text);
  std::optional<std::variant<Types...>> line;
  const auto take = [&]<class Type>(const Type*) {
    const std::string key = json_of(Type{}).begin().key();
    if (value_or(json, key.c_str(), nullptr).is_string()) line = struct_of<Type>(json);
  };
  if (json.is_object()) (take(static_cast<const Types*>(nullptr)), ...);
  return line;
}

}  // namespace

nlohmann::json said_by(const std::string& program, const nlohmann::json& line) {
  return news_json(Said{program, Json(line)});
}

nlohmann::json news_json(const News& news) {
  return std::visit([](const auto& line) { return nlohmann::json(json_of(line)); }, news);
}

std::optional<News> read_news(const std::string& text) { return read_shared(text, static_cast<const News*>(nullptr)); }

std::string text_of(const Order& order) {
  const Json json = std::visit([](const auto& line) { return json_of(line); }, order);
  return json_text(json);
}

std::optional<Order> read_order(const std::string& text) {
  return read_shared(text, static_cast<const Order*>(nullptr));
}

}  // namespace skein::shared_lines

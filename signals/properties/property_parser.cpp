#include "signals/properties/property_parser.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"

namespace skein::properties {
namespace {

/// A variable and the UAV to which it is bound.
using Binding = std::pair<std::string, std::string>;

/// Most bindings of a property's variables: enough for all pairs in the largest fleet. Each binding becomes a property
/// of its own, so with several variables a large fleet would fill the memory.
constexpr std::size_t kMostBindings = 20'000;

const std::vector<std::string> kSets = {"uavs", "explorers", "photographers"};

std::vector<std::string> members_of(const std::string& set, const Scenario& scenario) {
  std::vector<std::string> members;
  for (const UavConfig& uav : scenario.fleet) {
    const bool explorer = uav.vehicle.role == Role::explorer;
    if (set == "uavs" || explorer == (set == "explorers")) members.push_back(uav.name);
  }
  return members;
}

bool is_name_of_something(const std::string& word, const SignalNames& names) {
  const auto among = [&](const std::vector<std::string>& list) { return std::ranges::find(list, word) != list.end(); };
  return word == "all" || among(names.programs) ||
         std::ranges::any_of(kUnitNames, [&](const UnitName& u) { return u.name == word; });
}

/// Parses one text with one binding of its variables.
class Reader {
 public:
  Reader(const std::string& text, const Scenario& scenario, const ExpressionScope& scope, Property& property)
      : scenario_(scenario), property_(property), parser_(text, scope, property.signals) {}

  /// Parses the variables of a text; each with the UAVs to which it may be bound.
  std::vector<std::pair<std::string, std::vector<std::string>>> variables(const SignalNames& names) {
    std::vector<std::pair<std::string, std::vector<std::string>>> all;
    while (parser_.accept("for")) {
      const std::size_t at = parser_.at();
      std::string name = parser_.word("a name for each of them, like 'u'");
      const auto same = [&](const auto& variable) { return variable.first == name; };
      if (is_name_of_something(name, names) || std::ranges::any_of(all, same)) {
        ExpressionText::fail(at, "'" + name + "' means something else already; choose another name");
      }
      if (!parser_.accept("in")) ExpressionText::fail(parser_.at(), "here must be 'in', not " + parser_.next_text());
      const std::size_t set_at = parser_.at();
      const std::string set = parser_.word("uavs, explorers or photographers");
      if (std::ranges::find(kSets, set) == kSets.end()) {
        ExpressionText::fail(set_at, "there is no set '" + set + "'; " + suggestion(set, kSets));
      }
      parser_.expect(',');
      all.emplace_back(std::move(name), members_of(set, scenario_));
    }
    return all;
  }

  /// Parses the text after the variables.
  void read() {
    if (parser_.accept("whenever")) {
      property_.whenever = parser_.condition();
      parser_.expect(',');
    }
    if (!read_kind()) {
      property_.kind = Property::Kind::until;
      property_.condition = parser_.condition();
      if (!parser_.accept("until")) {
        ExpressionText::fail(parser_.at(),
                             "here must be 'until', or one of always, never, sometimes, eventually and "
                             "finally before the condition; not " +
                                 parser_.next_text());
      }
      property_.goal = parser_.condition();
    } else {
      property_.condition = parser_.condition();
    }
    if (parser_.accept("unless")) property_.unless = parser_.condition();
    read_window();
    parser_.expect_end();
  }

 private:
  bool read_kind() {
    using enum Property::Kind;
    for (const auto& [word, kind] :
         {std::pair("always", always), std::pair("never", never), std::pair("sometimes", sometimes),
          std::pair("eventually", eventually), std::pair("finally", finally)}) {
      if (!parser_.accept(word)) continue;
      property_.kind = kind;
      return true;
    }
    return false;
  }

  void read_window() {
    Window& window = property_.window;
    property_.window_at = parser_.at();
    bool has_beginning = false;
    const auto begins = [&](std::size_t at) {
      if (std::exchange(has_beginning, true))
        ExpressionText::fail(at, "a window has one beginning: give 'after' or 'from' once");
    };
    for (;;) {
      const std::size_t at = parser_.at();
      if (parser_.accept("within")) {
        if (window.within_s) ExpressionText::fail(at, "'within' stands here already");
        window.within_s = time("what follows 'within'");
        if (*window.within_s <= 0.0) ExpressionText::fail(at, "'within' needs a time above 0 s");
      } else if (parser_.accept("after")) {
        begins(at);
        read_after();
      } else if (parser_.accept("from")) {
        begins(at);
        read_interval();
      } else {
        break;
      }
    }
    if (property_.kind == Property::Kind::sometimes && (window.within_s || property_.whenever)) {
      ExpressionText::fail(property_.window_at,
                           "'sometimes' cannot have 'within' or 'whenever', because it need not hold in "
                           "each run; use 'eventually'");
    }
    const double deadline_s = window.until_s.value_or(window.from_s + window.within_s.value_or(0.0));
    if (!property_.whenever && deadline_s > scenario_.duration_s) refuse_late(property_.window_at, deadline_s);
  }

  void read_after() {
    Window& window = property_.window;
    if (parser_.accept("heal")) {
      window.from = Window::From::heal;
      return;
    }
    window.from = Window::From::time;
    window.from_s = time("what follows 'after', unless it is 'heal',");
  }

  void read_interval() {
    Window& window = property_.window;
    window.from = Window::From::time;
    window.from_s = time("what follows 'from'");
    if (!parser_.accept("to")) ExpressionText::fail(parser_.at(), "here must be 'to', not " + parser_.next_text());
    const std::size_t at = parser_.at();
    window.until_s = time("what follows 'to'");
    if (*window.until_s <= window.from_s) {
      ExpressionText::fail(at, "the interval is upside down: it ends at " + number_text(*window.until_s) +
                                   " s and begins at " + number_text(window.from_s) + " s");
    }
    const double period_s = scenario_.exchange_period_s;
    const double first_s = std::ceil(window.from_s / period_s - 1e-6) * period_s;
    if (first_s > *window.until_s + 1e-6 * period_s) {
      ExpressionText::fail(at, "no exchange is between " + number_text(window.from_s) + " s and " +
                                   number_text(*window.until_s) + " s: they come every " + number_text(period_s) +
                                   " s, the next one at " + number_text(first_s) + " s; let the interval end later");
    }
  }

  double time(const std::string& what) {
    const std::size_t at = parser_.at();
    const double time_s = parser_.constant(kSeconds, what);
    if (time_s < 0.0) ExpressionText::fail(at, "a time must not be below 0 s");
    if (time_s >= scenario_.duration_s) refuse_late(at, time_s);
    return time_s;
  }

  void refuse_late(std::size_t at, double time_s) {
    ExpressionText::fail(at, number_text(time_s) + " s are beyond the end: the mission of '" + scenario_.name +
                                 "' lasts " + number_text(scenario_.duration_s) + " s");
  }

  const Scenario& scenario_;
  Property& property_;
  ExpressionParser parser_;
};

/// All bindings of the variables in which no UAV occurs twice.
std::vector<std::vector<Binding>> bindings(
    const std::vector<std::pair<std::string, std::vector<std::string>>>& variables) {
  std::vector<std::vector<Binding>> all = {{}};
  for (const auto& [name, values] : variables) {
    std::vector<std::vector<Binding>> longer;
    for (const std::vector<Binding>& one : all) {
      for (const std::string& value : values) {
        if (std::ranges::any_of(one, [&](const Binding& other) { return other.second == value; })) continue;
        longer.push_back(one);
        longer.back().emplace_back(name, value);
      }
      if (longer.size() > kMostBindings) {
        ExpressionText::fail(0, "there are more than " + std::to_string(kMostBindings) +
                                    " ways to choose UAVs of this fleet for the variables; use fewer variables");
      }
    }
    all = std::move(longer);
  }
  return all;
}

}  // namespace

std::vector<Property> parse_property(const std::string& name, const std::string& text, const Scenario& scenario,
                                     const std::map<std::string, Quantity>& parameters) {
  const SignalNames names(scenario);
  Property unbound;
  const ExpressionScope no_scope{.names = names};
  const auto variables = Reader(text, scenario, no_scope, unbound).variables(names);
  std::vector<Property> properties;
  for (const std::vector<Binding>& binding : bindings(variables)) {
    Property& property = properties.emplace_back();
    property.name = name;
    ExpressionScope scope{.names = names, .variables = {binding.begin(), binding.end()}, .parameters = parameters};
    for (const auto& [variable, value] : binding) {
      property.bound += (property.bound.empty() ? "" : ", ") + variable + " = " + value;
    }
    Reader reader(text, scenario, scope, property);
    reader.variables(names);
    reader.read();
  }
  if (properties.empty()) ExpressionText::fail(0, "this fleet has no UAV for the property's variables");
  return properties;
}

}  // namespace skein::properties

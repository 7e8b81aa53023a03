#include "cli/fault_tests/conversion.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

#include "core/config/config_reader.hpp"
#include "core/faults/fault_writer.hpp"
#include "core/scenario/scenario.hpp"
#include "core/text/suggestion.hpp"
#include "core/text/text.hpp"

namespace skein::cli {
namespace {

using Kind = ConfigNode::Kind;

constexpr const char* kUsualDuration = "60";  ///< of a fault test that names none [s]

void require(bool ok, const ConfigDocument& document, const std::string& key, const std::string& what) {
  ConfigErrors errors(document);
  errors.check(ok, key, what);
  errors.throw_if_any();
}

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

/// Limits as files spell them: `3`, or `{at_least: 3, at_most: 9}`.
struct OldLimits {
  explicit OldLimits(const ConfigNode& node) {
    const auto bound = [&](const char* key) {
      const ConfigNode* given = node.find(key);
      return given != nullptr ? given->scalar : node.scalar;
    };
    least = bound("at_least");
    most = bound("at_most");
  }

  /// For counts that never fall: whether a higher count can only break these limits.
  bool only_from_above() const { return !most.empty() && number(least) <= 0.0; }
  std::string text(const std::string& what, const std::string& unit = "") const {
    if (!least.empty() && least == most) return what + " == " + least + unit;
    const std::string both = least.empty() || most.empty() ? "" : " and ";
    return (least.empty() ? "" : what + " >= " + least + unit) + both +
           (most.empty() ? "" : what + " <= " + most + unit);
  }

  std::string least, most;  ///< empty: none
};

std::string unit_of(const std::string& key) {
  return key.ends_with("_mps") ? " m/s" : key.ends_with("_m") ? " m" : key.ends_with("_s") ? " s" : "";
}

/// The properties that say what a file's `expect` said: names, and values as YAML.
class NewProperties {
 public:
  using Entry = std::pair<std::string, std::string>;

  explicit NewProperties(const ConfigDocument& document)
      : document_(document),
        expect_(*document.root.find("expect")),
        present_(document.root.find("properties")),
        is_capsule_(document.root.find("capsule") != nullptr) {
    const ConfigNode* run = document.root.find("run");
    const ConfigNode* duration = run == nullptr ? nullptr : run->find("duration_s");
    duration_s_ = number(duration == nullptr ? kUsualDuration : duration->scalar);
    if (present_ != nullptr) names_.insert(present_->keys.begin(), present_->keys.end());
    for (std::size_t i = 0; i < expect_.keys.size(); ++i) add_key(expect_.keys[i], expect_.items[i]);
  }

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  void add_key(const std::string& key, const ConfigNode& value) {
    const bool is_list = key == "during" || key == "left" || key == "rejoined";
    const bool is_map = key == "uavs" || key == "taken_over";
    const Kind kind = is_list ? Kind::list : is_map ? Kind::map : value.kind;
    require(value.kind == kind, document_, "expect." + key, is_list ? "must be a list" : "must be a map");
    if (key == "during") {
      for (const ConfigNode& window : value.items) add_window(window);
    } else if (key == "left" || key == "rejoined") {
      add_members(key, key == "left" ? "leaves" : "restarts", value);
    } else if (key == "uavs") {
      for (std::size_t i = 0; i < value.keys.size(); ++i) add_totals(value.keys[i], value.items[i]);
    } else if (key == "taken_over") {
      add_taken_over(value);
    } else if (key == "custody") {
      if (value.scalar == "exact" && !states("custody_exact")) add("custody_exact", "ready");
      if (value.scalar == "none") turn_off({"custody_kept", "score_adds_up"});
    } else if (key == "collisions") {
      const OldLimits limits(value);
      if (!limits.most.empty() && number(limits.most) == 0.0) return;  // holds by default
      turn_off({"no_collision"});
      if (!limits.most.empty() || number(limits.least) > 0.0) add(key, "always " + limits.text("result(collisions)"));
    } else if (key == "score_vs_fault_free") {
      add_share(key, "score", "undisturbed_score", "score_share", 0.8, OldLimits(value));
    } else if (key == "score_vs_earned") {
      add_share(key, "score", "earned", "delivered_share", 0.99, OldLimits(value));
    } else if (key == "earned_vs_fault_free") {
      add_share(key, "earned", "undisturbed_earned", "", 0.0, OldLimits(value));
    } else if (key == "score" || key == "score_earned" || key == "points_detected" || key == "scans") {
      add(key, "always " + OldLimits(value).text("result(" + (key == "scans" ? "timing.scans" : key) + ")"));
    }
  }

  void add(const std::string& name, const std::string& value) {
    std::string free = name;
    for (int i = 2; !names_.insert(free).second; ++i) free = name + "_" + std::to_string(i);
    entries_.emplace_back(free, value);
  }

  const ConfigNode* states(const std::string& name) const {
    return present_ == nullptr || name.empty() ? nullptr : present_->find(name);
  }

  /// The default properties do not hold for capsules.
  void turn_off(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (!is_capsule_ && !states(name)) add(name, "off");
    }
  }

  /// The share that a ready property of the file asks for; 0: it is not a ready property. "80 %" is 0.8.
  static double share_of(const ConfigNode* property, double usual) {
    if (property == nullptr || (property->kind != Kind::map && property->scalar != "ready")) return 0.0;
    const ConfigNode* given = property->find("share");
    return given == nullptr ? usual : number(given->scalar) * (given->scalar.ends_with("%") ? 0.01 : 1.0);
  }

  /// @param ready, usual  a ready property that says the same, with its usual share; "": none
  void add_share(const std::string& name, const std::string& part, const std::string& whole, const std::string& ready,
                 double usual, const OldLimits& limits) {
    const bool is_bound = !ready.empty() && limits.most.empty();
    const double share = number(limits.least);
    const ConfigNode* stated = states(ready);
    if (is_bound && stated != nullptr && share_of(stated, usual) >= share) return;
    if (is_bound && stated == nullptr) {
      add(ready, share == usual ? "ready" : "{share: " + number_text(100.0 * share) + " %}");
      return;
    }
    const std::string both = limits.least.empty() || limits.most.empty() ? "" : " and ";
    add(name, "finally " + (limits.least.empty() ? "" : part + " >= " + limits.least + " * " + whole) + both +
                  (limits.most.empty() ? "" : part + " <= " + limits.most + " * " + whole));
  }

  void add_members(const std::string& name, const std::string& signal, const ConfigNode& members) {
    std::vector<std::string> texts, counts;
    for (const ConfigNode& member : members.items) {
      counts.push_back(signal + "(" + member.scalar + ")");
      texts.push_back(counts.back() + " >= 1");
    }
    texts.push_back(signal + " == " + (counts.empty() ? "0" : joined(counts, " + ")));
    add(name, (counts.empty() ? "always " : "finally ") + joined(texts, " and "));
  }

  void add_totals(const std::string& uav, const ConfigNode& limits) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < limits.keys.size(); ++i) {
      const std::string& key = limits.keys[i];
      texts.push_back(OldLimits(limits.items[i]).text("result(uavs." + uav + "." + key + ")", unit_of(key)));
    }
    if (!texts.empty()) add(uav + "_totals", "always " + joined(texts, " and "));
  }

  void add_taken_over(const ConfigNode& wanted) {
    const auto text = [&](const char* key, const char* usual) {
      const ConfigNode* given = wanted.find(key);
      return given == nullptr ? std::string(usual) : given->scalar;
    };
    const std::string uav = text("uav", ""), within_s = text("within_s", "30"), points = text("points", "1");
    add(uav + "_taken_over", "whenever rises(work_at_failure(" + uav + ")), eventually taken_over(" + uav +
                                 ") >= " + points + " within " + within_s + " s");
  }

  void add_window(const ConfigNode& window) {
    const ConfigNode* uavs = window.find("uavs");
    add_limits("fleet", "", window, window);
    if (uavs == nullptr) return;
    for (std::size_t i = 0; i < uavs->keys.size(); ++i) {
      add_limits(uavs->keys[i], "(" + uavs->keys[i] + ")", uavs->items[i], window);
    }
  }

  /// @param limits  of this subject, among other keys
  void add_limits(const std::string& subject, const std::string& argument, const ConfigNode& limits,
                  const ConfigNode& window) {
    std::vector<std::string> counts, ways;
    bool never_falls = true, only_from_above = true;
    for (std::size_t i = 0; i < limits.keys.size(); ++i) {
      const std::string& key = limits.keys[i];
      if (key == "after_s" || key == "until_s" || key == "uavs") continue;
      const OldLimits limit(limits.items[i]);
      if (key == "distance_m") {
        ways.push_back(limit.text("gain(distance" + argument + ")", " m"));
        continue;
      }
      counts.push_back(limit.text("gain(" + key + argument + ")"));
      never_falls = never_falls && key != "score";
      only_from_above = only_from_above && limit.only_from_above();
    }
    const std::string name = subject + when_name(window);
    const char* word = never_falls && only_from_above ? "always " : "finally ";
    // Events in the window's first exchange belong to the window, so `gain` must begin one exchange earlier.
    if (!counts.empty()) add(name, word + joined(counts, " and ") + when(window, Scenario{}.exchange_period_s));
    if (!ways.empty()) {
      add(counts.empty() ? name : subject + "_way" + when_name(window), "finally " + ways[0] + when(window, 0.0));
    }
  }

  /// Times of a window as the file spells them; empty: its beginning, or its end, is that of the run.
  std::pair<std::string, std::string> times(const ConfigNode& window) const {
    const ConfigNode *after = window.find("after_s"), *until = window.find("until_s");
    return {after != nullptr && number(after->scalar) > 0.0 ? after->scalar : "",
            until != nullptr && number(until->scalar) < duration_s_ ? until->scalar : ""};
  }
  std::string when_name(const ConfigNode& window) const {
    const auto [after, until] = times(window);
    std::string name = (after.empty() ? "" : "_from_" + after) + (until.empty() ? "" : "_to_" + until);
    std::ranges::replace(name, '.', '_');
    return name + (name.empty() ? "" : "_s");
  }
  /// @param earlier_s  begin the window by this much earlier
  std::string when(const ConfigNode& window, double earlier_s) const {
    const auto [after, until] = times(window);
    const std::string begin = number_text(std::max(0.0, number(after) - earlier_s)) + " s";
    if (!until.empty()) return " from " + begin + " to " + until + " s";
    return after.empty() ? "" : " after " + begin;
  }

  const ConfigDocument& document_;
  const ConfigNode& expect_;
  const ConfigNode* const present_;  ///< `properties` of the file
  const bool is_capsule_;
  double duration_s_ = 0.0;
  std::set<std::string> names_;
  std::vector<Entry> entries_;
};

// ---- the file's text --------------------------------------------------------------------------------------------

using Entries = std::vector<NewProperties::Entry>;

std::string block_text(const Entries& properties, const std::string& indent) {
  std::string text;
  for (const auto& [name, value] : properties) text += indent + name + ": " + value + "\n";
  return text;
}

/// The lines of a document, and where its keys are in them.
struct Lines {
  explicit Lines(const ConfigDocument& from) : document(from) {
    std::istringstream in(from.text);
    for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
  }

  /// The lines [first, last) of a key of the document with its value.
  std::pair<std::size_t, std::size_t> of(const std::string& key) const {
    const ConfigNode& root = document.root;
    const auto at = std::ranges::find(root.keys, key) - root.keys.begin();
    const auto first = static_cast<std::size_t>(root.key_lines[static_cast<std::size_t>(at)]) - 1;
    require(lines[first].starts_with(key), document, key, "cannot be converted: let `" + key + ":` begin a line");
    std::size_t last = lines.size();
    for (const int line : root.key_lines) {
      if (static_cast<std::size_t>(line) - 1 > first) last = std::min(last, static_cast<std::size_t>(line) - 1);
    }
    while (last > first + 1 && (lines[last - 1] == "\n" || lines[last - 1].starts_with('#'))) --last;
    return {first, last};
  }

  /// Adds entries to the `properties` that the file has.
  void insert(const ConfigNode& present, const Entries& properties) {
    require(present.kind == Kind::map, document, "properties",
            "names a file, to which convert adds nothing: add these to it, and remove `expect`:\n" +
                block_text(properties, "  "));
    const auto [first, last] = of("properties");
    if (lines[first].substr(0, lines[first].find('#')).find('{') == std::string::npos) {
      const std::string& entry = lines[static_cast<std::size_t>(present.key_lines.front()) - 1];
      lines[last - 1] += block_text(properties, entry.substr(0, entry.find_first_not_of(' ')));
      return;
    }
    std::string flow;
    for (const auto& [name, value] : properties) {
      const bool is_text = value.find(' ') != std::string::npos && value.front() != '{';
      flow += (flow.empty() && present.keys.empty() ? "" : ", ") + name + ": " + (is_text ? "'" + value + "'" : value);
    }
    const std::size_t end = lines[last - 1].rfind('}');
    if (end != std::string::npos) lines[last - 1].insert(end, flow);
  }

  const ConfigDocument& document;
  std::vector<std::string> lines;
};

}  // namespace

const std::vector<std::string>& old_expectations() {
  static const std::vector<std::string> keys = {
      "collisions", "score",          "score_earned", "points_detected", "scans",   "score_vs_fault_free",
      "uavs",       "during",         "left",         "rejoined",        "custody", "earned_vs_fault_free",
      "taken_over", "score_vs_earned"};
  return keys;
}

std::string converted(const ConfigDocument& document) {
  const ConfigNode& root = document.root;
  require(root.find("faults") != nullptr, document, "faults",
          "is missing, so this is not a fault test: one has a list of faults, or the name of a fault file");
  ConfigNode kept = root.find("expect") == nullptr ? ConfigNode{} : *root.find("expect");
  const std::size_t keys = kept.keys.size();
  for (const std::string& key : old_expectations()) kept.remove(key);
  if (kept.keys.size() == keys) return document.text;
  const Entries properties = NewProperties(document).entries();
  const ConfigNode* present = root.find("properties");
  Lines text(document);
  const auto [first, last] = text.of("expect");
  if (present != nullptr && !properties.empty()) text.insert(*present, properties);
  std::string instead;
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t comment = (" " + text.lines[i]).find(" #");
    if (comment != std::string::npos) instead += text.lines[i].substr(comment);
    text.lines[i].clear();
  }
  if (present == nullptr && !properties.empty()) instead += "properties:\n" + block_text(properties, "  ");
  const bool is_known = root.find("run") != nullptr || present != nullptr || !properties.empty();
  if (!kept.keys.empty() || !is_known) instead += "expect: " + flow_text(kept) + "\n";
  text.lines[first] = instead;
  const std::string all = joined(text.lines, "");
  const ConfigDocument now = parse_config_document(all, document.origin);
  const auto is_there = [&](const NewProperties::Entry& entry) {
    return now.root.find("properties")->find(entry.first);
  };
  require(std::ranges::all_of(properties, is_there), document, "properties",
          "cannot be converted: write each property on a line of its own");
  return all;
}

}  // namespace skein::cli

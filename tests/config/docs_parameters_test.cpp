// The tables of parameters in docs/conditions.md and docs/flight-core.md agree with the code: they list each key with
// its range, its values and the source of these values. The flight core does not get more constants.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <type_traits>
#include <vector>

#include "core/scenario/conditions_keys.hpp"
#include "core/text/text.hpp"
#include "tests/support/places.hpp"
#include "uav_agent/flight_core/flight_config.hpp"

namespace skein {
namespace {

/// A key of a struct with describe().
struct DescribedKey {
  std::string value;  ///< the default, as a page shows it; empty: none
  Bounds bounds;
  bool is_number = false;
};

/// Collects the keys of a struct, apart from `preset`.
class KeyCollector {
 public:
  static constexpr bool kReads = false;

  template <class T>
  void field(const std::string& key, const T& value, const Bounds& bounds = {}) {
    if constexpr (std::is_same_v<T, bool>) {
      keys[key] = {value ? "true" : "false", bounds, false};
    } else if constexpr (std::is_arithmetic_v<T>) {
      keys[key] = {shortest(static_cast<double>(value)), bounds, true};
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      keys[key] = {value ? shortest(*value) : "", bounds, true};
    } else {
      EXPECT_EQ(key, "preset");
    }
  }
  void check(bool, const std::string&, const std::string&) {}

  std::map<std::string, DescribedKey> keys;
};

template <class T>
std::map<std::string, DescribedKey> keys_of(T config) {
  KeyCollector collector;
  config_detail::call_describe(collector, config);
  return collector.keys;
}

/// A row of a table that is about one or more keys, which its first cell names: `a`, `b`.
struct ParameterRow {
  std::vector<std::string> keys, cells;
};

/// The rows of a page's table, which is found by the words in the first cell of its head.
std::vector<ParameterRow> rows_of_table(const std::string& page, const std::string& head) {
  static const std::regex kKey("`([a-z0-9_]+)`");
  std::ifstream in(source_path("docs/" + page));
  std::vector<ParameterRow> rows;
  bool in_table = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("| " + head + " |")) {
      in_table = true;
      continue;
    }
    if (!line.starts_with("|")) in_table = false;
    if (!in_table || line.starts_with("|-")) continue;
    ParameterRow row;
    for (std::string cell : split(line, '|')) {
      cell.erase(0, std::min(cell.size(), cell.find_first_not_of(' ')));
      cell.erase(cell.find_last_not_of(' ') + 1);
      row.cells.push_back(std::move(cell));
    }
    row.cells.erase(row.cells.begin());  // before the first bar
    const std::string& first = row.cells.front();
    for (std::sregex_iterator key(first.begin(), first.end(), kKey), end; key != end; ++key) {
      row.keys.push_back(key->str(1));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// "0.1 to 36,000" at the end of a cell.
void expect_bounds(const std::string& cell, const DescribedKey& key, const std::string& name) {
  if (!key.is_number) return;
  static const std::regex kRange(R"(.*?(above )?(-?[0-9.,]*[0-9]) to (-?[0-9.,]*[0-9])$)");
  std::smatch match;
  ASSERT_TRUE(std::regex_match(cell, match, kRange)) << name << ": " << cell;
  const auto number = [](std::string text) {
    std::erase(text, ',');
    return parse_number(text);
  };
  EXPECT_EQ(number(match.str(2)), key.bounds.lo) << name;
  EXPECT_EQ(number(match.str(3)), key.bounds.hi) << name;
  EXPECT_EQ(match.length(1) > 0, key.bounds.lo_open) << name;
}

/// Checks a cell, which has a value for each key of its row, or one value for all. For a key without a value, the cell
/// has words.
void expect_value(const ParameterRow& row, std::size_t column, std::size_t i, const std::string& expected) {
  const std::vector<std::string> values = split(row.cells.at(column));
  std::string value = values.size() == row.keys.size() ? values.at(i) : row.cells.at(column);
  value.erase(0, std::min(value.size(), value.find_first_not_of(' ')));
  if (expected.empty()) {
    EXPECT_FALSE(parse_number(value)) << row.keys[i] << ": " << value;
  } else if (parse_number(expected)) {
    EXPECT_EQ(parse_number(value), parse_number(expected)) << row.keys[i] << ": " << value;
  } else {
    EXPECT_EQ(value, expected) << row.keys[i];
  }
}

TEST(ConditionsPage, HasEveryKeyWithItsRangeItsPresetsAndASource) {
  for_each_section([](const std::string& section, auto member) {
    SCOPED_TRACE(section);
    std::vector<std::map<std::string, DescribedKey>> presets;
    for (const char* preset : kConditionPresets) presets.push_back(keys_of(conditions_preset(preset).*member));
    std::size_t found = 0;
    for (const ParameterRow& row : rows_of_table("conditions.md", "key of `" + section + "`")) {
      ASSERT_GE(row.cells.size(), 3 + presets.size()) << testing::PrintToString(row.cells);
      EXPECT_FALSE(row.cells[2 + presets.size()].empty()) << row.cells[0] << ": no source";
      for (std::size_t i = 0; i < row.keys.size(); ++i) {
        ASSERT_TRUE(presets[0].contains(row.keys[i])) << row.keys[i] << " is not a key of the code";
        ++found;
        expect_bounds(row.cells[1], presets[0].at(row.keys[i]), row.keys[i]);
        for (std::size_t p = 0; p < presets.size(); ++p) expect_value(row, 2 + p, i, presets[p].at(row.keys[i]).value);
      }
    }
    EXPECT_EQ(found, presets[0].size()) << "keys that the page lacks, or has twice";
  });
}

TEST(FlightCorePage, HasEveryParameterWithItsRangeItsDefaultAndASource) {
  const std::map<std::string, DescribedKey> keys = keys_of(agent::FlightConfig());
  std::size_t found = 0;
  for (const ParameterRow& row : rows_of_table("flight-core.md", "parameter")) {
    ASSERT_GE(row.cells.size(), 5U) << testing::PrintToString(row.cells);
    ASSERT_EQ(row.keys.size(), 1U) << row.cells[0];
    ASSERT_TRUE(keys.contains(row.keys[0])) << row.keys[0] << " is not a parameter of the code";
    ++found;
    expect_bounds(row.cells[1], keys.at(row.keys[0]), row.keys[0]);
    expect_value(row, 2, 0, keys.at(row.keys[0]).value);
    EXPECT_FALSE(row.cells[3].empty()) << row.keys[0] << ": no meaning";
    EXPECT_FALSE(row.cells[4].empty()) << row.keys[0] << ": no source";
  }
  EXPECT_EQ(found, keys.size()) << "parameters that the page lacks, or has twice";
  EXPECT_LE(keys.size(), 40U) << "too many parameters for a user to choose";
}

/// If you need another constant, make it a parameter, or remove an old constant. If there are fewer constants now,
/// lower the number.
TEST(FlightCoreConstants, DoNotIncreaseInNumber) {
  static const std::regex kConstant(R"(\bk[A-Z]\w*(\[\])? = \{?-?[0-9])");
  constexpr std::ptrdiff_t kMost = 136;
  std::ptrdiff_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_path("uav_agent/flight_core"))) {
    const std::string name = entry.path().filename();
    if (name.ends_with("_test.cpp") || name == "flight_config.hpp") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      if (line.find("constexpr") == std::string::npos) continue;
      count += std::distance(std::sregex_iterator(line.begin(), line.end(), kConstant), {});
    }
  }
  EXPECT_LE(count, kMost);
  EXPECT_GT(count, kMost / 2) << "the test no longer finds the constants";
}

}  // namespace
}  // namespace skein

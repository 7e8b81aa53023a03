// Properties as users write them: their meaning, the UAVs to which they apply, and the messages about wrong ones.
#include "signals/properties/property_parser.hpp"

#include <gtest/gtest.h>

namespace skein::properties {
namespace {

Scenario parser_fleet() {
  Scenario scenario;
  scenario.name = "small";
  scenario.duration_s = 60.0;
  for (const char* name : {"jurong", "changi", "nanyang"}) {
    UavConfig uav;
    uav.name = name;
    uav.vehicle.role = scenario.fleet.empty() ? Role::explorer : Role::photographer;
    scenario.fleet.push_back(uav);
  }
  return scenario;
}

std::vector<Property> parse(const std::string& text) { return parse_property("it", text, parser_fleet()); }

void refused(const std::string& text, std::size_t at, const std::string& words) {
  try {
    parse(text);
    ADD_FAILURE() << "accepted: " << text;
  } catch (const ExpressionError& error) {
    EXPECT_EQ(error.at, at) << text << ": " << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << text << ": " << error.what();
  }
}

TEST(PropertyParser, EachKindIsRead) {
  using enum Property::Kind;
  for (const auto& [text, kind] : {std::pair("always held < 3", always), std::pair("never held > 3", never),
                                   std::pair("sometimes held > 3", sometimes), std::pair("finally held > 3", finally),
                                   std::pair("eventually held > 3 within 5 s", eventually),
                                   std::pair("z(changi) < 1 m until time > 3 s", until)}) {
    const std::vector<Property> properties = parse(text);
    ASSERT_EQ(properties.size(), 1U) << text;
    EXPECT_EQ(properties[0].kind, kind) << text;
    EXPECT_TRUE(properties[0].bound.empty());
  }
}

TEST(PropertyParser, WindowsAreRead) {
  const auto window = [](const std::string& text) { return parse("eventually held > 3 " + text)[0].window; };
  EXPECT_EQ(window("").from, Window::From::start);
  EXPECT_EQ(window("within 5 s after heal").from, Window::From::heal);
  EXPECT_EQ(*window("within 500 ms after heal").within_s, 0.5);
  EXPECT_EQ(*window("after 20 s within 5 s").within_s, 5.0);
  EXPECT_EQ(window("after 20 s").from_s, 20.0);
  EXPECT_EQ(window("from 10 s to 2 * 10 s").from_s, 10.0);
  EXPECT_EQ(*window("from 10 s to 2 * 10 s").until_s, 20.0);
}

TEST(PropertyParser, VariablesTakeEachUavOnceAndNeverTheSameUavTwice) {
  EXPECT_EQ(parse("for u in uavs, always held(u) < 3").size(), 3U);
  EXPECT_EQ(parse("for u in explorers, always held(u) < 3")[0].bound, "u = jurong");
  const std::vector<Property> photographers = parse("for p in photographers, always z(p) < 9 m");
  ASSERT_EQ(photographers.size(), 2U);
  EXPECT_EQ(photographers[1].signals[0].text(), "z(nanyang)");
  const std::vector<Property> pairs = parse("for a in uavs, for b in photographers, always separation(a, b) > 1 m");
  ASSERT_EQ(pairs.size(), 4U);
  EXPECT_EQ(pairs[0].bound, "a = jurong, b = changi");
  EXPECT_EQ(pairs[2].bound, "a = changi, b = nanyang");
}

TEST(PropertyParser, WheneverHasItsOwnCondition) {
  const Property property = parse("whenever rises(restarts), eventually gain(captures) >= 1 within 9 s")[0];
  ASSERT_TRUE(property.whenever);
  EXPECT_EQ(property.signals.size(), 2U);
}

TEST(PropertyParser, WrongPropertiesAreRefusedWithTheColumn) {
  refused("alway held < 3", 0, "there is no signal 'alway'");
  refused("held < 3", 8, "here must be 'until'");
  refused("always held < 3 s", 14, "units do not fit");
  refused("eventually held > 3 within 5", 27, "what follows 'within' must be in s, and this is a plain number");
  refused("eventually held > 3 within 60 s", 27, "60 s are beyond the end: the mission of 'small' lasts 60 s");
  refused("eventually held > 3 after 50 s within 20 s", 20, "70 s are beyond the end");
  refused("eventually held > 3 within -1 s", 27, "must not be below 0 s");
  refused("always held < 3 from 20 s to 10 s", 29, "the interval is upside down");
  refused("always held < 3 from 20 s", 25, "here must be 'to', not the end");
  refused("always held < 3 after heal from 1 s to 2 s", 27, "a window has one beginning");
  refused("eventually held > 3 within 5 s within 6 s", 31, "stands here already");
  refused("sometimes held > 3 within 5 s", 19, "cannot have 'within'");
  refused("for u in drones, always held(u) < 3", 9, "there is no set 'drones'");
  refused("for m in uavs, always held(m) < 3", 4, "'m' means something else already");
  refused("for changi in uavs, always held(changi) < 3", 4, "means something else already");
  refused("for u in uavs always held(u) < 3", 14, "here must be ','");
  refused("for u in uavs, always held(v) < 3", 27, "there is no UAV 'v'");
  refused("eventually held > 3 within time", 27, "must be a number, not a signal");
  refused("always held < 3 and", 19, "not the end");
}

TEST(PropertyParser, AnIntervalNeedsAnExchange) {
  refused("always held < 3 from 5.01 s to 5.04 s", 31, "the next one at 5.05 s; let the interval end later");
  EXPECT_EQ(parse("always held < 3 from 5.01 s to 5.05 s").size(), 1U);
  EXPECT_EQ(parse("always held < 3 from 5.05 s to 5.06 s").size(), 1U);
}

TEST(PropertyParser, AVariableMustNotBeCalledAll) {
  // held(all) is the sum over the fleet, whatever a variable of this name stands for.
  refused("for all in uavs, always held(all) < 3", 4, "'all' means something else already");
}

TEST(PropertyParser, VariablesHaveABoundedNumberOfChoices) {
  Scenario scenario = parser_fleet();
  while (scenario.fleet.size() < 128) {
    scenario.fleet.push_back(scenario.fleet.back());
    scenario.fleet.back().name = "u" + std::to_string(scenario.fleet.size());
  }
  const std::string pairs = "for a in uavs, for b in uavs, ", condition = "always separation(a, b) > 1 m";
  EXPECT_EQ(parse_property("it", pairs + condition, scenario).size(), 128U * 127U);
  try {
    parse_property("it", pairs + "for c in uavs, for d in uavs, " + condition, scenario);
    ADD_FAILURE();
  } catch (const ExpressionError& error) {
    EXPECT_NE(std::string(error.what()).find("use fewer variables"), std::string::npos) << error.what();
  }
}

TEST(PropertyParser, ASetWithoutUavsIsRefused) {
  Scenario scenario = parser_fleet();
  scenario.fleet.erase(scenario.fleet.begin());
  EXPECT_THROW(parse_property("it", "for u in explorers, always held(u) < 3", scenario), ExpressionError);
}

}  // namespace
}  // namespace skein::properties

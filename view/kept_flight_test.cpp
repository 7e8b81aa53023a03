// A page that contains its flight has as many maps and points as its size limit allows.
#include "view/kept_flight.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "process/json_text.hpp"
#include "view/testing/unpacked.hpp"

namespace skein::view {
namespace {

/// The data that the page receives.
Json told_by(const std::string& text) {
  const std::vector<std::uint8_t> bytes = from_base64(text);
  std::string out(1 << 20, '\0');
  uLongf size = out.size();
  EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(out.data()), &size, bytes.data(), bytes.size()), Z_OK);
  return parse_json(out.substr(0, size));
}

std::string letters(std::mt19937& random, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>('a' + random() % 26);
  return text;
}

TEST(KeptFlight, HasPointsAndMapsAsFarAsTheSizeLimitAllows) {
  std::mt19937 random(3);
  Feed feed;
  feed.set_scene(R"({"clouds": {"lidar": ["a"], "maps": ["a", "b"]}})");
  feed.add_line(R"({"k":"pose"})");
  feed.set_cloud("lidar a", R"({"n":"lidar a","noise":")" + letters(random, 30'000) + "\"}");
  for (const char* uav : {"a", "b"}) {
    feed.set_cloud(std::string("map ") + uav,
                   R"({"n":"map )" + std::string(uav) + "\",\"noise\":\"" + letters(random, 10'000) + "\"}");
  }
  const std::string all = kept_flight(feed, 1'000'000), maps = kept_flight(feed, all.size() - 1);
  EXPECT_EQ(kept_flight(feed, all.size()), all);
  EXPECT_LT(maps.size(), all.size());
  const std::string none = kept_flight(feed, maps.size() - 1), nothing = kept_flight(feed, 0);
  const auto clouds_in = [](const Json& told) { return told.contains("clouds") ? told["clouds"].size() : 0U; };
  EXPECT_EQ(clouds_in(told_by(all)), 3U);
  EXPECT_EQ(told_by(all)["kept"], Json::parse(R"({"lidar": true, "maps": true})"));
  EXPECT_EQ(clouds_in(told_by(maps)), 2U);
  EXPECT_EQ(told_by(maps)["kept"], Json::parse(R"({"lidar": false, "maps": true})"));
  EXPECT_EQ(clouds_in(told_by(none)), 0U);
  EXPECT_EQ(told_by(none)["kept"], Json::parse(R"({"lidar": false, "maps": false})"));
  EXPECT_FALSE(told_by(nothing).contains("kept") || told_by(nothing).contains("clouds"));
  for (const std::string& text : {all, maps, none, nothing}) EXPECT_EQ(told_by(text)["lines"].size(), 1U);
}

TEST(KeptFlight, IsAJsonObjectAlsoWithoutAScene) {
  Feed feed;
  EXPECT_EQ(told_by(kept_flight(feed, 0)), Json::object());
  EXPECT_EQ(told_by(kept_flight(feed, 1'000'000)), Json::parse(R"({"kept": {"lidar": true, "maps": true}})"));
  feed.add_line(R"({"k":"pose"})");
  EXPECT_EQ(told_by(kept_flight(feed, 1)), Json::parse(R"({"kept": {"lidar": false, "maps": false}})"));
}

}  // namespace
}  // namespace skein::view

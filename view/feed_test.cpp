#include "view/feed.hpp"

#include <gtest/gtest.h>

namespace skein::view {
namespace {

constexpr std::size_t kMuch = 1 << 20;

TEST(Feeds, SendNothingBeforeThereIsAScene) {
  Feed feed;
  FeedPlace place;
  feed.add_line(R"({"a":1})");
  feed.set_state(R"({"t":1})");
  EXPECT_EQ(feed.next(place, kMuch), "");
  feed.set_scene(R"({"x":1})");
  EXPECT_EQ(feed.next(place, kMuch), R"({"scene":{"x":1},"lines":[{"a":1}],"state":{"t":1}})");
  EXPECT_EQ(feed.next(place, kMuch), "");
}

TEST(Feeds, SendTheNewestStateAndAllLines) {
  Feed feed;
  FeedPlace place;
  feed.set_scene("{}");
  feed.next(place, kMuch);
  for (int i = 0; i < 1000; ++i) {
    feed.add_line(std::to_string(i));
    feed.set_state("{\"n\":" + std::to_string(i) + "}");
  }
  int next_line = 0;
  for (std::string text = feed.next(place, 100); !text.empty(); text = feed.next(place, 100)) {
    EXPECT_LT(text.size(), 200U);
    const std::size_t begin = text.find('[') + 1, end = text.find(']');
    for (std::size_t at = begin; at < end; at = text.find_first_of(",]", at) + 1) {
      EXPECT_EQ(std::stoi(text.substr(at)), next_line++);
    }
    EXPECT_EQ(text.find("\"more\":true") == std::string::npos, next_line == 1000) << text;
    EXPECT_EQ(place.more, next_line < 1000);
    if (text.find("\"n\"") == std::string::npos) continue;
    EXPECT_NE(text.find(R"("state":{"n":999})"), std::string::npos) << text;
  }
  EXPECT_EQ(next_line, 1000);
}

TEST(Feeds, KeepAPlaceForEachReader) {
  Feed feed;
  feed.set_scene("{}");
  feed.add_line("1");
  FeedPlace early, late;
  feed.next(early, kMuch);
  feed.add_line("2");
  EXPECT_EQ(feed.next(early, kMuch), R"({"lines":[2]})");
  EXPECT_EQ(feed.next(late, kMuch), R"({"scene":{},"lines":[1,2]})");
}

TEST(Feeds, SendCloudsOnlyToViewersThatAskForThem) {
  Feed feed;
  FeedPlace looks, other, blind;
  feed.set_scene("{}");
  for (FeedPlace* place : {&looks, &other, &blind}) feed.next(*place, kMuch);
  feed.set_cloud("lidar a", R"({"n":1})");
  EXPECT_EQ(feed.next(looks, kMuch), "") << "no viewer has asked for clouds";
  looks.look_at({"lidar a", "map a"});
  other.look_at({"lidar b"});
  EXPECT_EQ(feed.next(looks, kMuch), R"({"clouds":[{"n":1}]})") << "a cloud that exists is sent at once";
  EXPECT_EQ(feed.next(looks, kMuch), "");
  looks.look_at({"lidar a", "map a"});
  EXPECT_EQ(feed.next(looks, kMuch), "") << "asking again must not send the cloud again";
  feed.set_cloud("map a", R"({"n":2})");
  feed.set_cloud("lidar a", R"({"n":3})");
  EXPECT_EQ(feed.next(looks, kMuch), R"({"clouds":[{"n":2},{"n":3}]})");
  looks.look_at({});
  feed.set_cloud("lidar a", R"({"n":4})");
  for (FeedPlace* place : {&looks, &other, &blind})
    EXPECT_EQ(feed.next(*place, kMuch), "") << "nobody asks for this cloud any more";
}

TEST(Feeds, SendTheNewestVersionOfEachCloud) {
  Feed feed;
  FeedPlace slow;
  feed.set_scene("{}");
  slow.look_at({"a", "b"});
  feed.next(slow, kMuch);
  const std::string much(300, '1');
  for (int i = 0; i < 1000; ++i) {
    feed.set_cloud("a", much + std::to_string(i));
    feed.set_cloud("b", much + std::to_string(i));
  }
  EXPECT_EQ(feed.next(slow, 100), "{\"clouds\":[" + much + "999]}") << "a cloud that is too large is sent alone";
  EXPECT_EQ(feed.next(slow, 100), "{\"clouds\":[" + much + "999]}");
  EXPECT_EQ(feed.next(slow, 100), "") << "older versions must not be sent";
  // A cloud that changes all the time does not keep the other one from being sent.
  feed.set_cloud("b", "2");
  for (const std::string& next : {much, std::string("2"), much}) {
    feed.set_cloud("a", much);
    EXPECT_EQ(feed.next(slow, 1), "{\"clouds\":[" + next + "]}");
  }
  EXPECT_EQ(feed.next(slow, 1), "");
}

/// All clouds change before each message, in the same order, and a message has room for some of them.
TEST(Feeds, CloudsTakeTurns) {
  const std::vector<std::string> names = {"a", "b", "c", "d", "e"};
  for (std::size_t room = 1; room <= names.size(); ++room) {
    Feed feed;
    FeedPlace slow;
    feed.set_scene("{}");
    feed.next(slow, kMuch);
    slow.look_at(names);
    std::string told;
    while (told.size() < 4 * names.size()) {
      for (const std::string& name : names) feed.set_cloud(name, name);
      const std::string text = feed.next(slow, std::string("[a").size() * room);
      for (const char c : text.substr(text.find('[')))
        told += std::string("abcde").find(c) < 5 ? std::string(1, c) : "";
    }
    EXPECT_EQ(told.substr(0, 20), "abcdeabcdeabcdeabcde") << room << " in a message";
  }
}

TEST(Feeds, ACloudThatABrowserNeverGotComesFirst) {
  Feed feed;
  FeedPlace place;
  feed.set_scene("{}");
  feed.next(place, kMuch);
  place.look_at({"a", "b"});
  for (const char* name : {"a", "b", "c"}) feed.set_cloud(name, std::string(1, *name));
  feed.next(place, kMuch);
  place.look_at({"a", "b", "c"});
  feed.set_cloud("b", "b");
  feed.set_cloud("a", "a");
  for (const char* next : {"c", "a", "b"}) EXPECT_EQ(feed.next(place, 1), std::string("{\"clouds\":[") + next + "]}");
}

TEST(Feeds, LinesComeBeforeClouds) {
  Feed feed;
  FeedPlace place;
  feed.set_scene("{}");
  place.look_at({"a"});
  for (int i = 0; i < 20; ++i) feed.add_line(std::string(50, '1'));
  feed.set_cloud("a", "2");
  std::string text = feed.next(place, 200);
  EXPECT_NE(text.find("more"), std::string::npos);
  EXPECT_EQ(text.find("clouds"), std::string::npos) << text;
  while (text.find("more") != std::string::npos) text = feed.next(place, 200);
  EXPECT_NE((text + feed.next(place, 200)).find(R"("clouds":[2])"), std::string::npos);
}

TEST(Feeds, ReportThatThereIsNews) {
  Feed feed;
  int news = 0;
  feed.on_news([&] { ++news; });
  feed.set_scene("{}");
  feed.add_line("1");
  feed.set_state("{}");
  feed.set_cloud("a", "{}");
  EXPECT_EQ(news, 4);
  feed.on_news({});
  feed.add_line("2");
  EXPECT_EQ(news, 4);
}

}  // namespace
}  // namespace skein::view

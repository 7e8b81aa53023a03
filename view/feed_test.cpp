#include "view/feed.hpp"

#include <gtest/gtest.h>

namespace skein::view {
namespace {

constexpr std::size_t kMuch = 1 << 20;

TEST(Feeds, TellNothingBeforeThereIsAScene) {
  Feed feed;
  FeedPlace place;
  feed.add_line(R"({"a":1})");
  feed.set_state(R"({"t":1})");
  EXPECT_EQ(feed.next(place, kMuch), "");
  feed.set_scene(R"({"x":1})");
  EXPECT_EQ(feed.next(place, kMuch), R"({"scene":{"x":1},"lines":[{"a":1}],"state":{"t":1}})");
  EXPECT_EQ(feed.next(place, kMuch), "");
}

TEST(Feeds, OfStatesTheNewestOfLinesAll) {
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
    if (text.find("\"n\"") == std::string::npos) continue;
    EXPECT_NE(text.find(R"("state":{"n":999})"), std::string::npos) << text;
  }
  EXPECT_EQ(next_line, 1000);
}

TEST(Feeds, EachReaderHasAPlaceOfItsOwn) {
  Feed feed;
  feed.set_scene("{}");
  feed.add_line("1");
  FeedPlace early, late;
  feed.next(early, kMuch);
  feed.add_line("2");
  EXPECT_EQ(feed.next(early, kMuch), R"({"lines":[2]})");
  EXPECT_EQ(feed.next(late, kMuch), R"({"scene":{},"lines":[1,2]})");
}

TEST(Feeds, SayWhenThereIsNews) {
  Feed feed;
  int news = 0;
  feed.on_news([&] { ++news; });
  feed.set_scene("{}");
  feed.add_line("1");
  feed.set_state("{}");
  EXPECT_EQ(news, 3);
  feed.on_news({});
  feed.add_line("2");
  EXPECT_EQ(news, 3);
}

}  // namespace
}  // namespace skein::view

// Frames: a reader returns each frame as it was sent, however the stream is divided into pieces.
#include "cli/place/frames.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein::cli {
namespace {

std::string drawn_text(std::mt19937& random, std::size_t most) {
  std::string text(std::uniform_int_distribution<std::size_t>(0, most)(random), '\0');
  for (char& letter : text) letter = static_cast<char>(random());
  return text;
}

TEST(Frames, ArriveUnchangedHoweverTheStreamIsDivided) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const bool already_greeted = seed % 2 == 0;
    std::string stream = already_greeted ? "" : "Welcome!\nnot a frame {\r\n" + std::string(kHostGreeting) + "\r\n";
    std::vector<Frame> sent;
    for (int i = 0; i < 10; ++i) {
      sent.push_back({{{"say", "log"}, {"number", i}, {"text", "line\nor \"two\" " + std::to_string(seed)}},
                      drawn_text(random, 300)});
      stream += bytes_of(sent.back().head, sent.back().body);
    }
    FrameReader reader(already_greeted);
    std::vector<Frame> received;
    while (!stream.empty()) {
      const std::size_t piece = std::uniform_int_distribution<std::size_t>(1, 80)(random);
      reader.add(stream.substr(0, piece));
      stream.erase(0, piece);
      while (auto frame = reader.next()) received.push_back(*frame);
    }
    ASSERT_EQ(received.size(), sent.size()) << seed;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      EXPECT_EQ(received[i].head["number"], sent[i].head["number"]);
      EXPECT_EQ(received[i].text("text"), sent[i].text("text"));
      EXPECT_EQ(received[i].body, sent[i].body);
    }
    if (!already_greeted) {
      EXPECT_EQ(reader.before_greeting(), "Welcome!\nnot a frame {\n");
    }
  }
}

TEST(Frames, AReaderThrowsOnInvalidBytesAndWaitsForTheRestOfAFrame) {
  for (const std::string text : {"garbage\n", "[1, 2]\n", "{\"bytes\": 99999999999}\n"}) {
    FrameReader reader(true);
    reader.add(text);
    EXPECT_THROW(static_cast<void>(reader.next()), std::runtime_error) << text;
  }
  FrameReader reader(true);
  reader.add("{\"say\": \"hello\"}");
  EXPECT_FALSE(reader.next().has_value());
}

// A program may write invalid UTF-8 to its status pipe.
TEST(Frames, CarryTextThatIsInvalidUtf8) {
  FrameReader reader(true);
  reader.add(bytes_of({{"say", "status"}, {"line", "\xff\xfe and more"}}));
  const auto frame = reader.next();
  ASSERT_TRUE(frame.has_value());
  EXPECT_NE(frame->text("line").find("and more"), std::string::npos);
}

}  // namespace
}  // namespace skein::cli

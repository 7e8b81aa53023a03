#include "core/planners/hand_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/math/random_stream.hpp"

namespace skein {
namespace {

class HandFileTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    const auto file = std::filesystem::path(testing::TempDir()) /
                      (std::string("hand-") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
    std::ofstream(file) << text;
    return file;
  }
  std::string refusal(const std::string& text) const {
    try {
      hand_file::read(write(text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(HandFileTest, NumbersAreReadBackBitForBit) {
  RandomStream random(7, "hand file", 0);
  std::vector<HandRow> rows;
  std::string text = hand_file::head();
  for (int i = 0; i < 500; ++i) {
    const auto drawn = [&] { return random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-12.0, 2.0)); };
    rows.push_back({static_cast<std::uint64_t>(3 * i), 60 * i, {{drawn(), drawn(), -0.0}, drawn(), drawn(), drawn()}});
    text += hand_file::line_of(rows.back());
  }
  const std::vector<HandRow> read = hand_file::read(write(text));
  ASSERT_EQ(read.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(read[i].step, rows[i].step);
    EXPECT_EQ(read[i].tick, rows[i].tick);
    EXPECT_EQ(read[i].command, rows[i].command) << text;
    EXPECT_TRUE(std::signbit(read[i].command.velocity.z())) << "the sign of a zero must be kept, too";
  }
}

TEST_F(HandFileTest, AFileWithoutCommandsIsEmpty) { EXPECT_TRUE(hand_file::read(write(hand_file::head())).empty()); }

TEST_F(HandFileTest, AFileSavedOnWindowsIsRead) {
  std::string text = hand_file::head() + "20,400,1,0,0,0,0,0.5\n40,800,0,0,0,0,0,0\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  const std::vector<HandRow> rows = hand_file::read(write(text));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].command.gimbal_yaw_rate, 0.5);
  EXPECT_EQ(rows[1].tick, 800);
}

TEST_F(HandFileTest, AnErrorIsReportedWithItsLine) {
  const std::string good = "20,400,1,0,0,0,0,0\n";
  EXPECT_NE(refusal("").find(":1: "), std::string::npos);
  EXPECT_NE(refusal("step,tick\n").find("begins with 'step,tick,ahead"), std::string::npos);
  for (const std::string wrong : {"40,800,1,0,0,0,0\n", "40,800,1,0,0,0,0,0,0\n", "40,800,x,0,0,0,0,0\n",
                                  "40,800,nan,0,0,0,0,0\n", "40,-800,1,0,0,0,0,0\n", "4.5,800,1,0,0,0,0,0\n", "\n"}) {
    EXPECT_NE(refusal(hand_file::head() + good + wrong).find(":3: "), std::string::npos) << wrong;
  }
  EXPECT_NE(refusal(hand_file::head() + good + good).find("tick 400 does not come after 400"), std::string::npos);
  EXPECT_THROW(hand_file::read("/no/such/file.csv"), InputError);
}

}  // namespace
}  // namespace skein

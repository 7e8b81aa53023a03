// The messages between programs and launcher. Their text on the pipes is a contract, because users' launchers read it,
// too. Any other text does no harm.
#include "process/status/status_lines.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

using status::Line;

/// A message of each kind, with its text on the pipe.
const std::vector<std::pair<Line, std::string>>& examples() {
  static const std::vector<std::pair<Line, std::string>> kExamples = {
      {status::Progress{.time_s = 12.5,
                        .mission_s = 10.0,
                        .duration_s = 600.0,
                        .phase = Phase::flying,
                        .in_contact = {"jurong"},
                        .alive = 2,
                        .lost = {"changi"}},
       R"({"alive":2,"duration_s":600.0,"in_contact":["jurong"],"lost":["changi"],"mission_s":10.0,"phase":"flying",)"
       R"("t":12.5,"type":"progress"})"},
      {status::Tally{.points = 3, .score = 1.5, .earned = 2.5},
       R"({"earned":2.5,"points":3,"score":1.5,"type":"tally"})"},
      {status::WaitingFor{
           .members = {"jurong"}, .missing = {"rt/plan 3 of 4"}, .what = "to answer", .seconds = 5.0, .due = true},
       R"({"due":true,"members":["jurong"],"missing":["rt/plan 3 of 4"],"seconds":5.0,"type":"waiting_for",)"
       R"("what":"to answer"})"},
      {status::Order{.member = "jurong", .order = status::Order::What::resume, .time_s = 7.0},
       R"({"member":"jurong","order":"continue","t":7.0,"type":"order"})"},
      {status::Warning{.text = "oh \"no\""}, R"({"text":"oh \"no\"","type":"warning"})"},
      {status::Rejoined{.member = "jurong"}, R"({"member":"jurong","type":"rejoined"})"},
      {status::Ended{.status = RunStatus::no_takeoff, .stalled = {"jurong"}},
       R"({"stalled":["jurong"],"status":"no_takeoff","type":"ended"})"},
      {status::Report{.report = {{"score", 1.5}, {"a", nullptr}}},
       R"({"report":{"a":null,"score":1.5},"type":"report"})"}};
  return kExamples;
}

TEST(StatusLines, EachKindOfLineHasAnExample) {
  ASSERT_EQ(examples().size(), std::variant_size_v<Line>);
  for (std::size_t i = 0; i < examples().size(); ++i) EXPECT_EQ(examples()[i].first.index(), i);
}

TEST(StatusLines, TheTextOnThePipeDoesNotChange) {
  for (const auto& [line, text] : examples()) EXPECT_EQ(status::line_json(line).dump(), text);
}

TEST(StatusLines, AreReadBack) {
  for (const auto& [line, text] : examples()) {
    const auto read = status::read_line(text);
    ASSERT_TRUE(read) << text;
    EXPECT_EQ(read->index(), line.index());
    EXPECT_EQ(status::line_json(*read).dump(), text);
  }
}

TEST(StatusLines, OtherLinesAreNotStatusLines) {
  for (const char* text : {"", "{", "hello", "3", "[]", "null", "{}", R"({"type":"dance"})", R"({"type":7})",
                           R"({"type":null})", R"({"Type":"progress"})", "\xff\xfe"}) {
    EXPECT_FALSE(status::read_line(text)) << text;
  }
  EXPECT_FALSE(status::read_line(std::string(200000, '[') + std::string(200000, ']')));
}

/// Reads each example without each of its values, and with each of them replaced by other values.
TEST(StatusLines, DamagedLinesAreReadWithTheirIntactValues) {
  const std::vector<Json> odd = {nullptr, true, -1, 1e300, "odd", Json::array({3, "x"}), Json::object({{"x", 1}})};
  for (const auto& [line, text] : examples()) {
    const Json whole = parse_json(text);
    for (const auto& [key, value] : whole.items()) {
      if (key == "type") continue;
      Json damaged = whole;
      damaged.erase(key);
      auto read = status::read_line(damaged.dump());
      ASSERT_TRUE(read) << damaged;
      EXPECT_EQ(read->index(), line.index()) << damaged;
      for (const Json& other : odd) {
        damaged[key] = other;
        read = status::read_line(damaged.dump());
        ASSERT_TRUE(read) << damaged;
        EXPECT_EQ(read->index(), line.index()) << damaged;
      }
    }
  }
  const auto progress = std::get<status::Progress>(*status::read_line(R"({"type":"progress","t":"x","phase":3})"));
  EXPECT_EQ(progress.time_s, 0.0);
  EXPECT_EQ(progress.phase, Phase::waiting);
  EXPECT_TRUE(std::get<status::Report>(*status::read_line(R"({"type":"report","report":3})")).report.is_object());
}

TEST(Orders, TheTextOnThePipeDoesNotChangeAndIsReadBack) {
  EXPECT_EQ(orders::text_of(orders::Stop{}), "stop");
  EXPECT_EQ(orders::text_of(orders::Lost{"jurong"}), "lost jurong");
  EXPECT_TRUE(std::holds_alternative<orders::Stop>(*orders::read_line("stop")));
  EXPECT_EQ(std::get<orders::Lost>(*orders::read_line("lost jurong")).member, "jurong");
  for (const char* text : {"", "stop it", "lost", "Stop", "{}", "find jurong"}) {
    EXPECT_FALSE(orders::read_line(text)) << text;
  }
}

}  // namespace
}  // namespace skein

#include "process/status/shared_lines.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace skein::shared_lines {
namespace {

TEST(SharedLines, NewsAreReadBackUnchanged) {
  const auto said = read_news(said_by("station", {{"type", "tally"}, {"points", 3}}).dump());
  ASSERT_TRUE(said && std::holds_alternative<Said>(*said));
  EXPECT_EQ(std::get<Said>(*said).program, "station");
  EXPECT_EQ(std::get<Said>(*said).line["points"], 3);
  const auto ended = read_news(news_json(Ended{"uav_agent-jurong", 3, SIGSEGV, true}).dump());
  ASSERT_TRUE(ended && std::holds_alternative<Ended>(*ended));
  EXPECT_EQ(std::get<Ended>(*ended).program, "uav_agent-jurong");
  EXPECT_EQ(std::get<Ended>(*ended).code, 3);
  EXPECT_EQ(std::get<Ended>(*ended).signal, SIGSEGV);
  EXPECT_TRUE(std::get<Ended>(*ended).fatal);
  const auto stopped = read_news(news_json(Stopped{"comm_router"}).dump());
  ASSERT_TRUE(stopped && std::holds_alternative<Stopped>(*stopped));
  EXPECT_EQ(std::get<Stopped>(*stopped).program, "comm_router");
}

TEST(SharedLines, OrdersAreReadBackUnchanged) {
  const Start start{"sim_server", {"/bin/sim server", "--out", "a \"folder\"\n"}, "/tmp/a b.log", true};
  const auto started = read_order(text_of(start));
  ASSERT_TRUE(started && std::holds_alternative<Start>(*started));
  EXPECT_EQ(std::get<Start>(*started).program, start.program);
  EXPECT_EQ(std::get<Start>(*started).argv, start.argv);
  EXPECT_EQ(std::get<Start>(*started).log, start.log);
  EXPECT_TRUE(std::get<Start>(*started).append_log);
  const auto told = read_order(text_of(Tell{"sim_server", "lost jurong"}));
  ASSERT_TRUE(told && std::holds_alternative<Tell>(*told));
  EXPECT_EQ(std::get<Tell>(*told).line, "lost jurong");
  const auto signal = read_order(text_of(Signal{"station", SIGCONT}));
  ASSERT_TRUE(signal && std::holds_alternative<Signal>(*signal));
  EXPECT_EQ(std::get<Signal>(*signal).signal, SIGCONT);
  for (const auto& text : {text_of(start), text_of(Tell{"a", "b"})}) EXPECT_EQ(text.find('\n'), std::string::npos);
}

// A planner in the process may write anything to any descriptor.
TEST(SharedLines, OtherTextIsNeitherNewsNorAnOrder) {
  for (const char* text : {"", "{}", "[]", "null", "{\"ended\": 3}", "{\"said_by\": null, \"line\": 1}",
                           "{\"type\": \"ended\"}", "ended", "{\"start\": {}}"}) {
    EXPECT_FALSE(read_news(text)) << text;
    EXPECT_FALSE(read_order(text)) << text;
  }
}

}  // namespace
}  // namespace skein::shared_lines

#include "process/reports/program_report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>

namespace skein {
namespace {

class ProgramReport : public testing::Test {
 protected:
  ProgramReport() { EXPECT_EQ(::pipe(pipe_.data()), 0); }
  ~ProgramReport() override {
    for (const int end : pipe_) ::close(end);
    std::filesystem::remove(file_);
  }
  nlohmann::json line() const {
    std::array<char, 4096> text{};
    const ssize_t size = ::read(pipe_[0], text.data(), text.size());
    return nlohmann::json::parse(std::string(text.data(), static_cast<std::size_t>(size)));
  }

  std::array<int, 2> pipe_{};
  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("skein_report_" + std::to_string(::getpid()));
};

TEST(AddNew, AddsEachTextThatTheListDoesNotContainOnce) {
  std::vector<std::string> texts = {"b", "a"};
  add_new({"a", "d", "c", "d"}, texts);
  EXPECT_EQ(texts, (std::vector<std::string>{"b", "a", "d", "c"}));
}

TEST_F(ProgramReport, GoesToTheLauncherAndToAFile) {
  StatusPipe status(pipe_[1]);
  hand_in_report({{"score", 7}}, file_, status);
  EXPECT_EQ(line(), (nlohmann::json{{"type", "report"}, {"report", {{"score", 7}}}}));
  Json written = read_json(file_);
  EXPECT_TRUE(has_sound_checksum(written));
  EXPECT_EQ(written.erase(kChecksum), 1U);
  EXPECT_EQ(written, (Json{{"score", 7}}));
}

TEST_F(ProgramReport, ReplacesInvalidUtf8InValues) {
  StatusPipe status(pipe_[1]);
  hand_in_report({{"name", "caf\xe9"}}, file_, status);
  EXPECT_EQ(line()["report"]["name"], "caf\xef\xbf\xbd");
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(file_))["name"], "caf\xef\xbf\xbd");
}

TEST_F(ProgramReport, ReachesTheLauncherAlsoIfItsFileCannotBeWritten) {
  StatusPipe status(pipe_[1]);
  hand_in_report({{"score", 7}, {"unwritten", {"x"}}}, file_ / "below", status);
  const nlohmann::json report = line()["report"];
  EXPECT_EQ(report["score"], 7);
  ASSERT_EQ(report["unwritten"].size(), 2U);
  EXPECT_NE(report["unwritten"][1].get<std::string>().find(file_.string()), std::string::npos);
}

TEST_F(ProgramReport, ReplacesInvalidUtf8InLists) {
  StatusPipe status(pipe_[1]);
  hand_in_report({{"no_way", {"no way: \xff"}}}, file_, status);
  const nlohmann::json told = line()["report"];
  nlohmann::json written = nlohmann::json::parse(std::ifstream(file_));
  written.erase(kChecksum);
  EXPECT_EQ(told, written);
  EXPECT_EQ(written["no_way"][0], "no way: \xef\xbf\xbd");
}

TEST_F(ProgramReport, WithoutALauncherAFileThatCannotBeWrittenIsAnError) {
  StatusPipe no_launcher(-1);
  EXPECT_THROW(hand_in_report({{"score", 7}}, file_ / "below", no_launcher), std::runtime_error);
}

}  // namespace
}  // namespace skein

// The folder of a hunt: it goes on there, and no option deletes a find.
#include "cli/hunt/log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/types.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

class HuntLogs : public testing::Test {
 protected:
  HuntLogs() { fs::create_directories(dir_); }
  ~HuntLogs() override { fs::remove_all(dir_); }

  void find(const std::string& name) const {
    fs::create_directories(dir_ / "finds" / name);
    std::ofstream(dir_ / "finds" / (name + ".yaml")) << "name: " << name << '\n';
  }
  static std::string text_in(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const fs::path dir_ = fs::path(testing::TempDir()) / ("skein_hunt_log_" + std::to_string(::getpid()));
  const Json one_{{"seed", 1}}, other_{{"seed", 2}};
};

TEST_F(HuntLogs, BeginningAnewKeepsAndNamesTheFindsOfEveryHuntBefore) {
  HuntLog(dir_, one_, false).add(0, "first", {.digest = "ab"});
  find("separation-3");
  find("all_fly_on-17");
  EXPECT_THROW(HuntLog(dir_, other_, false), InputError);
  const HuntLog second(dir_, other_, true);
  EXPECT_TRUE(second.outcomes().empty());
  EXPECT_EQ(second.kept(), (std::vector<fs::path>{dir_ / "earlier/1/finds/all_fly_on-17.yaml",
                                                  dir_ / "earlier/1/finds/separation-3.yaml"}));
  EXPECT_EQ(text_in(second.kept().front()), "name: all_fly_on-17\n");
  EXPECT_TRUE(fs::is_directory(dir_ / "earlier/1/finds/separation-3")) << "the results folder of the find";
  EXPECT_NE(text_in(dir_ / "earlier/1/log.jsonl").find("\"first\""), std::string::npos);
  EXPECT_EQ(parse_json(text_in(dir_ / "earlier/1/hunt.json")), one_);

  find("separation-3");
  const HuntLog third(dir_, other_, true);
  EXPECT_EQ(third.kept(), std::vector<fs::path>{dir_ / "earlier/2/finds/separation-3.yaml"})
      << "the same settings, too";
  EXPECT_EQ(second.kept().size(), 2U);
  EXPECT_TRUE(fs::exists(dir_ / "earlier/1/finds/separation-3.yaml"));
}

TEST_F(HuntLogs, ThatGoOnKeepFindsWhereTheyAre) {
  HuntLog(dir_, one_, false).add(0, "first", {.digest = "ab"});
  find("separation-3");
  const HuntLog again(dir_, one_, false);
  EXPECT_TRUE(again.kept().empty());
  EXPECT_EQ(again.outcomes().size(), 1U);
  EXPECT_TRUE(fs::exists(dir_ / "finds/separation-3.yaml"));
}

TEST_F(HuntLogs, WithoutFindsNothingIsKept) {
  HuntLog(dir_, one_, false).add(0, "first", {.digest = "ab"});
  const HuntLog second(dir_, other_, true);
  EXPECT_TRUE(second.kept().empty());
  EXPECT_FALSE(fs::exists(dir_ / HuntLog::kEarlier));
}

}  // namespace
}  // namespace skein::cli

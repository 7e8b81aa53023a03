#include "results/result_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "core/types.hpp"
#include "results/run_folder.hpp"

namespace skein::results {
namespace {

class ResultFile : public ::testing::Test {
 protected:
  ResultFile() {
    std::string name = (std::filesystem::temp_directory_path() / "skein-result-XXXXXX").string();
    run_ = ::mkdtemp(name.data());
  }
  ~ResultFile() override { std::filesystem::remove_all(run_); }

  void write(const std::string& text) { std::ofstream(run_ / run_folder::kResult, std::ios::binary) << text; }

  static Json some_result() {
    return {{"scenario", "towers"},
            {"status", "completed"},
            {"seed", 7},
            {"score", 4.071234567890123},
            {"digest", nullptr},
            {"uavs", Json::array({{{"name", "jurong"}, {"distance_m", 1e-7}, {"alive", true}}})},
            {"warnings", {"a \xFF that is not UTF-8", "two\nlines"}},
            {"wall_time_s", 12.5}};
  }

  std::filesystem::path run_;
};

TEST_F(ResultFile, AWrittenResultIsReadInAnyLayout) {
  const std::string text = result_text(some_result());
  write(text);
  const Json result = read_result_file(run_);
  EXPECT_EQ(result["score"], some_result()["score"]);
  write(result.dump());
  EXPECT_EQ(read_result_file(run_), result);
  EXPECT_EQ(result_text(result), text) << "a result that is written again has only one checksum";
}

TEST_F(ResultFile, AFlippedBitIsDetected) {
  const auto seed = static_cast<unsigned>(::getpid());
  std::mt19937_64 random(seed);
  const std::string text = result_text(some_result());
  write(text);
  const Json sound = read_result_file(run_);
  for (int draw = 0; draw < 3000; ++draw) {
    const std::uint64_t bit = random() % (8 * text.size());
    std::string bad = text;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
    write(bad);
    try {
      Json read = read_result_file(run_);
      // A bit in the name of the checksum's key, or the case bit of an exponent's letter, changes no figure.
      Json expected = sound;
      if (!read.contains(kChecksum)) {
        expected.erase(kChecksum);
        read.erase(std::prev(read.end()));
      }
      ASSERT_EQ(read, expected) << "seed " << seed << " bit " << bit;
    } catch (const InputError& error) {
      ASSERT_NE(std::string(error.what()).find((run_ / run_folder::kResult).string()), std::string::npos);
      ASSERT_NE(std::string(error.what()).find("damaged"), std::string::npos);
    }
  }
}

TEST_F(ResultFile, AResultOfAnEarlierVersionIsReadWithoutAChecksum) {
  write(some_result().dump(2, ' ', false, Json::error_handler_t::replace));
  EXPECT_EQ(read_result_file(run_)["seed"], 7);
}

TEST_F(ResultFile, MissingFilesAndOtherJsonThanObjectsAreReported) {
  const auto complaint = [&] {
    try {
      read_result_file(run_);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint().find("there is no result.json in it"), std::string::npos);
  const std::string damaged = (run_ / run_folder::kResult).string() + ": is damaged: ";
  for (const char* text : {"[1]", "[]", "null", "", "3"}) {
    write(text);
    EXPECT_EQ(complaint(), damaged + "it is not a JSON object") << text;
  }
  write("{}");
  EXPECT_EQ(complaint(), damaged + "status: is missing, so it is not the result of a run");
  write(R"({"status": "completed", "score": "4.1"})");
  EXPECT_EQ(complaint(), damaged + "score: must be a number, not \"4.1\"");
}

/// The cause lies in the path to the file: a circle of links, or a file in place of a folder. So the message must not
/// say that the run left no result. Permissions are the usual cause, but do not bind root, who may run this test.
TEST_F(ResultFile, TheReasonWhyItCannotBeReadIsReported) {
  const auto complaint = [](const std::filesystem::path& run) {
    try {
      read_result_file(run);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::filesystem::path circle = run_ / "circle", file = run_ / "file";
  std::filesystem::create_symlink(circle, circle);
  std::ofstream(file) << "x";
  EXPECT_EQ(complaint(circle),
            (circle / run_folder::kResult).string() + ": cannot be read (Too many levels of symbolic links)");
  EXPECT_EQ(complaint(file), file.string() + ": is not a folder");
  EXPECT_EQ(complaint(run_ / "none"), (run_ / "none").string() + ": there is no such folder");
  EXPECT_NE(complaint(run_ / std::string(300, 'x')).find("cannot be read (File name too long)"), std::string::npos);
  std::filesystem::create_symlink(circle, run_ / run_folder::kResult);
  EXPECT_EQ(complaint(run_),
            (run_ / run_folder::kResult).string() + ": cannot be read (Too many levels of symbolic links)");
  std::filesystem::remove(run_ / run_folder::kResult);
  std::filesystem::create_directory(run_ / run_folder::kResult);
  EXPECT_EQ(complaint(run_), (run_ / run_folder::kResult).string() + ": not a regular file");
}

TEST_F(ResultFile, AFolderThatMayNotBeSearchedIsNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may search every folder";
  write(result_text(some_result()));
  std::filesystem::permissions(run_, std::filesystem::perms::none);
  try {
    read_result_file(run_);
    ADD_FAILURE() << "the result was read";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot be read (Permission denied)"), std::string::npos) << error.what();
  }
  std::filesystem::permissions(run_, std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace skein::results

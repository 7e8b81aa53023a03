#include "core/files/file_bytes.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <fstream>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

class FileBytes : public testing::Test {
 protected:
  FileBytes() {
    std::string pattern = fs::path(testing::TempDir()) / "skein_bytes_XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
    std::ofstream(folder_ / "text") << "one\n\nthree";
    std::ofstream(folder_ / "hole");
    fs::resize_file(folder_ / "hole", std::uintmax_t{1} << 40);
    EXPECT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  }
  ~FileBytes() override { fs::remove_all(folder_); }

  std::string complaint(auto read) {
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  fs::path folder_;
};

TEST_F(FileBytes, APathThatIsNoRegularFileIsRefusedAtOnceAndNamed) {
  for (const fs::path& file : {folder_ / "pipe", folder_, fs::path("/dev/zero"), fs::path("/dev/full")}) {
    EXPECT_EQ(complaint([&] { read_file_bytes(file, 100); }), file.string() + ": not a regular file");
    EXPECT_EQ(complaint([&] { open_text(file); }), file.string() + ": not a regular file");
  }
  EXPECT_EQ(complaint([&] { read_file_bytes(folder_ / "none", 100); }), (folder_ / "none").string() + ": no such file");
  EXPECT_FALSE(open_text(folder_ / "none"));
  const fs::path loop = folder_ / "loop", below = folder_ / "text/below";
  fs::create_symlink(loop, loop);
  EXPECT_EQ(complaint([&] { read_file_bytes(loop, 100); }),
            loop.string() + ": cannot be read (Too many levels of symbolic links)");
  EXPECT_EQ(complaint([&] { read_file_bytes(below, 100); }), below.string() + ": no such file");
}

TEST_F(FileBytes, AFileThatIsTooLargeIsRefusedBeforeItIsRead) {
  EXPECT_NE(complaint([&] { read_file_bytes(folder_ / "hole", 1 << 20); }).find("1048576 MB"), std::string::npos);
  fs::resize_file(folder_ / "text", 5000);
  EXPECT_EQ(complaint([&] { read_file_bytes(folder_ / "text", 2048); }),
            (folder_ / "text").string() + ": has 4 kB, more than the 2 kB that are accepted");
  std::ifstream hole = open_text(folder_ / "hole");
  std::string line;
  EXPECT_NE(complaint([&] { next_line(hole, line, folder_ / "hole"); }).find("it is not text"), std::string::npos);
}

TEST_F(FileBytes, NextLineReadsTheSameLinesAsGetline) {
  for (const std::string text : {"one\n\nthree", "one\n\nthree\n", "", "\n"}) {
    std::ofstream(folder_ / "text") << text;
    std::ifstream a = open_text(folder_ / "text"), b(folder_ / "text");
    for (bool more = true; more;) {
      std::string line_a, line_b;
      more = static_cast<bool>(std::getline(b, line_b));
      ASSERT_EQ(next_line(a, line_a, "text"), more);
      EXPECT_EQ(line_a, line_b);
      EXPECT_EQ(a.eof(), b.eof());
    }
  }
}

TEST_F(FileBytes, LinesOfAFileFromWindowsHaveNoCarriageReturns) {
  std::ofstream(folder_ / "text") << "one\r\n\r\nt\rwo\r\r\nthree";
  std::ifstream in = open_text(folder_ / "text");
  std::vector<std::string> lines;
  for (std::string line; next_line(in, line, "text");) lines.push_back(line);
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "", "t\rwo\r", "three"}));
}

}  // namespace
}  // namespace skein

#include "process/files/stream_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <random>
#include <system_error>

#include "tests/support/text_files.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

class StreamFileTest : public testing::Test {
 protected:
  ~StreamFileTest() override { fs::remove(file_); }
  std::string content() const { return read_text(file_); }
  const fs::path file_ = fs::path(testing::TempDir()) / ("skein_stream_" + std::to_string(::getpid()));
};

TEST_F(StreamFileTest, ContainsTheWrittenText) {
  {
    StreamFile file(file_);
    file << "a,b\n"
         << "1,2\n";
    EXPECT_EQ(file.write_error(), "");
  }
  EXPECT_EQ(content(), "a,b\n1,2\n");
  { StreamFile(file_, StreamFile::Mode::append) << "3,4\n"; }
  EXPECT_EQ(content(), "a,b\n1,2\n3,4\n");
  { StreamFile file(file_); }
  EXPECT_EQ(content(), "");
}

TEST_F(StreamFileTest, TheErrorNamesAFileThatCannotBeOpened) {
  try {
    StreamFile file(file_ / "below");
    FAIL() << "no exception, although the file has no folder";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos) << error.what();
  }
}

TEST_F(StreamFileTest, ReportsAFullDiskWithoutAnException) {
  StreamFile file("/dev/full");
  file << "some words\n";
  file.flush();
  EXPECT_EQ(file.write_error(), "cannot write /dev/full: No space left on device");
  file << "more\n";
  file.flush();
  EXPECT_EQ(file.write_error(), "cannot write /dev/full: No space left on device");
}

TEST_F(StreamFileTest, AFileThatReachesItsSizeLimitEndsWithAWholeLine) {
  std::mt19937 draw(20);
  for (int round = 0; round < 20; ++round) {
    const rlim_t limit = 1 + draw() % 40000;
    const pid_t child = ::fork();  // so that the limit does not apply to this process
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::signal(SIGXFSZ, SIG_IGN);
      const rlimit size{limit, limit};
      ::setrlimit(RLIMIT_FSIZE, &size);
      StreamFile file(file_);
      for (int line = 0; line < 5000; ++line) file << std::to_string(line) + ",7.25\n";
      file.flush();
      ::_exit(file.write_error().empty() ? 1 : 0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0) << "the child reported no error at a limit of " << limit << " bytes";
    std::string expected;
    for (int line = 0; expected.size() + std::to_string(line).size() + 6 <= limit; ++line) {
      expected += std::to_string(line) + ",7.25\n";
    }
    EXPECT_EQ(content(), expected) << limit;
  }
}

}  // namespace
}  // namespace skein

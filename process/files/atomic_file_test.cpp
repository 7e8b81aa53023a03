#include "process/files/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <system_error>

#include "core/files/file_bytes.hpp"
#include "core/types.hpp"
#include "tests/support/limited_files.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public ::testing::Test {
 protected:
  AtomicFile() {
    std::string pattern = (fs::path(::testing::TempDir()) / "skein_atomic_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~AtomicFile() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(AtomicFile, WritesAndReplaces) {
  const fs::path file = folder_ / "result.json";
  write_file_atomically(file, "old");
  EXPECT_EQ(read_file_bytes(file, 100), "old");
  const std::string large(1 << 20, 'x');
  write_file_atomically(file, large);
  EXPECT_EQ(read_file_bytes(file, 1 << 21), large);
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, AFileWrittenWithoutAFlushReadsTheSame) {
  const fs::path file = folder_ / "result.json";
  write_file_atomically(file, "old", Readers::all, Flush::none);
  write_file_atomically(file, "new", Readers::all, Flush::none);
  EXPECT_EQ(read_file_bytes(file, 100), "new");
  EXPECT_EQ(files(), 1u);
  EXPECT_THROW(write_file_atomically(folder_ / "none" / "result.json", "x", Readers::all, Flush::none),
               std::runtime_error);
}

TEST_F(AtomicFile, LeavesNothingBehindWhenItFails) {
  EXPECT_THROW(write_file_atomically(folder_ / "none" / "result.json", "x"), std::runtime_error);
  fs::create_directory(folder_ / "taken");
  EXPECT_THROW(write_file_atomically(folder_ / "taken", "x"), std::runtime_error);
  EXPECT_EQ(files(), 1u);
}

// The link makes the reasons differ: open() does not find its target, and close_to_agents() follows no link.
TEST_F(AtomicFile, AFileThatCannotBeCreatedIsReportedWithTheReasonOfOpen) {
  const fs::path file = folder_ / "result.json";
  fs::create_symlink(folder_ / "none" / "file", file.string() + ".tmp" + std::to_string(::getpid()));
  try {
    write_file_atomically(file, "x", Readers::no_agents);
    ADD_FAILURE() << "the file cannot be created, but no error was reported";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory) << error.what();
  }
}

TEST_F(AtomicFile, AFileThatAnotherProgramWroteCanReplaceTheFormerOne) {
  const fs::path file = folder_ / "skein.tar.gz", finished = folder_ / "skein.tar.gz.tmp";
  write_file_atomically(file, "old");
  try {
    put_in_place(finished, file);
    ADD_FAILURE() << "the finished file does not exist, but no error was reported";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.what(), "cannot write " + file.string() + ": No such file or directory");
  }
  EXPECT_EQ(read_file_bytes(file, 100), "old");
  write_file_atomically(finished, "new");
  put_in_place(finished, file);
  EXPECT_EQ(read_file_bytes(file, 100), "new");
  EXPECT_EQ(files(), 1u);
}

constexpr int kNoMounts = 77;

/// Runs `body` in a process in which the file is mounted on itself, as in a container. @returns its exit code
int with_mounted(const fs::path& file, const std::function<int()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    const bool elsewhere = ::unshare(CLONE_NEWNS) == 0 || ::unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0;
    if (!elsewhere || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount(file.c_str(), file.c_str(), nullptr, MS_BIND, nullptr) != 0) {
      ::_exit(kNoMounts);
    }
    ::_exit(body());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(AtomicFile, AMountedFileThatTheUserNamedIsOverwritten) {
  const fs::path file = folder_ / "compose.yaml";
  for (const std::string& text : {std::string("longer than before"), std::string("short"), std::string()}) {
    write_file_atomically(file, "former text");
    const int code = with_mounted(file, [&] {
      try {
        write_file_atomically(file, text);
        return 1;
      } catch (const std::system_error& error) {
        if (error.code() != std::errc::device_or_resource_busy) return 2;
      }
      replace_or_overwrite(file, text);
      return read_file_bytes(file, 100) == text ? 0 : 3;
    });
    if (code == kNoMounts) GTEST_SKIP() << "this system does not allow mounts";
    EXPECT_EQ(code, 0);
    EXPECT_EQ(read_file_bytes(file, 100), text);
    EXPECT_EQ(files(), 1u);
  }
}

TEST_F(AtomicFile, AFullDiskLeavesAMountedFileAsItIs) {
  const fs::path file = folder_ / "compose.yaml";
  write_file_atomically(file, "former text");
  const int code = with_mounted(file, [&] {
    const LimitedFiles full(100);
    try {
      replace_or_overwrite(file, std::string(90, 'x'));
      replace_or_overwrite(file, std::string(101, 'y'));
    } catch (const std::system_error&) {
      return read_file_bytes(file, 100) == std::string(90, 'x') ? 0 : 2;
    }
    return 1;
  });
  if (code == kNoMounts) GTEST_SKIP() << "this system does not allow mounts";
  EXPECT_EQ(code, 0);
}

TEST_F(AtomicFile, AFolderInThePlaceOfTheFileIsRefused) {
  fs::create_directory(folder_ / "taken");
  EXPECT_THROW(replace_or_overwrite(folder_ / "taken", "x"), std::system_error);
  replace_or_overwrite(folder_ / "new", "x");
  EXPECT_EQ(read_file_bytes(folder_ / "new", 100), "x");
}

TEST_F(AtomicFile, ALargeFileIsRefusedBeforeItIsRead) {
  write_file_atomically(folder_ / "a", "12345");
  EXPECT_EQ(read_file_bytes(folder_ / "a", 5), "12345");
  EXPECT_THROW(read_file_bytes(folder_ / "a", 4), InputError);
  EXPECT_THROW(read_file_bytes(folder_ / "b", 4), InputError);
  EXPECT_THROW(read_file_bytes(folder_, 4), InputError);
}

}  // namespace
}  // namespace skein

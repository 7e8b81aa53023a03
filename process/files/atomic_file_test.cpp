#include "process/files/atomic_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

#include "core/files/file_bytes.hpp"
#include "core/types.hpp"

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

TEST_F(AtomicFile, LeavesNothingBehindWhenItFails) {
  EXPECT_THROW(write_file_atomically(folder_ / "none" / "result.json", "x"), std::runtime_error);
  fs::create_directory(folder_ / "taken");
  EXPECT_THROW(write_file_atomically(folder_ / "taken", "x"), std::runtime_error);
  EXPECT_EQ(files(), 1u);
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

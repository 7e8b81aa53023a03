// A file that grows record by record. A write error (a full disk, a quota, a limit) ends the file, not the program: the
// file then ends with its last complete record, and write_error() says why. Not thread-safe.
#pragma once

#include <filesystem>
#include <string>

#include "recording/mcap/records.hpp"

namespace skein::mcap {

class Output {
 public:
  /// Creates or empties the file. @throws std::system_error, with the file's name, if it cannot be opened.
  explicit Output(const std::filesystem::path& file);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Appends complete records. When this returns, either all of them are in the file or none. Does nothing after an
  /// error.
  void write(ByteView records);
  /// Bytes in the file so far.
  std::uint64_t size() const { return size_; }
  /// Checksum (`crc_of`) of all bytes so far, including the magic.
  std::uint32_t crc() const { return crc_; }
  /// Description of the error, with the file's name, for people; empty if there was none.
  const std::string& write_error() const { return write_error_; }

 private:
  const std::filesystem::path file_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
  std::uint32_t crc_ = 0;
  std::string write_error_;
};

}  // namespace skein::mcap

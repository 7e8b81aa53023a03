// A file that grows record by record. A disk that refuses (it is full, a quota, a limit) ends the file and not the
// program: the file then ends with its last whole record, and trouble() says why. Not thread-safe.
#pragma once

#include <filesystem>
#include <string>

#include "recording/mcap/records.hpp"

namespace skein::mcap {

class Output {
 public:
  /// An empty file of this name. @throws std::system_error, with the file's name, when it cannot be opened.
  explicit Output(const std::filesystem::path& file);
  ~Output();
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Whole records; they are in the file when this returns, all or none.
  void write(ByteView records);
  /// Bytes so far.
  std::uint64_t size() const { return size_; }
  /// Of all bytes since the magic (`crc_of`).
  std::uint32_t crc() const { return crc_; }
  /// What went wrong, with the file's name, for people; empty as long as nothing did.
  const std::string& trouble() const { return trouble_; }

 private:
  const std::filesystem::path file_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
  std::uint32_t crc_ = 0;
  std::string trouble_;
};

}  // namespace skein::mcap

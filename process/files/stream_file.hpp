// A text file that grows while its program works. A disk that refuses (it is full, a quota, a limit) ends the file and
// not the program: the file then ends with its last whole line, and trouble() says why. Not thread-safe.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skein {

class StreamFile {
 public:
  enum class Mode { fresh, append };

  /// @param file  in kNowhere (process/files/nowhere.hpp): nothing is written.
  /// @throws std::system_error, with the file's name, when it cannot be opened.
  explicit StreamFile(const std::filesystem::path& file, Mode mode = Mode::fresh);
  ~StreamFile();
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  /// Reaches the file in blocks, or with flush().
  StreamFile& operator<<(std::string_view text);
  void flush();
  /// Whether what is written goes anywhere: it need not be made otherwise.
  bool kept() const { return fd_ >= 0; }
  /// What went wrong, with the file's name, for people; empty as long as nothing did.
  const std::string& trouble() const { return trouble_; }

 private:
  /// Writes the buffer. @returns how much of it the disk has taken.
  std::size_t put_out() const;

  const std::filesystem::path file_;
  int fd_ = -1;
  std::string buffer_, trouble_;
};

}  // namespace skein

// A text file to which a program appends while it runs. If a write fails (disk full, quota, size limit), the program
// continues, but nothing more is written: the file ends with its last complete line, and write_error() has the reason.
// Not thread-safe.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skein {

class StreamFile {
 public:
  enum class Mode { fresh, append };

  /// @param file  a file in kNowhere (process/files/nowhere.hpp) is not written.
  /// @throws std::system_error, with the file's name, if the file cannot be opened.
  explicit StreamFile(const std::filesystem::path& file, Mode mode = Mode::fresh);
  ~StreamFile();
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;

  /// Appends to a buffer, which is written to the file when it is full, and by flush().
  StreamFile& operator<<(std::string_view text);
  void flush();
  /// False for a file in kNowhere: then callers need not produce any text.
  bool kept() const { return fd_ >= 0; }
  /// Error message for people, with the file's name; empty while there was no error.
  const std::string& write_error() const { return write_error_; }

 private:
  /// Writes the buffer. @returns number of bytes written.
  std::size_t put_out() const;

  const std::filesystem::path file_;
  int fd_ = -1;
  std::string buffer_, write_error_;
};

}  // namespace skein

// The key of a run's page. Who has it may look and give orders: it is drawn for each run, is handed over in a file that
// only its owner may read, and never stands on a command line or in an environment.   Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skein::view {

class Key {
 public:
  /// 256 random bits. @throws std::runtime_error when the system has none.
  static Key draw();
  /// Of a file as write_to() makes it. @throws InputError when it is none, or others may read it.
  static Key read_from(const std::filesystem::path& file);

  const std::string& text() const { return text_; }
  /// Takes the same time whatever is given.
  bool opens(std::string_view given) const;

 private:
  explicit Key(std::string text) : text_(std::move(text)) {}

  std::string text_;  ///< 64 hexadecimal digits
};

/// Makes a new file of mode 0600; what was there under this name goes, and a link is not followed.
/// @throws std::runtime_error with the system's reason.
void write_private_file(const std::filesystem::path& file, std::string_view text);

}  // namespace skein::view

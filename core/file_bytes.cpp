#include "core/file_bytes.hpp"

#include <fstream>

#include "core/types.hpp"

namespace skein {

std::string read_file_bytes(const std::filesystem::path& file, std::uintmax_t most_bytes) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw InputError(file.string() + ": no such file");
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(file.string() + ": not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(file.string() + ": " + error.message());
  if (size > most_bytes) {
    throw InputError(file.string() + ": has " + std::to_string(size >> 20) + " MB, more than the " +
                     std::to_string(most_bytes >> 20) + " MB that are accepted");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw InputError(file.string() + ": cannot be read");
  }
  return bytes;
}

}  // namespace skein

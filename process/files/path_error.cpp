#include "process/files/path_error.hpp"

#include <algorithm>
#include <array>
#include <system_error>

namespace skein {

std::string path_error_text(const std::filesystem::filesystem_error& error) {
  if (error.path1().empty()) return error.what();
  return error.path1().string() + ": " + error.code().message();
}

bool is_wrong_path(const std::filesystem::filesystem_error& error) {
  static constexpr std::array kWrong = {std::errc::filename_too_long, std::errc::too_many_symbolic_link_levels,
                                        std::errc::not_a_directory, std::errc::permission_denied};
  return std::ranges::any_of(kWrong, [&](std::errc wrong) { return error.code() == wrong; });
}

}  // namespace skein

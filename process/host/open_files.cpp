#include "process/host/open_files.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace skein {

std::optional<std::uint64_t> open_files_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

void raise_open_files_limit(std::uint64_t files) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= files) return;  // RLIM_INFINITY is the greatest
  limit.rlim_cur = std::min<rlim_t>(files, limit.rlim_max);
  static_cast<void>(::setrlimit(RLIMIT_NOFILE, &limit));
}

std::string open_files_hint(const std::error_code& code) {
  const auto limit = open_files_limit();
  if (code != std::errc::too_many_files_open || !limit) return {};
  return "; a process may have " + std::to_string(*limit) +
         " open files (ulimit -n): raise this limit, for example with `ulimit -n 1024`";
}

}  // namespace skein

#include "process/host/open_files.hpp"

#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>

#include <algorithm>

#include "core/types.hpp"

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

std::string judge_open_files_limit(const std::string& who, const OpenFilesNeed& need, std::uint64_t limit) {
  if (limit >= need.ample) return {};
  const std::string text = fmt::format(
      "a process may have {} open files (ulimit -n), and {} needs about {}; as root, raise the limit with `ulimit -n "
      "{}`, or with nofile in /etc/security/limits.conf",
      limit, who, need.ample, need.ample);
  if (limit < need.least) throw InputError(text);
  return text;
}

std::string provide_open_files(const std::string& who, const OpenFilesNeed& need) {
  raise_open_files_limit(need.ample);
  const auto limit = open_files_limit();
  return limit ? judge_open_files_limit(who, need, *limit) : std::string();
}

}  // namespace skein

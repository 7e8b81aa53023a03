#include "cli/run/by_hand.hpp"

#include <system_error>

#include "core/types.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {

void check_outlasts(const std::optional<std::filesystem::path>& faults, const std::filesystem::path& dir) {
  if (!faults || !run_folder::is_of_a_run(faults->filename())) return;
  std::error_code error;
  if (!std::filesystem::equivalent(std::filesystem::absolute(*faults).parent_path(), dir, error)) return;
  throw InputError("--faults " + faults->string() +
                   ": is in the folder of the results, which is emptied first; choose another --out");
}

}  // namespace skein::cli

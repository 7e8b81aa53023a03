#include "results/result_file.hpp"

#include <cstdint>
#include <utility>

#include "core/files/file_bytes.hpp"
#include "core/types.hpp"
#include "results/result_keys.hpp"
#include "results/run_folder.hpp"

namespace skein::results {
namespace {

constexpr std::uintmax_t kMostBytes = 256 << 20;

}  // namespace

std::string result_text(Json result) { return json_text(with_checksum(std::move(result)), 2) + "\n"; }

Json read_result_file(const std::filesystem::path& run) {
  const std::filesystem::path file = run / run_folder::kResult;
  if (!run_folder::has_file(run, run_folder::kResult)) {
    throw InputError(run.string() + ": there is no " + run_folder::kResult + " in it");
  }
  // Not read_json(), for which a file that cannot be read is the same as a damaged one.
  Json result = parse_json(read_file_bytes(file, kMostBytes));
  if (!result.is_object()) throw InputError(file.string() + ": is damaged: it is not a JSON object");
  if (value_or(result, kChecksum, nullptr).is_null()) {
    const std::string wrong = wrong_key(result);
    if (!wrong.empty()) throw InputError(file.string() + ": is damaged: " + wrong);
  } else if (!has_sound_checksum(result)) {
    throw InputError(file.string() +
                     ": is damaged, or was edited: its checksum does not match its contents (Skein "
                     "accepts it unchecked if you delete the key 'checksum')");
  }
  return result;
}

}  // namespace skein::results

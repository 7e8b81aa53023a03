#include "results/result_file.hpp"

#include "core/sha256.hpp"
#include "core/types.hpp"
#include "results/run_folder.hpp"

namespace skein::results {
namespace {

std::string checksum_of(const Json& result) { return Sha256().add(json_text(result)).hex(); }

}  // namespace

std::string result_text(Json result) {
  result.erase(kResultChecksum);
  // The checksum must cover the values that a reader gets: invalid UTF-8 is replaced, numbers like NaN become null.
  result = parse_json(json_text(result));
  result[kResultChecksum] = checksum_of(result);
  return json_text(result, 2) + "\n";
}

Json read_result_file(const std::filesystem::path& run) {
  const std::filesystem::path file = run / run_folder::kResult;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw InputError(run.string() + ": there is no " + run_folder::kResult + " in it");
  }
  Json result = read_json(file);
  if (!result.is_object()) throw InputError(file.string() + ": is damaged: it is no JSON object");
  const Json told = value_or(result, kResultChecksum, nullptr);
  if (told.is_null()) return result;
  Json rest = result;
  rest.erase(kResultChecksum);
  if (told != checksum_of(rest)) {
    throw InputError(file.string() +
                     ": is damaged, or was edited: its checksum does not fit what it holds (without the "
                     "key 'checksum' it is taken as it is)");
  }
  return result;
}

}  // namespace skein::results

#include "oracle/kept_answer.hpp"

#include <fstream>
#include <stdexcept>

#include "core/files/file_bytes.hpp"
#include "core/text/sha256.hpp"
#include "process/files/atomic_file.hpp"

namespace skein::sim {
namespace {

std::string answer_hash(const std::string& key, const nlohmann::ordered_json& answer) {
  return Sha256().add(key).add(answer.dump()).hex();
}

}  // namespace

std::optional<nlohmann::ordered_json> kept_answer(const std::filesystem::path& file, const std::string& key) {
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) return std::nullopt;
  std::ifstream in = open_text(file);  // a named pipe must not keep us waiting
  const auto json = nlohmann::ordered_json::parse(in);
  if (json.at("sha256") != answer_hash(key, json.at("answer"))) throw std::runtime_error("its check sum is wrong");
  return json.at("answer");
}

void keep_answer(const std::filesystem::path& file, const std::string& key, const nlohmann::ordered_json& answer) {
  std::filesystem::create_directories(file.parent_path());
  const nlohmann::ordered_json whole = {{"key", key}, {"answer", answer}, {"sha256", answer_hash(key, answer)}};
  write_file_atomically(file, whole.dump() + "\n", Readers::no_agents);
}

}  // namespace skein::sim

// Cached answers: a JSON file with the answer, the key of its question and a SHA-256 over both, to detect damage.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace skein::sim {

/// @returns nullopt when the file does not exist. @throws std::exception when it is damaged, or answers another key.
std::optional<nlohmann::ordered_json> kept_answer(const std::filesystem::path& file, const std::string& key);

/// Writes the file atomically, closed to agents; creates its folder if necessary. @throws std::exception on failure.
void keep_answer(const std::filesystem::path& file, const std::string& key, const nlohmann::ordered_json& answer);

}  // namespace skein::sim

// Cached answers: a JSON file with the answer, the key of its question and a SHA-256 over both, to detect damage.
// Threads: any; a file that is written appears whole.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace skein::sim {

/// @returns nullopt if the file does not exist. @throws std::exception if it is damaged, or has the answer to another
///   key.
std::optional<nlohmann::ordered_json> kept_answer(const std::filesystem::path& file, const std::string& key);

/// Writes the file atomically, unreadable for agents (process/files/closed_to_agents.hpp). Creates its folder if
/// necessary. @throws std::exception on failure.
void keep_answer(const std::filesystem::path& file, const std::string& key, const nlohmann::ordered_json& answer);

}  // namespace skein::sim

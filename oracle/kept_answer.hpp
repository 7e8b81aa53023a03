// An answer in a file of the cache, with the question's key and a hash over both: a damaged file is told from a whole
// one.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace skein::sim {

/// @returns nullopt when there is no such file. @throws std::exception when it is not whole, or of another question.
std::optional<nlohmann::ordered_json> kept_answer(const std::filesystem::path& file, const std::string& key);

/// Writes it atomically, and its folder where there is none. @throws std::exception where that fails.
void keep_answer(const std::filesystem::path& file, const std::string& key, const nlohmann::ordered_json& answer);

}  // namespace skein::sim

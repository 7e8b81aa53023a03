// The figures of docs/sensing.md as tables in Markdown, and their places in that page.
// Pure; any thread.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/sensing/reach.hpp"
#include "bench/sensing/study.hpp"

namespace skein::bench {

/// A block of the page.
struct Table {
  std::string name;  ///< of its place
  std::string markdown;
};

Table space_table(std::span<const SiteStudy> studies);
Table surface_table(std::span<const SiteStudy> studies);
Table reach_table(std::span<const Reach> reaches, std::span<const Stop> stops);
/// CPU time and memory: the only one that differs from call to call.
Table cost_table(std::span<const SiteStudy> studies);
Table message_table(std::span<const SiteStudy> studies);
/// @param vendors  a list of {vendor, plain, beams}, each with round_ms (wall) and cpu_ms, a step.
Table vendor_table(const nlohmann::json& vendors);

/// The page with another text between the lines `[//]: # (table: NAME)` and `[//]: # (end of table)`, which readers do
/// not see.
/// @throws InputError when it has no such place.
std::string with_table(const std::string& page, const Table& table);

}  // namespace skein::bench

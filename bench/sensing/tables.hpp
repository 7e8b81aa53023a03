// The tables of docs/sensing.md in Markdown, and their insertion into that page.
// Pure; any thread.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/sensing/reach.hpp"
#include "bench/sensing/study.hpp"

namespace skein::bench {

/// A table of the page.
struct Table {
  std::string name;  ///< name in the page's markers
  std::string markdown;
};

Table space_table(std::span<const SiteStudy> studies);
Table surface_table(std::span<const SiteStudy> studies);
Table reach_table(std::span<const Reach> reaches, std::span<const Stop> stops);
/// CPU time and memory. The only table that differs between two calls.
Table cost_table(std::span<const SiteStudy> studies);
Table message_table(std::span<const SiteStudy> studies);
/// @param vendors  a list of {vendor, plain, beams}; `plain` and `beams` have round_ms (wall time) and cpu_ms per step.
Table vendor_table(const nlohmann::json& vendors);

/// The page with the table between its markers, the lines `[//]: # (table: NAME)` and `[//]: # (end of table)`, which
/// Markdown does not show. @throws InputError if the page has no such markers.
std::string with_table(const std::string& page, const Table& table);

}  // namespace skein::bench

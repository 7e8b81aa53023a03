// Makes report.html: what happened in a run, and why it scored what it did. The page is one file that loads nothing
// from elsewhere; docs/report.md explains its parts. The same folder always gives the same page. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "results/run_record.hpp"

namespace skein::report {

/// The page's HTML. @param bundle  the script that makes it interactive; nullopt: a page with static drawings.
std::string run_page(results::RunRecord run, const std::optional<std::string>& bundle);

/// Writes report.html into the results folder `dir`.
/// @throws InputError when there is no result in it, std::runtime_error when the file cannot be written.
void write_run_report(const std::filesystem::path& dir);

}  // namespace skein::report

// report.html: what happened in a run, and why it scored what it did. One file that asks for nothing from elsewhere;
// docs/report.md explains its parts. The same folder gives the same page. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "results/run_data.hpp"

namespace skein::report {

/// @param bundle  the script that makes it interactive; without it the page's drawings stand still.
std::string run_page(results::RunData run, const std::optional<std::string>& bundle);

/// Writes report.html into the results folder `dir`.
/// @throws InputError when there is no result in it, std::runtime_error when the file cannot be written.
void write_run_report(const std::filesystem::path& dir);

}  // namespace skein::report

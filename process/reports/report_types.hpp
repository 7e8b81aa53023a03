// Types for the members of reports (reports.hpp). Each member may be missing from a report.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "process/json_fields.hpp"

namespace skein {

using Count = std::optional<std::uint64_t>;
using Number = std::optional<Amount>;  // never negative
using Text = std::optional<std::string>;
using Texts = std::vector<std::string>;

}  // namespace skein

// Types of members of reports (reports.hpp): each may be missing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "process/json_fields.hpp"

namespace skein {

using Count = std::optional<std::uint64_t>;
using Number = std::optional<Amount>;  // none of them can be negative
using Text = std::optional<std::string>;
using Texts = std::vector<std::string>;

}  // namespace skein

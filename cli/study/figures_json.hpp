// The figures of a flight as JSON, for who has no result.json at hand. Pure; any thread.
#pragma once

#include "cli/study/figures.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

Json to_json(const FlightFigures& figures);
/// The same figures to the bit. What is missing, or of another kind, is empty.
FlightFigures figures_from(const Json& json);

}  // namespace skein::cli

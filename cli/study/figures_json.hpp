// The figures of a flight as JSON, so that a sweep's controller need not read result.json. Pure; any thread.
#pragma once

#include "cli/study/figures.hpp"
#include "process/json_text.hpp"

namespace skein::cli {

Json to_json(const FlightFigures& figures);
/// The same figures, bit for bit. A key that is missing or of another type leaves its figure at the default value.
FlightFigures figures_from(const Json& json);

}  // namespace skein::cli

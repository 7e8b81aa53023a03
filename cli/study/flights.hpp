// The flights of a study: each is a `skein run` in a folder of its own, and what has been flown once stays.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/host/program_host.hpp"
#include "cli/study/figures.hpp"
#include "cli/study/plan.hpp"

namespace skein::cli {

/// Written into a flight's folder when it is over: under what it was flown, and how it ended.
inline constexpr const char* kFlightMark = "flight.json";

/// How a flight of the plan ended.
struct StudyOutcome {
  std::optional<FlightFigures> figures;  ///< of a flight to its end
  std::string problem;                   ///< what went wrong; empty: nothing, or not flown before Ctrl-C
};

struct StudyOutcomes {
  std::vector<StudyOutcome> flights;  ///< in the plan's order
  bool interrupted = false;           ///< the user pressed Ctrl-C before all had flown
  bool detached = false;              ///< an engine flies them, and nobody waits for it
};

/// Whether a result is of a flight to its end.
bool went_to_its_end(const Json& result);

/// Why `skein run` ended with another code than 0, in a sentence. @param dir  of the flight
std::string problem_of(const std::filesystem::path& dir, const Json& result, const ExitStatus& exit);

/// The outcome that is there already: of the same command, to its end, without a problem. nullopt: it must be flown.
std::optional<StudyOutcome> flown_before(const StudyFlight& flight);

/// Flies what has not been flown, `plan.jobs` at once, with progress on `console.err`. A flight that fails is
/// noted and the others go on; Ctrl-C ends those in the air at their next step, a second one at once.
/// From one thread, which must live as long as the flights.
StudyOutcomes fly_study(const StudyPlan& plan, const Console& console);

/// "45 s", "12 min", "3 h 20 min".
std::string duration_text(double seconds);

}  // namespace skein::cli

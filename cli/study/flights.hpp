// Flies a study. Each flight is a `skein run` in a folder of its own; flights that have a result are not flown again.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/study/figures.hpp"
#include "cli/study/plan.hpp"
#include "host/program_host.hpp"

namespace skein::cli {

/// File in a flight's folder, written at its end: everything on which its result depends, and its problem, if any.
inline constexpr const char* kFlightMark = "flight.json";

/// How a flight of the plan ended.
struct StudyOutcome {
  std::optional<FlightFigures> figures;  ///< nullopt: the flight did not go to its end
  std::string problem;                   ///< error message; empty: no error, or not flown because of Ctrl-C
};

struct StudyOutcomes {
  std::vector<StudyOutcome> flights;  ///< in the plan's order
  bool interrupted = false;           ///< the user pressed Ctrl-C before all flights were over
  bool detached = false;              ///< the engine of a sweep flies on; this command did not wait (--detach)
};

/// Whether a flight went to its end: its status is `completed` or `no_takeoff`.
bool went_to_its_end(const Json& result);

/// The result in a flight's folder; null if there is none. A damaged result, whose checksum is wrong, counts as none.
/// @param say  gets one line that names the damaged file; null: no message
Json sound_result(const std::filesystem::path& dir, std::ostream* say);

/// Error message for a flight that failed. @param dir  its folder. @param exit  of its `skein run`
std::string problem_of(const std::filesystem::path& dir, const Json& result, const ExitStatus& exit);

/// True if this mark (kFlightMark) says that `command` flew the run, and without a problem.
bool is_of_sound_flight(const Json& mark, const Json& command);

/// The outcome of an earlier flight with the same StudyFlight::command() that went to its end without a problem.
/// nullopt: it must be flown. @param say  as for sound_result()
std::optional<StudyOutcome> flown_before(const StudyFlight& flight, std::ostream* say);

/// Flies all flights that have no outcome yet, `plan.jobs` at once, with progress on `console.err`. Records a flight
/// that fails, and flies the others. Ctrl-C ends running flights at their next step, a second Ctrl-C at once.
/// Threads: one, which must live as long as the flights.
StudyOutcomes fly_study(const StudyPlan& plan, const Console& console);

/// "45 s", "12 min", "3 h 20 min".
std::string duration_text(double seconds);

}  // namespace skein::cli

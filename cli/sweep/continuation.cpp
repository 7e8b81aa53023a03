// How a sweep continues: which of its units are over, and whether their results are still there.
#include <algorithm>
#include <optional>
#include <ostream>

#include "cli/sweep/controller.hpp"
#include "core/types.hpp"
#include "results/result_file.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// Why a flight's folder does not have the result that it should have, for people.
std::string what_is_wrong_with(const fs::path& dir) try {
  results::read_result_file(dir);
  return dir.string() + ": holds no flight that counts";
} catch (const InputError& error) {
  return error.what();
}

/// Whether the record of a finished unit has all its flights. @param failed  failed flights may be among them
bool has_all(const std::optional<std::vector<SweepRow>>& rows, const SweepUnit& unit, bool failed) {
  return rows && std::ranges::all_of(unit.flights, [&](const SweepFlight& flight) {
           const auto row = std::ranges::find(*rows, flight.index, &SweepRow::index);
           return row != rows->end() && (row->problem.empty() ? row->figures.is_object() : failed);
         });
}

}  // namespace

SweepUnit SweepController::planned_unit(const SweepPlan& plan, std::size_t number) const {
  SweepUnit unit;
  const std::size_t end = settings_.sizes.first(number + 1);
  for (std::size_t i = settings_.sizes.first(number); i < end; ++i) unit.flights.push_back(plan.flight(i));
  return unit;
}

/// Writes the files of units again that cannot be read.
void SweepController::mend_units(const SweepPlan& plan) const {
  for (std::size_t number = 0; number < settings_.units(); ++number) {
    const SweepUnit planned = planned_unit(plan, number);
    try {
      if (folder_.unit(number).flights.size() == planned.flights.size()) continue;
    } catch (const InputError&) {  // missing or damaged
    }
    folder_.add_unit(number, planned);
  }
}

/// Marks a unit as over if all its flights have results already, from a study flown without a sweep or only in part.
void SweepController::close_what_is_flown(std::size_t unit, std::ostream* say) const {
  std::vector<SweepRow> rows;
  for (const SweepFlight& flight : folder_.unit(unit).flights) {
    auto row = row_in_place(folder_, flight, here_, say);
    if (!row) return;
    rows.push_back(std::move(*row));
  }
  folder_.write_done(settings_.token, unit, rows);
}

std::map<std::size_t, std::string> SweepController::lost() const {
  std::map<std::size_t, std::string> flights;
  for (const std::size_t unit : folder_.done(settings_.token)) {
    if (unit >= settings_.units()) break;  // checks follow
    const std::vector<SweepRow> rows = folder_.rows(settings_.token, unit).value_or(std::vector<SweepRow>());
    for (const SweepFlight& flight : folder_.unit(unit).flights) {
      const auto row = std::ranges::find(rows, flight.index, &SweepRow::index);
      if (row != rows.end() && !row->problem.empty()) continue;  // it failed: no result of it counts
      if (!row_in_place(folder_, flight, here_)) flights[flight.index] = what_is_wrong_with(flight.dir);
    }
  }
  return flights;
}

/// Reopens finished units with lost flights, or with a damaged record.
/// @param failed_too  also those with failed flights
void SweepController::reopen_what_must_fly(bool failed_too) const {
  const std::map<std::size_t, std::string> missing = lost();
  std::set<std::size_t> units;
  for (const auto& [index, what] : missing) units.insert(settings_.sizes.unit_of(index));
  for (const std::size_t unit : folder_.done(settings_.token)) {
    if (unit >= settings_.units()) break;
    if (!has_all(folder_.rows(settings_.token, unit), folder_.unit(unit), !failed_too)) units.insert(unit);
  }
  for (const std::size_t unit : units) {
    folder_.reopen(settings_.token, unit);
    close_what_is_flown(unit, nullptr);  // if only the unit's record was wrong
  }
  for (const auto& [index, what] : missing) {
    if (folder_.is_done(settings_.token, settings_.sizes.unit_of(index))) continue;
    say_ << what << "; Skein flies this flight again" << std::endl;
  }
}

}  // namespace skein::cli

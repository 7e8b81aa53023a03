// A unit of a sweep, flown on one node: its flights one after another, as far as they are not there yet. Before the
// first one the node flies the reference flight and must meet its digest; a flight that fails says something about
// itself only if the reference flight goes well on the node right after it.
// Reads and writes the sweep's folder. One thread.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

#include "cli/run/program_host.hpp"
#include "cli/sweep/folder.hpp"

namespace skein::cli {

/// What the flights of a unit need of the machine; tests have another one.
struct SweepNode {
  std::string name;
  std::string boot;  ///< another one after each start of the machine
  std::string cpu;   ///< for people
  /// Flies it into a new folder, which exists. @throws Interrupted.
  std::function<ExitStatus(const SweepFlight& flight, const std::filesystem::path& out)> fly;
  /// How this node's programs, or the files that a flight reads here, are not those that the sweep was planned with,
  /// for people; empty: they are.
  std::function<std::string(const SweepFlight& flight)> unlike;
  /// The figures that count of a result.
  std::function<Json(const Json& result)> figures;
  /// Why a flight that failed did, for people.
  std::function<std::string(const std::filesystem::path& out, const ExitStatus& exit)> reason;
};

/// Something is wrong with the node, and not with a flight: nothing was lost, another node goes on.
class NodeTrouble : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @param say  one line for each flight.
/// @throws NodeTrouble, Interrupted, InputError for a folder that holds no such unit, and whatever the file system has
///   to say. What was flown until then stays, and the next one who flies the unit goes on from there.
void fly_unit(const SweepFolder& folder, std::size_t unit, const SweepNode& node, std::ostream& say);

/// Flies the reference flight. @returns its digest; empty: it has none. @throws NodeTrouble when it does not end well;
///   Interrupted.
std::string fly_reference(const SweepFolder& folder, const SweepFlight& reference, const SweepNode& node);

/// Flies it here and tells its digest; nothing of it is kept. Empty: it has none.
std::string digest_here(const SweepFolder& folder, const SweepFlight& flight, const SweepNode& node);

/// What is in the flight's own folder, if it was flown under what the sweep was planned with, to its end, without a
/// problem, by a node of which everything counts.
std::optional<SweepRow> row_in_place(const SweepFolder& folder, const SweepFlight& flight, const SweepNode& node);

}  // namespace skein::cli

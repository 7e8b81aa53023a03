// Flies a unit of a sweep on one node: one after another, all flights of the unit that have no result yet. Before the
// first flight, the node flies the reference flight and must reproduce its digest. When a flight fails, this counts as
// a result of the flight only if the reference flight then succeeds on the same node.
// Reads and writes the sweep's folder. One thread.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

#include "cli/sweep/folder.hpp"
#include "host/program_host.hpp"

namespace skein::cli {

/// What the flights of a unit need from the machine; tests replace it.
struct SweepNode {
  std::string name;
  std::string boot;  ///< an id that changes with each boot of the machine
  std::string cpu;   ///< for people
  /// Flies a flight; its results go to `out`, a new folder that exists. @throws Interrupted.
  std::function<ExitStatus(const SweepFlight& flight, const std::filesystem::path& out)> fly;
  /// How this node's programs, or the files that a flight reads here, differ from those with which the sweep was
  /// planned, for people; empty: they do not differ.
  std::function<std::string(const SweepFlight& flight)> unlike;
  /// The figures of a result that count in the sweep.
  std::function<Json(const Json& result)> figures;
  /// Why a flight failed, for people.
  std::function<std::string(const std::filesystem::path& out, const ExitStatus& exit)> reason;
};

/// The node has a problem, not a flight. No result is lost, and another node can continue the unit.
class NodeTrouble : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @param say  receives one line for each flight.
/// @throws NodeTrouble, Interrupted, InputError for a folder that holds no such unit, and errors of the file system.
///   Flights that are complete by then stay, and the next program that flies the unit continues from there.
void fly_unit(const SweepFolder& folder, std::size_t unit, const SweepNode& node, std::ostream& say);

/// Flies the reference flight. @returns its digest; empty: it has none. @throws NodeTrouble when it fails;
///   Interrupted.
std::string fly_reference(const SweepFolder& folder, const SweepFlight& reference, const SweepNode& node);

/// Flies a flight on this node, and keeps no files of it. @returns its digest; empty: it has none.
std::string digest_here(const SweepFolder& folder, const SweepFlight& flight, const SweepNode& node);

/// The result in the flight's own folder, if the flight was flown exactly as the sweep was planned, went to its end
/// without a problem, and comes from a node that is not in quarantine. @param say  as for sound_result()
std::optional<SweepRow> row_in_place(const SweepFolder& folder, const SweepFlight& flight, const SweepNode& node,
                                     std::ostream* say = nullptr);

}  // namespace skein::cli

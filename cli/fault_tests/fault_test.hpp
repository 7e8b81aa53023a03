// A fault test: a run, what goes wrong in it, and what must hold of it. docs/how-to-test-faults.md explains the files.
// This file only reads fault tests; fault_test_command.cpp flies them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/fault_tests/expectations.hpp"
#include "run/fleet_plan.hpp"
#include "signals/properties/property_file.hpp"

namespace skein::cli {

/// A built-in property that a capsule may name beside those of its file: the run reached its end with a digest, and no
/// program was lost.
inline constexpr const char* kCompletes = "completes";
/// Another one: the run over DDS has the same digest as the run in one process.
inline constexpr const char* kSameDigest = "same_digest";

/// What a capsule of `skein hunt` records about the find that it replays.
struct CapsuleMark {
  std::string property;  ///< the property that failed
  std::string digest;    ///< digest of the run in which it failed; empty: none, or no longer known
  std::string skein;     ///< version of Skein that found it
  std::string build;     ///< build that flew it: a digest of its programs, or a commit; empty: not known
  std::string command;   ///< command line of the hunt

  void describe(auto& r) {
    r.required("property", property);
    r.field("digest", digest);
    r.field("skein", skein);
    r.field("build", build);
    r.field("command", command);
  }
};

/// One fault test file, ready to fly.
struct FaultTest {
  std::string name;            ///< name of the file, without .yaml
  std::filesystem::path file;  ///< path as it was given
  FleetPlan plan;              ///< includes the faults; its options say how to fly the test
  Expectations expect;
  properties::PropertySet property_set;  ///< from `properties` of the file, and the default properties
  ConfigDocument document;               ///< the file as it is
  std::optional<CapsuleMark> capsule = {};
  properties::PropertyEntries entries = {};  ///< `properties` as the file spells them
  std::filesystem::path property_file = {};  ///< that `properties` names; empty: none

  bool needs_fault_free() const;  ///< whether judging the test needs the same run without faults
  /// Whether the file says something about this property; otherwise it holds by default.
  bool states(const std::string& property) const;
  /// "FILE:LINE: KEY: WHAT", in the form of errors in the file itself; for a key that is missing, with the line of its
  /// enclosing key. @param key  for example "properties.separation"
  std::string said_of(const std::string& key, const std::string& what) const;
};

/// True when a document is a fault test, false when it is only a fault file.
bool is_fault_test(const ConfigNode& root);

/// Reads one fault test.
/// @param assets  folder for scenarios that read files. @param agent, one_process  as for `skein run`; but a fleet that
///   is too large for DDS always flies in one process, so its file must not ask for DDS.
/// @throws InputError with file, line, key and what would be right, also for errors in faults, scenario or planner.
FaultTest load_fault_test(const std::filesystem::path& file, const std::optional<std::filesystem::path>& assets = {},
                          const std::optional<std::filesystem::path>& agent = {}, bool one_process = false);

/// The same test with another seed, which draws the random links and the times that the file leaves open.
FaultTest with_seed(FaultTest test, std::uint64_t seed);

/// The fault tests of a folder, sorted by name, or `path` itself if it is a file. @throws InputError if none.
std::vector<std::filesystem::path> fault_test_files(const std::filesystem::path& path);

}  // namespace skein::cli

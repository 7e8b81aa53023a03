// A fault test: a run, what goes wrong in it, and what must hold of it. docs/how-to-test-faults.md explains the files.
// Reads files only; fault_test_command.hpp flies them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/fault_tests/expectations.hpp"
#include "cli/run/fleet_plan.hpp"
#include "properties/property_file.hpp"

namespace skein::cli {

/// What a capsule may be about beside the properties of its file: the run came to its end, with a digest, and all
/// programs lived.
inline constexpr const char* kCompletes = "completes";
/// A run over DDS must be the one that it was in one process.
inline constexpr const char* kSameDigest = "same_digest";

/// What a capsule, which `skein hunt` made, says of its find.
struct CapsuleMark {
  std::string property;  ///< that failed
  std::string digest;    ///< of the run in which it did, for ever; empty: it had none, or it is not known any more
  std::string skein;     ///< version
  std::string build;     ///< that flew it: of its programs, or a commit; empty: not known
  std::string command;   ///< of the hunt

  template <class R>
  void describe(R& r) {
    r.required("property", property);
    r.field("digest", digest);
    r.field("skein", skein);
    r.field("build", build);
    r.field("command", command);
  }
};

/// One file, ready to fly.
struct FaultTest {
  std::string name;            ///< of the file, without .yaml
  std::filesystem::path file;  ///< as it was named
  FleetPlan plan;              ///< with the faults; its options say how to fly it
  Expectations expect;
  properties::PropertySet property_set;  ///< `properties` of the file
  ConfigDocument document;               ///< the file as it is
  std::optional<CapsuleMark> capsule = {};
  properties::PropertyEntries entries = {};  ///< `properties` as the file spells them

  bool needs_fault_free() const;
  /// Those that the file asks for.
  std::vector<Repeat> repeats() const;
  /// "FILE:LINE: KEY: WHAT", as what is wrong with a file itself is said; of a key that is not there, the line of what
  /// would stand around it. @param key  "expect.score"
  std::string said_of(const std::string& key, const std::string& what) const;
};

/// True when a document is a fault test rather than a mere fault file.
bool is_fault_test(const ConfigNode& root);

/// @param assets  for scenarios that read files. @param agent, one_process  as `skein run` takes them.
/// @throws InputError naming file, line, key and what would be right: also for what is wrong in the faults, the
///   scenario or the planner.
FaultTest load_fault_test(const std::filesystem::path& file, const std::optional<std::filesystem::path>& assets = {},
                          const std::optional<std::filesystem::path>& agent = {}, bool one_process = false);

/// The same test with another seed: it draws random links, and times that the file leaves open.
FaultTest with_seed(FaultTest test, std::uint64_t seed);

/// The fault tests of a folder by name, or the one file. @throws InputError when there are none.
std::vector<std::filesystem::path> fault_test_files(const std::filesystem::path& path);

}  // namespace skein::cli

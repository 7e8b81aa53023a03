#include "cli/fault_tests/fault_test.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "cli/fault_tests/columns.hpp"
#include "cli/fault_tests/conversion.hpp"
#include "core/config/config_files.hpp"
#include "core/config/config_reader.hpp"
#include "core/scenario/conditions.hpp"
#include "core/scenario/drawn_worlds.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "core/text/suggestion.hpp"
#include "run/drawn_world.hpp"
#include "signals/judge.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

enum class Vendor { cyclonedds, fastdds, mixed };
constexpr std::array<EnumName<Vendor>, 3> enum_names(Vendor) {
  return {{{"cyclonedds", Vendor::cyclonedds}, {"fastdds", Vendor::fastdds}, {"mixed", Vendor::mixed}}};
}

/// A file's `run`: options of `skein run`, with the same defaults except for the duration.
struct RunPart {
  std::string scenario = RunOptions{}.scenario, planner = kDefaultPlanner;
  std::uint64_t seed = 0;
  std::optional<std::uint64_t> scene_seed, uavs;
  double duration_s = 60.0;
  std::optional<std::string> conditions;
  Vendor dds = Vendor::cyclonedds;

  void describe(auto& r) {
    r.field("scenario", scenario);
    r.field("planner", planner);
    r.field("seed", seed);
    r.field("scene_seed", scene_seed);
    r.field("uavs", uavs, within(1.0, static_cast<double>(kMostUavs)));
    r.field("duration_s", duration_s, Bounds{0.0, 36000.0, true});
    r.field("conditions", conditions);
    r.field("dds", dds);
  }
};

/// A file without its `faults`, which load_fault_plan() reads.
struct TestFile {
  std::string name, description;
  RunPart run;
  Expectations expect;
  std::optional<CapsuleMark> capsule;
  std::variant<std::string, properties::PropertyEntries> property_entries;  ///< a text: the file that lists them

  void describe(auto& r) {
    r.field("name", name);
    r.field("description", description);
    r.field("run", run);
    r.field("properties", property_entries);
    r.field("capsule", capsule);
    r.field("expect", expect);
  }
};

bool is_path(const std::string& name) { return name.find('/') != std::string::npos || name.ends_with(".yaml"); }

RunOptions run_options(const RunPart& part, const fs::path& file, const std::optional<fs::path>& assets,
                       const std::optional<fs::path>& agent) {
  RunOptions options;
  options.agent = agent;
  options.scenario = is_path(part.scenario) ? (file.parent_path() / part.scenario).string() : part.scenario;
  options.planner = part.planner;
  options.seed = part.seed;
  options.scene_seed = part.scene_seed;
  if (part.uavs) options.uavs = static_cast<std::size_t>(*part.uavs);
  options.duration_s = part.duration_s;
  options.conditions = part.conditions;
  options.dds = name_of(part.dds);
  options.assets = assets;
  options.faults = file;
  options.attainable = options.report = false;  // no part of a test
  options.force = true;
  return options;
}

/// Reports the errors of `run` with the messages of the command line, and with the line of the key.
void check_run(const RunOptions& options, ConfigErrors& errors) {
  const char* key = "run.scenario";
  try {
    RunOptions load;
    load.scenario = options.scenario;
    if (is_drawn_world(options.scenario)) {  // generated only once: each other seed or size is another world
      load.scene_seed = options.scene_seed;
      load.uavs = options.uavs;
    }
    Scenario scenario = scenario_flown(load, false);
    // One key after the other, so that a mistake is reported at the key that makes it.
    const auto load_with = [&](const char* next, auto RunOptions::*part) {
      if (!(options.*part)) return;
      key = next;
      load.*part = options.*part;
      scenario = scenario_flown(load, false);
    };
    load_with("run.scene_seed", &RunOptions::scene_seed);
    load_with("run.duration_s", &RunOptions::duration_s);
    load_with("run.uavs", &RunOptions::uavs);
    key = "run.planner";
    parse_planners(options.planner, scenario.uav_names());
    key = "run.conditions";
    if (options.conditions) chosen_conditions(*options.conditions, scenario.conditions);
  } catch (const InputError& error) {
    errors.check(false, key, error.what());
  }
  errors.throw_if_any();
}

constexpr const char* kProperties = "properties";

/// Reads the property file that a test names. Errors in it are reported at the name.
void read_property_file(const std::string& name, FaultTest& test, ConfigErrors& errors) try {
  const fs::path file = find_config_file("property file", name, {}, test.plan.faults.file.parent_path());
  test.property_file = file;
  test.property_set = properties::load_properties(file, test.plan.scenario);
  test.entries = properties::load_property_entries(file);
} catch (const InputError& error) {
  errors.check(false, kProperties, error.what());
}

/// Reads the properties of a test. A capsule is about one property, so the default ones do not hold for it.
void read_properties(const std::variant<std::string, properties::PropertyEntries>& given, FaultTest& test,
                     ConfigErrors& errors) {
  const Scenario& scenario = test.plan.scenario;
  const auto* file = std::get_if<std::string>(&given);
  if (file != nullptr && !file->empty()) {
    read_property_file(*file, test, errors);
  } else if (file == nullptr) {
    test.entries = std::get<properties::PropertyEntries>(given);
    test.property_set = properties::parse_properties(test.entries, kProperties, scenario, errors);
    signals::check_against_plan(test.property_set, test.plan.faults, scenario, kProperties, errors);
  }
  if (test.capsule) return;
  const auto usual =
      properties::parse_properties(properties::missing_defaults(test.entries), kProperties, scenario, errors);
  test.property_set.insert(test.property_set.end(), usual.begin(), usual.end());
}

/// Refuses keys of `expect` of earlier versions, which properties replace.
void refuse_old_keys(const ConfigDocument& document, const fs::path& file) {
  const ConfigNode* expect = document.root.find("expect");
  if (expect == nullptr) return;
  ConfigErrors errors(document);
  for (const std::string& key : expect->keys) {
    const std::vector<std::string>& old = old_expectations();
    errors.check(std::ranges::find(old, key) == old.end(), "expect." + key,
                 "is a property now; `skein convert --in-place " + file.string() + "` converts it");
  }
  errors.throw_if_any();
}

/// Refuses a capsule whose property is not in the file: nothing would evaluate it, so it would always hold.
void check_mark(const CapsuleMark& mark, const properties::PropertySet& set, ConfigErrors& errors) {
  std::vector<std::string> known = {kCompletes, kSameDigest};
  for (const properties::NamedProperty& property : set) known.insert(known.begin(), property.name);
  if (std::ranges::find(known, mark.property) != known.end()) return;
  errors.check(false, "capsule.property",
               "there is no property '" + mark.property + "' in this file; " + suggestion(mark.property, known));
}

/// Refuses what needs DDS in a test whose fleet is too large for it. @param one_process  the user chose one process, so
/// `run.dds` has no effect.
void check_without_dds(const FaultTest& test, bool one_process, ConfigErrors& errors) {
  const std::size_t uavs = test.plan.scenario.fleet.size();
  if (uavs <= kMostUavsOverDds) return;
  const std::string reason = fmt::format(
      "over DDS, which carries at most {} UAVs; this fleet has {}, and flies in one "
      "process",
      kMostUavsOverDds, uavs);
  const ConfigNode* run = test.document.root.find("run");
  errors.check(one_process || run == nullptr || run->find("dds") == nullptr, "run.dds", "asks for a flight " + reason);
  for (std::size_t i = 0; i < test.expect.same_digest.size(); ++i) {
    const Repeat repeat = test.expect.same_digest[i];
    errors.check(!needs_dds(repeat), "expect.same_digest[" + std::to_string(i) + "]",
                 "'" + std::string(name_of(repeat)) + "' asks for a flight " + reason);
  }
  errors.check(!test.capsule || test.capsule->property != kSameDigest, "capsule.property",
               std::string("'") + kSameDigest + "' compares with a flight " + reason);
}

FaultTest read_fault_test(const fs::path& file, const ConfigDocument& document, const std::optional<fs::path>& assets,
                          const std::optional<fs::path>& agent, bool one_process) {
  const fs::path path = fs::absolute(file);
  ConfigErrors errors(document);
  errors.check(document.root.find("faults") != nullptr, "faults",
               "is missing: a list of faults, or the name of a fault file");
  errors.throw_if_any();
  refuse_old_keys(document, file);
  ConfigDocument without_faults = document;
  without_faults.root.remove("faults");
  TestFile content = read_config<TestFile>(without_faults);
  RunOptions options = run_options(content.run, path, assets, agent);
  options.one_process = one_process;
  check_run(options, errors);
  FaultTest test{
      file.stem(), file,    plan_fleet(options, program_dir(), Processes::one_if_large), std::move(content.expect),
      {},          document};
  test.capsule = std::move(content.capsule);
  check_without_dds(test, one_process, errors);
  read_properties(content.property_entries, test, errors);
  if (test.capsule) check_mark(*test.capsule, test.property_set, errors);
  errors.throw_if_any();
  return test;
}

}  // namespace

bool FaultTest::needs_fault_free() const { return signals::needs_undisturbed(property_set); }

bool FaultTest::states(const std::string& property) const {
  return std::ranges::any_of(entries, [&](const auto& entry) { return entry.first == property; });
}

std::string FaultTest::said_of(const std::string& key, const std::string& what) const try {
  ConfigErrors errors(document);
  errors.check(false, key, what);
  errors.throw_if_any();
  return what;
} catch (const InputError& sentence) {
  return sentence.what();
}

bool is_fault_test(const ConfigNode& root) {
  const bool may_be_one = root.find("faults") != nullptr && root.find("properties") != nullptr;
  return may_be_one || root.find("expect") != nullptr || root.find("run") != nullptr;
}

FaultTest load_fault_test(const fs::path& file, const std::optional<fs::path>& assets,
                          const std::optional<fs::path>& agent, bool one_process) {
  const ConfigDocument document = read_config_document(file);
  try {
    return read_fault_test(file, document, assets, agent, one_process);
  } catch (const InputError& error) {
    if (document.root.find("capsule") == nullptr) throw;
    ConfigDocument by_path = document;
    by_path.origin = fs::absolute(file).string();  // errors in `faults` name the file by this path
    throw InputError(with_columns(with_columns(error.what(), document), by_path));
  }
}

FaultTest with_seed(FaultTest test, std::uint64_t seed) {
  test.plan.options.seed = seed;
  test.plan.faults = load_fault_plan(*test.plan.options.faults, test.plan.scenario, seed);
  return test;
}

std::vector<fs::path> fault_test_files(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(path.string() + ": there is no such file or folder");
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const std::string& name : config_names(path)) files.push_back(path / (name + ".yaml"));
  if (files.empty()) throw InputError(path.string() + ": there is no fault test (*.yaml) in this folder");
  return files;
}

}  // namespace skein::cli

#include "cli/sweep/folder.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <system_error>

#include "core/text/whole_number.hpp"
#include "core/types.hpp"
#include "process/files/closed_to_agents.hpp"
#include "process/json_fields.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSettings = "sweep.json";
constexpr const char* kTries = "tries.json";
constexpr int kFormat = 2;  ///< version of the file format

/// A number with leading zeros, so that names sort by number.
std::string numbered(std::size_t number) { return fmt::format("{:06}", number); }

std::size_t count_in(const Json& json, const char* key) {
  const Json value = value_or(json, key, nullptr);
  return value.is_number_unsigned() ? value.get<std::size_t>() : 0;
}

/// Names of the JSON files in a folder, without their extension; empty if there is no such folder.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  return names;
}

/// The numbers of the JSON files in a folder whose names are numbers.
std::set<std::size_t> numbers_in(const fs::path& folder) {
  std::set<std::size_t> numbers;
  for (const std::string& name : names_in(folder)) {
    if (const auto number = parse_whole<std::size_t>(name)) numbers.insert(*number);
  }
  return numbers;
}

/// The name of a node, which may contain any character, as the name of a file.
std::string file_name(const std::string& node) {
  std::string name;
  for (const char c : node) {
    const bool plain =
        (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.';
    name += plain ? std::string(1, c) : fmt::format("_{:02x}", static_cast<unsigned char>(c));
  }
  return "node-" + name;
}

Json to_json(const SweepRow& row) {
  return {{"index", row.index}, {"node", row.node}, {"problem", row.problem}, {"figures", row.figures}};
}

SweepRow row_of(const Json& json) {
  return {count_in(json, "index"), text_in(json, "node"), text_in(json, "problem"), value_or(json, "figures", nullptr)};
}

}  // namespace

Json to_json(const SweepFlight& flight) {
  return {{"index", flight.index},
          {"dir", flight.dir.string()},
          {"run", json_of(flight.run)},
          {"made_under", flight.made_under}};
}

SweepFlight sweep_flight_of(const Json& json, const fs::path& file) {
  const Json run = value_or(json, "run", Json::object());
  SweepFlight flight{count_in(json, "index"), text_in(json, "dir"), struct_of<RunOptions>(run),
                     value_or(json, "made_under", nullptr)};
  if (flight.dir.empty() || run.empty()) {
    throw InputError(file.string() + ": damaged: " + json.dump() +
                     " is not a flight; delete this file and repeat the command: it keeps the flights that exist");
  }
  return flight;
}

fs::path SweepFolder::file_of(const fs::path& folder, const std::string& name) const {
  return dir_ / folder / (name + ".json");
}

fs::path SweepFolder::log_of(std::size_t unit) const { return dir_ / "log" / (numbered(unit) + ".log"); }

void SweepFolder::write(const fs::path& file, const Json& json) const {
  step();
  fs::create_directories(file.parent_path());
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  write_file_atomically(file, text, Readers::all, flush_);
}

std::optional<SweepSettings> SweepFolder::settings() const {
  const Json json = read_json(dir_ / kSettings);
  if (value_or(json, "format", nullptr) != kFormat) return std::nullopt;
  SweepSettings settings{
      text_in(json, "token"),
      text_in(json, "plan"),
      {count_in(json, "flights"), std::max<std::size_t>(count_in(json, "unit_flights"), 1),
       count_in(json, "tail_flights"), std::max<std::size_t>(count_in(json, "tail_unit_flights"), 1)},
      {},
      text_in(json, "digest"),
      texts_in(json, "command"),
      text_in(json, "working_folder"),
      0.0};
  settings.reference = sweep_flight_of(value_or(json, "reference", Json::object()), dir_ / kSettings);
  settings.reference_s = number_in(json, "reference_s");
  return settings;
}

std::string SweepFolder::why_no_settings() const {
  if (value_or(read_json(dir_ / kSettings), "format", nullptr).is_null()) {
    return dir_.string() + " holds no sweep: its study was not flown with --executor";
  }
  return dir_.string() +
         " holds a sweep of another version of Skein: show or continue it with that version; or repeat the command of "
         "the study with --force: Skein then keeps the flights that fit, and flies the others again";
}

void SweepFolder::begin(const SweepSettings& settings, bool nodes_stay,
                        const std::function<SweepUnit(std::size_t number)>& unit) const {
  step();
  fs::remove(dir_ / kSettings);  // programs of the former sweep miss it after their present flight, and end
  for (const char* folder : {"units", "done", "checks", "log", "lists"}) remove(dir_ / folder);
  if (!nodes_stay) {
    for (const char* folder : {"nodes", "quarantine"}) remove(dir_ / folder);
  }
  for (const char* folder : {"units", "done", "checks", "log", "lists", "nodes", "quarantine", "air", "aside"}) {
    fs::create_directories(dir_ / folder);
  }
  write_tries({});
  for (std::size_t number = 0; number < settings.units(); ++number) add_unit(number, unit(number));
  write_settings(settings);
}

void SweepFolder::write_settings(const SweepSettings& settings) const {
  write(dir_ / kSettings, {{"format", kFormat},
                           {"token", settings.token},
                           {"plan", settings.plan},
                           {"flights", settings.sizes.flights},
                           {"unit_flights", settings.sizes.size},
                           {"tail_flights", settings.sizes.tail},
                           {"tail_unit_flights", settings.sizes.tail_size},
                           {"reference", to_json(settings.reference)},
                           {"digest", settings.digest},
                           {"reference_s", settings.reference_s},
                           {"command", settings.command},
                           {"working_folder", settings.working_folder.string()}});
}

void SweepFolder::add_unit(std::size_t number, const SweepUnit& unit) const {
  Json flights = Json::array();
  for (const SweepFlight& flight : unit.flights) flights.push_back(to_json(flight));
  write(file_of("units", numbered(number)), {{"flights", flights}, {"again", unit.again}});
}

SweepUnit SweepFolder::unit(std::size_t number) const {
  const fs::path file = file_of("units", numbered(number));
  const Json json = read_json(file);
  if (!json.is_object()) throw InputError(file.string() + ": there is no such unit of a sweep");
  SweepUnit unit;
  for (const Json& flight : value_or(json, "flights", Json::array()))
    unit.flights.push_back(sweep_flight_of(flight, file));
  unit.again = value_or(json, "again", false).get<bool>();
  return unit;
}

std::set<std::size_t> SweepFolder::done(const std::string& token) const { return numbers_in(dir_ / "done" / token); }

fs::file_time_type SweepFolder::done_changed(const std::string& token) const {
  std::error_code none;  // ignored: as long as no unit is over, there is no such folder
  return fs::last_write_time(dir_ / "done" / token, none);
}

bool SweepFolder::is_done(const std::string& token, std::size_t unit) const {
  return fs::exists(file_of(fs::path("done") / token, numbered(unit)));
}

std::set<std::size_t> SweepFolder::checks(const std::string& token) const {
  return numbers_in(dir_ / "checks" / token);
}

std::map<std::size_t, SweepFolder::Tries> SweepFolder::tries() const {
  std::map<std::size_t, Tries> tries;
  for (const Json& one : value_or(read_json(dir_ / kTries), "units", Json::array())) {
    tries[count_in(one, "unit")] = {count_in(one, "tries"), count_in(one, "flown")};
  }
  return tries;
}

void SweepFolder::write_tries(const std::map<std::size_t, Tries>& tries) const {
  Json units = Json::array();
  for (const auto& [unit, one] : tries) units.push_back({{"unit", unit}, {"tries", one.tries}, {"flown", one.flown}});
  write(dir_ / kTries, {{"units", units}});
}

void SweepFolder::write_done(const std::string& token, std::size_t unit, const std::vector<SweepRow>& rows) const {
  Json flights = Json::array();
  for (const SweepRow& row : rows) flights.push_back(to_json(row));
  write(file_of(fs::path("done") / token, numbered(unit)), {{"flights", flights}});
}

std::optional<std::vector<SweepRow>> SweepFolder::rows(const std::string& token, std::size_t unit) const {
  const Json json = read_json(file_of(fs::path("done") / token, numbered(unit)));
  if (!json.is_object()) return std::nullopt;
  std::vector<SweepRow> rows;
  for (const Json& row : value_or(json, "flights", Json::array())) rows.push_back(row_of(row));
  return rows;
}

void SweepFolder::reopen(const std::string& token, std::size_t unit) const {
  step();
  fs::remove(file_of(fs::path("done") / token, numbered(unit)));
}

Json SweepFolder::node(const std::string& name) const { return read_json(file_of("nodes", file_name(name))); }

void SweepFolder::write_node(const std::string& name, const Json& facts) const {
  write(file_of("nodes", file_name(name)), facts);
}

std::vector<std::string> SweepFolder::nodes() const {
  std::vector<std::string> nodes;
  for (const std::string& name : names_in(dir_ / "nodes")) {
    nodes.push_back(text_in(read_json(file_of("nodes", name)), "node"));
  }
  return nodes;
}

void SweepFolder::quarantine(const std::string& node, const std::string& reason) const {
  if (!quarantined(node)) write(file_of("quarantine", file_name(node)), {{"node", node}, {"reason", reason}});
}

std::optional<std::string> SweepFolder::quarantined(const std::string& node) const {
  const fs::path file = file_of("quarantine", file_name(node));
  if (!fs::exists(file)) return std::nullopt;
  return text_in(read_json(file), "reason");
}

std::set<std::string> SweepFolder::quarantined_nodes() const {
  std::set<std::string> nodes;
  for (const std::string& name : names_in(dir_ / "quarantine")) {
    nodes.insert(text_in(read_json(file_of("quarantine", name)), "node"));
  }
  return nodes;
}

void SweepFolder::note_sick(const std::string& node, const std::string& reason) const {
  write(file_of("sick", file_name(node)), {{"node", node}, {"reason", reason}});
}

std::set<std::string> SweepFolder::sick_nodes() const {
  std::set<std::string> nodes;
  for (const std::string& name : names_in(dir_ / "sick"))
    nodes.insert(text_in(read_json(file_of("sick", name)), "node"));
  return nodes;
}

void SweepFolder::forget_sick() const {
  step();
  remove(dir_ / "sick");
}

void SweepFolder::write_check(const std::string& token, const SweepCheck& check) const {
  write(file_of(fs::path("checks") / token, numbered(check.index)), {{"index", check.index},
                                                                     {"node", check.node},
                                                                     {"digest", check.digest},
                                                                     {"first_node", check.first_node},
                                                                     {"first_digest", check.first_digest}});
}

std::optional<SweepCheck> SweepFolder::check(const std::string& token, std::size_t index) const {
  const Json json = read_json(file_of(fs::path("checks") / token, numbered(index)));
  if (!json.is_object()) return std::nullopt;
  return SweepCheck{count_in(json, "index"), text_in(json, "node"), text_in(json, "digest"),
                    text_in(json, "first_node"), text_in(json, "first_digest")};
}

void SweepFolder::forget_check(const std::string& token, std::size_t index) const {
  step();
  fs::remove(file_of(fs::path("checks") / token, numbered(index)));
}

fs::path SweepFolder::make_unfinished_folder(const std::string& node) const {
  // Process ids repeat between machines, and containers may share a node's name.
  std::random_device chance;
  const std::string unique = fmt::format("{}-{}-{:08x}{:08x}", file_name(node), ::getpid(), chance(), chance());
  fs::path place = dir_ / "air" / unique;
  step();
  fs::create_directories(place);
  close_to_agents(place);
  return place;
}

void SweepFolder::write_unfinished(const fs::path& file, std::string_view text) const {
  write_file_atomically(file, text, Readers::all, flush_);
}

bool SweepFolder::move_to_results(const fs::path& flown, const fs::path& dir,
                                  const std::function<bool(const fs::path&)>& stays) const {
  fs::create_directories(dir.parent_path());
  for (;;) {
    step();
    std::error_code error;
    fs::rename(flown, dir, error);
    if (!error) return true;
    const bool taken = error == std::errc::directory_not_empty || error == std::errc::file_exists;
    if (!taken) throw fs::filesystem_error("cannot move a finished flight to its folder", flown, dir, error);
    if (stays(dir)) {
      step();
      remove(flown);
      return false;
    }
    // After stays(dir) above, another program may have moved a good folder there: then move that folder back.
    const fs::path aside = set_aside(dir);
    if (!aside.empty() && stays(aside)) fs::rename(aside, dir, error);
  }
}

fs::path SweepFolder::set_aside(const fs::path& dir) const {
  std::random_device chance;
  const fs::path aside = dir_ / "aside" / fmt::format("{}-{:08x}{:08x}", dir.filename().string(), chance(), chance());
  step();
  std::error_code error;
  fs::rename(dir, aside, error);
  if (!error) return aside;
  if (error == std::errc::no_such_file_or_directory) return {};  // another program was faster
  throw fs::filesystem_error("cannot move a flight to aside/", dir, aside, error);
}

void SweepFolder::remove(const fs::path& dir) {
  std::error_code ignored;
  fs::remove_all(dir, ignored);
}

void SweepFolder::remove_unfinished() const {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(dir_ / "air", none)) remove(entry.path());
}

}  // namespace skein::cli

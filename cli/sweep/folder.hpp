// The folder of a sweep: a study, or a round of a hunt, that is flown unit by unit by any number of programs on any
// number of machines that share it. It is what they have in common; there is nothing else:
//
//   sweep.json       what is flown, with a token that tells this sweep from a former one in the same folder
//   units/N.json     the flights of unit N
//   done/TOKEN/N.json  what came of them, written once all are over
//   nodes/NODE.json  how a node did with the reference flight
//   quarantine/NODE.json  why nothing of a node counts
//   sick/NODE.json   why a node does not fly now
//   checks/TOKEN/I.json  flight I, flown again elsewhere
//   tries.json       how often units were given to the engine
//   log/N.log        what was said while unit N flew
//   air/             flights that are not over
//   aside/           folders that others took the place of
//
// Whatever is written appears whole or not at all: files by write_file_atomically(), flights by one rename of their
// folder. So a program may be killed at any moment, two may fly the same unit at once, and a full disk loses no more
// than what is in the air.   Threads: any; each program has an object of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "process/json_text.hpp"

namespace skein::cli {

/// A flight as any node can fly it.
struct SweepFlight {
  std::size_t index = 0;               ///< in the sweep
  std::filesystem::path dir;           ///< where its results belong
  std::vector<std::string> arguments;  ///< of `skein`; the folder in them is another one while it is in the air
  Json made_under;                     ///< all that its result depends on
};

struct SweepUnit {
  std::vector<SweepFlight> flights;
  bool again = false;  ///< not a unit of the sweep, but flights that are flown again on other nodes
};

/// What came of a flight.
struct SweepRow {
  std::size_t index = 0;
  std::string node;
  std::string problem;  ///< empty: none
  Json figures;         ///< null: no result that counts
};

/// A flight that was flown again.
struct SweepCheck {
  std::size_t index = 0;
  std::string node, digest;              ///< of the second flight
  std::string first_node, first_digest;  ///< of the one that counts
};

/// What a sweep is, as its programs read it.
struct SweepSettings {
  std::string token;                     ///< no other sweep of this folder has it
  std::string plan;                      ///< digest of all flights
  std::size_t flights = 0;               ///< how many
  std::size_t unit_flights = 1;          ///< unit N has the flights from N times that on
  SweepFlight reference;                 ///< that each node flies first
  std::string digest;                    ///< what must come of it; empty: it has none
  std::vector<std::string> command;      ///< words behind `skein` that go on with the sweep
  std::filesystem::path working_folder;  ///< where
  double reference_s = 0.0;              ///< of wall time, that the reference flight took where it was planned

  std::size_t units() const { return (flights + unit_flights - 1) / unit_flights; }
};

class SweepFolder {
 public:
  /// @param study  the folder of the study, absolute
  explicit SweepFolder(std::filesystem::path study) : dir_(std::move(study) / "sweep") {}

  const std::filesystem::path& dir() const { return dir_; }
  std::filesystem::path log_of(std::size_t unit) const;

  /// nullopt: there is no sweep, or another version's.
  std::optional<SweepSettings> settings() const;
  /// Begins a sweep in the place of a former one. Results of flights stay where they are.
  /// @param nodes_stay  what is known of nodes, too: the reference flight is the same
  void begin(const SweepSettings& settings, bool nodes_stay,
             const std::function<SweepUnit(std::size_t number)>& unit) const;
  /// What may change of a sweep that goes on: how it is called.
  void write_settings(const SweepSettings& settings) const;
  /// A unit beyond those of the sweep.
  void add_unit(std::size_t number, const SweepUnit& unit) const;
  /// @throws InputError when there is no such unit.
  SweepUnit unit(std::size_t number) const;

  // Of the sweep with this token: a program of a former one, which is about to end, may still write its own.
  /// Units that are over.
  std::set<std::size_t> done(const std::string& token) const;
  bool is_done(const std::string& token, std::size_t unit) const;
  void write_done(const std::string& token, std::size_t unit, const std::vector<SweepRow>& rows) const;
  /// nullopt: it is not over.
  std::optional<std::vector<SweepRow>> rows(const std::string& token, std::size_t unit) const;
  /// It must be flown again, as far as its flights are not there.
  void reopen(const std::string& token, std::size_t unit) const;

  Json node(const std::string& name) const;
  void write_node(const std::string& name, const Json& facts) const;
  std::vector<std::string> nodes() const;

  /// Nothing of this node counts. The first reason stays.
  void quarantine(const std::string& node, const std::string& reason) const;
  /// Why; nullopt: it may fly.
  std::optional<std::string> quarantined(const std::string& node) const;
  std::set<std::string> quarantined_nodes() const;

  /// Nothing should fly on this node until the user calls again: its disk is full, say. What it has flown counts.
  void note_sick(const std::string& node, const std::string& reason) const;
  std::set<std::string> sick_nodes() const;
  void forget_sick() const;

  void write_check(const std::string& token, const SweepCheck& check) const;
  std::optional<SweepCheck> check(const std::string& token, std::size_t index) const;
  void forget_check(const std::string& token, std::size_t index) const;
  std::set<std::size_t> checks(const std::string& token) const;

  /// How often units were given to an engine, by number, and how many of their flights were there then.
  struct Tries {
    std::size_t tries = 0, flown = 0;
  };
  std::map<std::size_t, Tries> tries() const;
  void write_tries(const std::map<std::size_t, Tries>& tries) const;

  /// A new folder for a flight of this program, whose name nobody else takes.
  std::filesystem::path place_in_the_air(const std::string& node) const;
  /// Puts a flown folder where it belongs. @param stays  whether what is there already is as good.
  /// @returns false when that stays; then `flown` is gone.
  bool land(const std::filesystem::path& flown, const std::filesystem::path& dir,
            const std::function<bool(const std::filesystem::path&)>& stays) const;
  /// What is in the place of a flight goes aside. @returns where; empty: there was nothing.
  std::filesystem::path set_aside(const std::filesystem::path& dir) const;
  /// With all that is in it, as far as that can be: other programs may still write there.
  static void remove(const std::filesystem::path& dir);
  /// What killed programs left in the air.
  void clear_air() const;

  /// Of tests: called before each step that another program may notice.
  void on_step(std::function<void()> step) { step_ = std::move(step); }

 private:
  std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& name) const;
  void write(const std::filesystem::path& file, const Json& json) const;
  void step() const {
    if (step_) step_();
  }

  std::filesystem::path dir_;
  std::function<void()> step_;
};

Json to_json(const SweepFlight& flight);
/// @throws InputError for what is no such thing.
SweepFlight sweep_flight_of(const Json& json);

}  // namespace skein::cli

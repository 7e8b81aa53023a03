// The folder of a sweep: a study, or a round of a hunt, that any number of programs on any number of machines fly unit
// by unit. The folder, on a shared file system, is all that these programs share:
//
//   sweep.json       what is flown, with a token that tells this sweep from an earlier one in the same folder
//   units/N.json     the flights of unit N
//   done/TOKEN/N.json  results of unit N, written when all its flights are over
//   nodes/NODE.json  a node's result of the reference flight
//   quarantine/NODE.json  why no result of a node counts
//   sick/NODE.json   why a node should not fly at present
//   checks/TOKEN/I.json  digest of flight I when it was flown again on another node
//   tries.json       how often units were given to the engine
//   log/N.log        output while unit N flew; and the engines' logs
//   lists/           files of the engines: which units a job has, and their scripts
//   air/             flights that are not over
//   aside/           folders of flights that were replaced by others
//
// Every write is atomic: files by write_file_atomically(), flights by a single rename of their folder. So a program may
// be killed at any moment, two programs may fly the same unit at once, and a full disk loses only the flights that are
// in the air.   Threads: any; each program has its own object.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/sweep/unit_sizes.hpp"
#include "process/files/atomic_file.hpp"
#include "process/json_text.hpp"
#include "run/run_options.hpp"

namespace skein::cli {

/// A flight, described so that any node can fly it.
struct SweepFlight {
  std::size_t index = 0;      ///< in the sweep
  std::filesystem::path dir;  ///< folder where its results belong
  RunOptions run;             ///< while it flies, with another results folder
  Json made_under;            ///< everything on which its result depends
};

struct SweepUnit {
  std::vector<SweepFlight> flights;
  bool again = false;  ///< an extra unit: flights that are repeated on other nodes as a check
};

/// The result of a flight.
struct SweepRow {
  std::size_t index = 0;
  std::string node;
  std::string problem;  ///< empty: none
  Json figures;         ///< null: no result that counts
};

/// Comparison of a flight with its repetition on another node.
struct SweepCheck {
  std::size_t index = 0;
  std::string node, digest;              ///< of the repetition
  std::string first_node, first_digest;  ///< of the flight that counts
};

/// Description of a sweep, as its programs read it from sweep.json.
struct SweepSettings {
  std::string token;                     ///< unique among the sweeps of this folder
  std::string plan;                      ///< digest of all flights
  UnitSizes sizes;                       ///< number of flights, and their division into units
  SweepFlight reference;                 ///< the flight that each node flies first
  std::string digest;                    ///< digest that the reference flight must have; empty: none
  std::vector<std::string> command;      ///< arguments of `skein` that continue the sweep
  std::filesystem::path working_folder;  ///< folder in which to run that command
  double reference_s = 0.0;              ///< wall time of the reference flight where the sweep was planned

  std::size_t units() const { return sizes.units(); }
};

class SweepFolder {
 public:
  /// @param study  the folder of the study, absolute
  explicit SweepFolder(const std::filesystem::path& study) : dir_(study / "sweep") {}

  const std::filesystem::path& dir() const { return dir_; }
  std::filesystem::path log_of(std::size_t unit) const;

  /// nullopt: there is no sweep, or sweep.json has another format. @throws InputError when it is damaged.
  std::optional<SweepSettings> settings() const;
  /// The message for the user that says why settings() returned nullopt.
  std::string why_no_settings() const;
  /// Begins a sweep, and deletes the files of an earlier one. The results folders of its flights stay.
  /// @param nodes_stay  keep nodes/ and quarantine/, since the reference flight is the same. @param unit  makes a unit
  void begin(const SweepSettings& settings, bool nodes_stay,
             const std::function<SweepUnit(std::size_t number)>& unit) const;
  /// Writes sweep.json. In a running sweep only `command` and `working_folder` may change.
  void write_settings(const SweepSettings& settings) const;
  /// Writes the file of a unit; begin() writes those of the sweep, later calls add extra units.
  void add_unit(std::size_t number, const SweepUnit& unit) const;
  /// @throws InputError when there is no such unit.
  SweepUnit unit(std::size_t number) const;

  // Results are stored by the sweep's token, because a program of an earlier sweep may still write one before it ends.
  /// Numbers of the units that are over.
  std::set<std::size_t> done(const std::string& token) const;
  /// When a unit was last marked as over or reopened, by the file system's clock: two changes may have the same time.
  std::filesystem::file_time_type done_changed(const std::string& token) const;
  bool is_done(const std::string& token, std::size_t unit) const;
  void write_done(const std::string& token, std::size_t unit, const std::vector<SweepRow>& rows) const;
  /// Results of a unit; nullopt: it is not over.
  std::optional<std::vector<SweepRow>> rows(const std::string& token, std::size_t unit) const;
  /// Marks a unit as not over: those of its flights whose results are missing must be flown.
  void reopen(const std::string& token, std::size_t unit) const;

  Json node(const std::string& name) const;
  void write_node(const std::string& name, const Json& facts) const;
  std::vector<std::string> nodes() const;

  /// No result of this node counts from now on. Keeps the reason of the first call.
  void quarantine(const std::string& node, const std::string& reason) const;
  /// The reason; nullopt: the node is not in quarantine.
  std::optional<std::string> quarantined(const std::string& node) const;
  std::set<std::string> quarantined_nodes() const;

  /// The node should not fly until the user continues the sweep, say because its disk is full. Its results count.
  void note_sick(const std::string& node, const std::string& reason) const;
  std::set<std::string> sick_nodes() const;
  void forget_sick() const;

  void write_check(const std::string& token, const SweepCheck& check) const;
  std::optional<SweepCheck> check(const std::string& token, std::size_t index) const;
  void forget_check(const std::string& token, std::size_t index) const;
  std::set<std::size_t> checks(const std::string& token) const;

  /// How often a unit was given to an engine, and how many of its flights had results then.
  struct Tries {
    std::size_t tries = 0, flown = 0;
  };
  std::map<std::size_t, Tries> tries() const;  ///< by number of the unit
  void write_tries(const std::map<std::size_t, Tries>& tries) const;

  /// Creates a folder in air/ for a flight of this program, with a unique name.
  std::filesystem::path make_unfinished_folder(const std::string& node) const;
  /// Writes a file of a flight in air/.
  void write_unfinished(const std::filesystem::path& file, std::string_view text) const;
  /// Moves the folder of a finished flight from air/ to `dir`. @param stays  whether a folder that is already there is
  ///   good and stays.
  /// @returns false if that folder stays; then `flown` is deleted. @throws std::filesystem::filesystem_error
  bool move_to_results(const std::filesystem::path& flown, const std::filesystem::path& dir,
                       const std::function<bool(const std::filesystem::path&)>& stays) const;
  /// Moves a flight's folder into aside/. @returns its new path; empty: there was no such folder.
  std::filesystem::path set_aside(const std::filesystem::path& dir) const;
  /// Deletes a folder with its contents, as far as possible: other programs may still write there. Never throws.
  static void remove(const std::filesystem::path& dir);
  /// Deletes all folders in air/, which killed programs have left there.
  void remove_unfinished() const;

  /// For tests: `step` is called before each operation whose effect other programs can see.
  void on_step(std::function<void()> step) { step_ = std::move(step); }
  /// For tests of many sweeps: files are not flushed to the disk, which takes longer than all else. Other programs see
  /// the same files.
  void never_flush() { flush_ = Flush::none; }

 private:
  std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& name) const;
  void write(const std::filesystem::path& file, const Json& json) const;
  void step() const {
    if (step_) step_();
  }

  std::filesystem::path dir_;
  std::function<void()> step_;
  Flush flush_ = Flush::to_disk;
};

Json to_json(const SweepFlight& flight);
/// @param file  of which the JSON is a part. @throws InputError that names it, when the JSON is not a complete flight.
SweepFlight sweep_flight_of(const Json& json, const std::filesystem::path& file);

}  // namespace skein::cli

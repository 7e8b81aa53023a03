#include "cli/sweep/unit_run.hpp"

#include <ostream>

#include "cli/study/flights.hpp"
#include "core/types.hpp"
#include "host/preflight.hpp"
#include "results/run_folder.hpp"

namespace skein::cli {
namespace {

namespace fs = std::filesystem;

/// One call of fly_unit().
class UnitRun {
 public:
  UnitRun(const SweepFolder& folder, std::size_t number, const SweepNode& node, std::ostream& say)
      : folder_(folder), number_(number), node_(node), say_(say) {
    const auto settings = folder.settings();
    if (!settings) throw InputError(folder.why_no_settings());
    settings_ = *settings;
    unit_ = folder.unit(number);
  }

  void run() {
    check_node();
    std::vector<SweepRow> rows;
    for (const SweepFlight& flight : unit_.flights) {
      if (unit_.again) {
        fly_again(flight);
      } else {
        rows.push_back(fly(flight));
      }
    }
    check_still_wanted();
    folder_.write_done(settings_.token, number_, rows);
  }

 private:
  void check_still_wanted() const {
    const auto now = folder_.settings();
    if (!now || now->token != settings_.token)
      throw NodeTrouble("the study has been planned again since: this unit is no longer needed");
    if (const auto reason = folder_.quarantined(node_.name)) {
      throw NodeTrouble("no result of the node " + node_.name + " counts: " + *reason);
    }
  }

  void check_node() const {
    check_still_wanted();
    for (const SweepFlight& flight : unit_.flights) {
      if (const std::string how = node_.unlike(flight); !how.empty()) {
        folder_.note_sick(node_.name, how);
        throw NodeTrouble(how);
      }
    }
    const Json known = folder_.node(node_.name);
    if (text_in(known, "boot") != node_.boot || text_in(known, "reference") != reference_text()) prove_node();
  }

  /// The reference flight and its expected digest. The rounds of a hunt share them, so a node need not fly it for each.
  std::string reference_text() const { return to_json(settings_.reference).dump() + settings_.digest; }

  /// Flies the reference flight, and records the node; quarantines it if the digest differs.
  /// @throws NodeTrouble if the node may not fly
  void prove_node() const {
    const std::string digest = reference_digest();
    if (digest != settings_.digest) {
      folder_.quarantine(node_.name,
                         "its reference flight has the digest '" + digest + "' and not '" + settings_.digest + "'");
      check_still_wanted();
    }
    folder_.write_node(node_.name, {{"node", node_.name},
                                    {"boot", node_.boot},
                                    {"cpu", node_.cpu},
                                    {"reference", reference_text()},
                                    {"digest", digest}});
  }

  std::string reference_digest() const try {
    return fly_reference(folder_, settings_.reference, node_);
  } catch (const NodeTrouble& trouble) {
    folder_.note_sick(node_.name, trouble.what());
    throw;
  }

  SweepRow fly(const SweepFlight& flight) const {
    if (auto row = row_in_place(folder_, flight, node_, &say_)) return std::move(*row);
    check_still_wanted();
    const fs::path air = folder_.make_unfinished_folder(node_.name);
    try {
      return finish(flight, air, node_.fly(flight, air));
    } catch (const std::exception&) {  // frees the space, since the disk may be full
      SweepFolder::remove(air);
      throw;
    } catch (const Interrupted&) {
      SweepFolder::remove(air);
      throw;
    }
  }

  /// Writes the mark of a finished flight, then moves its folder to its place.
  SweepRow finish(const SweepFlight& flight, const fs::path& air, const ExitStatus& exit) const {
    const Json result = read_json(air / run_folder::kResult);
    SweepRow row{flight.index, node_.name, "", nullptr};
    if (!exit.ok() || !went_to_its_end(result)) {
      row.problem = node_.reason(air, exit);
      prove_node();  // throws if the node is the cause
    }
    if (went_to_its_end(result)) row.figures = node_.figures(result);
    const Json mark = {{"command", flight.made_under},
                       {"problem", row.problem},
                       {"node", row.node},
                       {"exit", {{"code", exit.code}, {"signal", exit.signal}}}};
    folder_.write_unfinished(air / kFlightMark, json_text(mark, 2) + "\n");
    check_still_wanted();
    put_in_place(flight, air, text_in(result, "digest"), row);
    say_ << flight.dir.string() << ": " << (row.problem.empty() ? "flown" : row.problem) << std::endl;
    return row;
  }

  /// If another program has put a good result there first, that one stays; if it is of another node, records a check.
  void put_in_place(const SweepFlight& flight, const fs::path& air, const std::string& digest, SweepRow& row) const {
    std::optional<SweepRow> sooner;
    const auto stays = [&](const fs::path& dir) {
      SweepFlight there = flight;
      there.dir = dir;
      sooner = row_in_place(folder_, there, node_);
      if (!sooner) check_still_wanted();  // the result there may be of a newer sweep
      return sooner.has_value();
    };
    if (folder_.move_to_results(air, flight.dir, stays)) return;
    const std::string first = text_in(sooner->figures, "digest");
    if (sooner->node != row.node && row.problem.empty() && !first.empty() && !digest.empty()) {
      folder_.write_check(settings_.token, {flight.index, row.node, digest, sooner->node, first});
    }
    row = std::move(*sooner);
  }

  void fly_again(const SweepFlight& flight) const {
    check_still_wanted();
    const auto first = row_in_place(folder_, flight, node_);
    if (!first || first->node == node_.name) return;
    const auto known = folder_.check(settings_.token, flight.index);
    const std::string digest = text_in(first->figures, "digest");
    if (known && known->first_node == first->node && known->first_digest == digest) return;
    const std::string again = digest_here(folder_, flight, node_);
    check_still_wanted();
    folder_.write_check(settings_.token, {flight.index, node_.name, again, first->node, digest});
    say_ << flight.dir.string() << ": flown again, "
         << (again == digest ? "with the same digest" : "with another digest") << std::endl;
  }

  const SweepFolder& folder_;
  const std::size_t number_;
  const SweepNode& node_;
  std::ostream& say_;
  SweepSettings settings_;
  SweepUnit unit_;
};

/// Flies a flight in air/, and deletes its folder. @returns what `look` returns for the folder.
auto flown_aside(const SweepFolder& folder, const SweepFlight& flight, const SweepNode& node, const auto& look) {
  const fs::path air = folder.make_unfinished_folder(node.name);
  try {
    const ExitStatus exit = node.fly(flight, air);
    const auto seen = look(air, exit);
    SweepFolder::remove(air);
    return seen;
  } catch (...) {
    SweepFolder::remove(air);
    throw;
  }
}

}  // namespace

void fly_unit(const SweepFolder& folder, std::size_t unit, const SweepNode& node, std::ostream& say) {
  UnitRun(folder, unit, node, say).run();
}

std::optional<SweepRow> row_in_place(const SweepFolder& folder, const SweepFlight& flight, const SweepNode& node,
                                     std::ostream* say) {
  const Json mark = read_json(flight.dir / kFlightMark);
  if (!is_of_sound_flight(mark, flight.made_under)) return std::nullopt;
  const std::string flown_by = text_in(mark, "node");
  if (folder.quarantined(flown_by)) return std::nullopt;
  const Json result = sound_result(flight.dir, say);
  if (!went_to_its_end(result)) return std::nullopt;
  return SweepRow{flight.index, flown_by, "", node.figures(result)};
}

std::string fly_reference(const SweepFolder& folder, const SweepFlight& reference, const SweepNode& node) {
  return flown_aside(folder, reference, node, [&](const fs::path& air, const ExitStatus& exit) {
    const Json result = read_json(air / run_folder::kResult);
    if (!exit.ok() || !went_to_its_end(result)) {
      throw NodeTrouble("the reference flight fails on " + node.name + ": " + node.reason(air, exit));
    }
    return text_in(result, "digest");
  });
}

std::string digest_here(const SweepFolder& folder, const SweepFlight& flight, const SweepNode& node) {
  return flown_aside(folder, flight, node, [&](const fs::path& air, const ExitStatus& exit) {
    const Json result = read_json(air / run_folder::kResult);
    if (!exit.ok() || !went_to_its_end(result)) {
      throw NodeTrouble(node.name + ": " + flight.dir.string() + ", flown again, fails: " + node.reason(air, exit));
    }
    return text_in(result, "digest");
  });
}

}  // namespace skein::cli

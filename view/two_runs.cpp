#include "view/two_runs.hpp"

#include <algorithm>
#include <utility>

#include "core/types.hpp"
#include "view/finished_run.hpp"

namespace skein::view {
namespace {

namespace fs = std::filesystem;
using results::RunRecord;

/// Points that are nearer to each other than this are the same; tables are rounded to millimetres.
constexpr double kSamePlace_m = 0.002;

bool same_scene(const RunRecord& a, const RunRecord& b) {
  return std::ranges::equal(a.points, b.points, [](const results::RunPoint& one, const results::RunPoint& other) {
    return (one.p_W - other.p_W).norm() < kSamePlace_m;
  });
}

std::string scene_name(const RunRecord& run) {
  const Json seed = value_or(run.result, "scene_seed", Json());
  return text_in(run.result, "scenario") + (seed.is_number_integer() ? " with scene seed " + seed.dump() : "") + ", " +
         std::to_string(run.points.size()) + " points";
}

Json parting_json(const Parting& parting) {
  Json json = Json::object();
  if (!parting.unknown.empty()) json["unknown"] = parting.unknown;
  if (parting.time_s) {
    json["t"] = *parting.time_s;
    json["fields"] = parting.fields;
  }
  return json;
}

}  // namespace

void tell_two_runs(const fs::path& a, const fs::path& b, const Parting& parting, Feed& feed) {
  const RunRecord first = results::read_sound_run(a), second = results::read_sound_run(b);
  if (!same_scene(first, second)) {
    throw InputError(a.string() + " and " + b.string() + " were flown in different scenes (" + scene_name(first) +
                     "; " + scene_name(second) + "): two runs on one page must have the same interest points");
  }
  ToldRun told = told_run(first), other = told_run(second);
  told.scene["difference"] = parting_json(parting);
  told.scene["fleets_differ"] = first.uavs != second.uavs || first.explorer != second.explorer;
  for (const Json& missing : other.scene["missing"])
    told.scene["missing"].push_back("B: " + missing.get<std::string>());
  other.scene.erase("missing");
  told.scene["other"] = std::move(other.scene);
  feed.set_scene(told.scene.dump(-1, ' ', false, Json::error_handler_t::replace));
  for (std::string& line : told.lines) feed.add_line(std::move(line));
  for (const std::string& line : other.lines) feed.add_line(R"({"k":"other","line":)" + line + "}");
}

}  // namespace skein::view

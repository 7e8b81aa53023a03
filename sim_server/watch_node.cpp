#include "sim_server/watch_node.hpp"

#include <spdlog/spdlog.h>

#include "bus/lockstep/names.hpp"
#include "bus/typed.hpp"
#include "core/camera_quality.hpp"
#include "core/topics.hpp"
#include "core/view_topics.hpp"
#include "process/run_tables.hpp"
#include "sim_server/record/run_files.hpp"

namespace skein::sim {
namespace {

/// Between two states: as many pictures as a page shows.
constexpr std::chrono::milliseconds kStatePeriod{80};
const Tick kPosePeriod = ticks(view::kTrailPeriod_s);

/// As far as it is known while the run goes on: a scene with points of which nobody has seen anything.
report::RunData scene_of(const Scenario& scenario, const Scene& scene) {
  report::RunData run;
  for (const UavConfig& uav : scenario.fleet) {
    run.uavs.push_back(uav.name);
    run.explorer.push_back(uav.vehicle.role == Role::explorer);
  }
  for (const OrientedBox& box : scene.boxes) run.boxes.push_back({box.name, box.center, box.size, box.R_WO});
  for (const InterestPoint& point : scene.points) {
    report::RunPoint shown;
    shown.p_W = point.p_W.cast<double>();
    shown.normal_W = point.n_W.cast<double>();
    run.points.push_back(shown);
  }
  run.station = scenario.station_position;
  return run;
}

}  // namespace

WatchNode::WatchNode(const Scenario& scenario, const Simulation& simulation, EventLog& events, bus::Inbox& inbox,
                     bus::Participant& world, const WatchOptions& options)
    : scenario_(scenario),
      simulation_(simulation),
      options_(options),
      pace_(options.paced ? options.speed : std::nullopt),
      story_(world.create_writer(bus::spec(topics::view_story()))),
      state_(world.create_writer(bus::spec(topics::view_state()))) {
  if (options_.paced) {
    orders_ =
        bus::subscribe<msg::String>(inbox, world, bus::spec(topics::view_time()), [this](const msg::String& text) {
          const auto order = view::read_time_order(text.data());
          if (!order) return;
          pace_.obey(*order);
          state_stale_ = true;
        });
  }
  events.tell([this](const LoggedEvent& event) {
    if (event.event != run_tables::kJoined && event.event != run_tables::kLeft) return;
    tell(view::event_line(seconds(event.tick), event.event, event.subject, event.object));
  });
  tell_scene();
}

void WatchNode::tell(const std::string& line) {
  msg::String text;
  text.data(line);
  story_->write(encode(text));
}

void WatchNode::tell_scene() {
  std::vector<CameraConfig> cameras;
  std::vector<double> range_m;
  for (const UavConfig& uav : scenario_.fleet) {
    cameras.push_back(uav.vehicle.camera);
    range_m.push_back(resolution_distance(uav.vehicle.camera, scenario_.desired_mm_per_pixel));
  }
  Json scene = view::scene_json(scene_of(scenario_, simulation_.scene()), cameras, range_m);
  scene["mode"] = "live";
  scene["paced"] = options_.paced;
  scene["scenario"] = scenario_.name;
  scene["duration"] = scenario_.duration_s;
  tell(scene.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::vector<view::ShownUav> WatchNode::shown_uavs() const {
  std::vector<view::ShownUav> shown;
  for (const UavView& uav : simulation_.uavs()) shown.push_back({uav.state, uav.gimbal, uav.alive});
  return shown;
}

std::vector<view::ShownLink> WatchNode::shown_links() const {
  using view::ShownLink;
  const auto is_dead = [this](Node node) {
    const auto uav = uav_of_node(node);
    return uav && !simulation_.uav(*uav).alive;
  };
  std::vector<ShownLink> shown;
  for (const Node from : scenario_.nodes()) {
    for (const Node to : scenario_.nodes()) {
      const bool there = simulation_.links().at(from, to) != 0, open = simulation_.open_links().at(from, to) != 0;
      shown.push_back(is_dead(from) || is_dead(to) ? ShownLink::dead
                      : open                       ? ShownLink::linked
                      : there                      ? ShownLink::cut
                                                   : ShownLink::blocked);
    }
  }
  return shown;
}

void WatchNode::begin_step(const std::vector<std::string>& faults) {
  const double now_s = seconds(simulation_.tick());
  for (const std::string& fault : faults) tell(view::event_line(now_s, "fault", fault, ""));
  for (const Collision& collision : simulation_.events().collisions) {
    tell(view::event_line(seconds(collision.tick), "collision", scenario_.fleet[collision.uav].name,
                          collided_with(collision, scenario_)));
  }
  if (std::vector<view::ShownLink> links = shown_links(); links != told_links_) {
    tell(view::links_line(now_s, links));
    told_links_ = std::move(links);
  }
  if (simulation_.tick() >= pose_due_) {
    tell(view::pose_line(now_s, shown_uavs()));
    pose_due_ = simulation_.tick() + kPosePeriod;
  }
  state_stale_ = true;
  const auto now = Clock::now();
  if (now - state_told_ >= kStatePeriod) tell_state(now);
}

void WatchNode::tell_state(Clock::time_point now) {
  const Mission& mission = simulation_.mission();
  const double mission_s = mission.start_tick() ? seconds(simulation_.tick() - *mission.start_tick()) : 0.0;
  msg::String text;
  text.data(fmt::format(R"({{"t":{:.3f},"tick":{},"mission":{:.3f},"phase":"{}","paused":{},"speed":"{}","u":{}}})",
                        seconds(simulation_.tick()), simulation_.tick(), mission_s, name_of(mission.phase()),
                        pace_.paused(), view::speed_text(pace_.speed()), view::poses_json(shown_uavs())));
  state_->write(encode(text));
  state_told_ = now;
  state_stale_ = false;
}

bool WatchNode::may_go_on() {
  if (!options_.paced) return true;
  const auto now = Clock::now();
  const bool goes = pace_.may_go_on(now, seconds(scenario_.exchange_ticks()));
  if (!goes && state_stale_ && (pace_.paused() || now - state_told_ >= kStatePeriod)) tell_state(now);
  return goes;
}

std::chrono::milliseconds WatchNode::left() const {
  return std::chrono::ceil<std::chrono::milliseconds>(pace_.left(Clock::now()));
}

}  // namespace skein::sim

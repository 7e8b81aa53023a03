#include "one_process/truth.hpp"

#include <utility>

#include "sim_server/points_shown.hpp"

namespace skein::one_process {
namespace {

void put(std::span<double> to, std::size_t row, const auto& from) {
  const auto size = static_cast<std::size_t>(from.size());
  for (std::size_t i = 0; i < size; ++i) to[row * size + i] = from[static_cast<Eigen::Index>(i)];
}

nlohmann::json vector_json(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

const char* name_of_body(sim::BodyId::Kind kind) {
  return kind == sim::BodyId::Kind::ground ? "ground" : kind == sim::BodyId::Kind::structure ? "structure" : "uav";
}

}  // namespace

void Truth::lay_out(BlockLayout& layout) {
  const std::size_t uavs = uavs_.size();
  const std::string prefix = "truth.";
  step_ = layout.add<std::int64_t>(prefix + "step");
  time_s_ = layout.add<double>(prefix + "time_s");
  mission_ = layout.add<std::int8_t>(prefix + "mission");
  score_now_ = layout.add<double>(prefix + "score");
  earned_ = layout.add<double>(prefix + "score_earned");
  points_ = layout.add<std::int64_t>(prefix + "points_detected");
  position_ = layout.add<double>(prefix + "position", {uavs, 3});
  attitude_ = layout.add<double>(prefix + "attitude", {uavs, 4});
  velocity_ = layout.add<double>(prefix + "velocity", {uavs, 3});
  angular_velocity_ = layout.add<double>(prefix + "angular_velocity", {uavs, 3});
  gimbal_ = layout.add<double>(prefix + "gimbal", {uavs, 4});
  alive_ = layout.add<std::int8_t>(prefix + "alive", {uavs});
  airborne_ = layout.add<std::int8_t>(prefix + "airborne", {uavs});
  captures_ = layout.add<std::int64_t>(prefix + "captures", {uavs});
  distance_m_ = layout.add<double>(prefix + "distance_m", {uavs});
}

void Truth::follow(const sim::Simulation& simulation, const sim::RunDigest& digest) {
  simulation_ = &simulation;
  digest_ = &digest;
  for (const sim::Collision& collision : simulation.events().collisions) {
    const bool uav = collision.with.kind == sim::BodyId::Kind::uav;
    collisions_.push_back({{"time_s", seconds(collision.tick)},
                           {"uav", uavs_.at(collision.uav)},
                           {"with", uav ? uavs_.at(collision.with.uav) : name_of_body(collision.with.kind)},
                           {"position", vector_json(collision.p_W)}});
  }
}

void Truth::keep() {
  kept_result_ = result();
  kept_result_["over"] = true;
  kept_scene_ = scene();
  simulation_ = nullptr;
}

void Truth::write(std::byte* block) const {
  if (simulation_ == nullptr) return;
  step_.in(block)[0] = static_cast<std::int64_t>(simulation_->step());
  time_s_.in(block)[0] = seconds(simulation_->tick());
  mission_.in(block)[0] = static_cast<std::int8_t>(simulation_->mission().phase());
  write_score(block);
  for (const UavIndex i : FirstUavs(uavs_.size())) {
    const sim::UavView& uav = simulation_->uav(i);
    const Quaterniond& q = uav.state.q_WB;
    const GimbalState& g = uav.gimbal;
    put(position_.in(block), i, uav.state.p_WB);
    put(attitude_.in(block), i, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
    put(velocity_.in(block), i, uav.state.v_WB);
    put(angular_velocity_.in(block), i, uav.state.w_WB_B);
    put(gimbal_.in(block), i, Eigen::Vector4d(g.pitch, g.yaw, g.pitch_rate, g.yaw_rate));
    alive_.in(block)[i] = uav.alive ? 1 : 0;
    airborne_.in(block)[i] = uav.airborne ? 1 : 0;
    captures_.in(block)[i] = static_cast<std::int64_t>(uav.captures);
    distance_m_.in(block)[i] = uav.distance_m;
  }
}

/// Computes the score earned only if entries of the ledger were added, since the computation is costly.
void Truth::write_score(std::byte* block) const {
  const station::Scoreboard* board = score_->board;
  if (board == nullptr) return;
  const station::TimelinePoint& now = board->timeline().back();
  score_now_.in(block)[0] = now.score;
  points_.in(block)[0] = static_cast<std::int64_t>(now.points);
  if (std::exchange(standing_, board->standing()) != board->standing()) {
    earned_.in(block)[0] = board->earned().score();
  }
}

nlohmann::json Truth::result() const {
  if (simulation_ == nullptr) return kept_result_;
  const sim::Mission& mission = simulation_->mission();
  nlohmann::json uavs = nlohmann::json::array();
  for (const UavIndex i : FirstUavs(uavs_.size())) {
    const sim::UavView& uav = simulation_->uav(i);
    uavs.push_back({{"name", uavs_[i]},
                    {"alive", uav.alive},
                    {"airborne", uav.airborne},
                    {"captures", uav.captures},
                    {"distance_m", uav.distance_m},
                    {"max_speed_mps", uav.max_speed_mps},
                    {"idle_s", uav.idle_s},
                    {"commands_rejected", uav.commands_rejected}});
  }
  const station::Scoreboard* board = score_->board;
  const Tick until = mission.end_tick().value_or(simulation_->tick());
  return {{"over", false},
          {"step", simulation_->step()},
          {"sim_time_s", seconds(simulation_->tick())},
          {"mission_time_s", mission.start_tick() ? seconds(until - *mission.start_tick()) : 0.0},
          {"mission", name_of(mission.phase())},
          {"digest", digest_->hex()},
          {"score", board != nullptr ? board->delivered().score() : 0.0},
          {"score_earned", board != nullptr ? board->earned().score() : 0.0},
          {"points_detected", board != nullptr ? board->delivered().points_detected() : 0},
          {"points_total", simulation_->scene().points.size()},
          {"collisions", collisions_},
          {"uavs", uavs}};
}

nlohmann::json Truth::scene() const {
  if (simulation_ == nullptr) return kept_scene_;
  nlohmann::json boxes = nlohmann::json::array(), points = nlohmann::json::array();
  for (const OrientedBox& box : simulation_->scene().boxes) {
    const Quaterniond q(box.R_WO);
    boxes.push_back({{"name", box.name},
                     {"center", vector_json(box.center)},
                     {"size", vector_json(box.size)},
                     {"attitude", {q.w(), q.x(), q.y(), q.z()}}});
  }
  const station::Scoreboard* board = score_->board;
  const std::vector<bool> seen = sim::points_shown(*simulation_).seen;
  for (std::size_t i = 0; i < simulation_->scene().points.size(); ++i) {
    const InterestPoint& point = simulation_->scene().points[i];
    const float delivered = board != nullptr ? board->delivered().points().at(i).q : 0.0F;
    const float earned = board != nullptr ? board->earned().points().at(i).q : 0.0F;
    points.push_back({point.p_W.x(), point.p_W.y(), point.p_W.z(), point.n_W.x(), point.n_W.y(), point.n_W.z(),
                      delivered, earned, seen.at(i) ? 1 : 0});
  }
  return {{"boxes", boxes}, {"points", points}};
}

}  // namespace skein::one_process

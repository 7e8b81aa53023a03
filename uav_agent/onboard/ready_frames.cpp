#include "uav_agent/onboard/ready_frames.hpp"

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>

namespace skein::agent {
namespace {

std::size_t hash_of(const std::vector<Eigen::Vector3f>& points) {
  const auto* const bytes = reinterpret_cast<const char*>(points.data());
  return std::hash<std::string_view>()({bytes, points.size() * sizeof(points.front())});
}

KeyFrameFilter::Config keeping_lone() {
  KeyFrameFilter::Config config;
  config.lone_min_neighbours = 0;
  return config;
}

}  // namespace

ReadyFrames::ReadyFrames(std::size_t most) : most_(most), keeping_lone_(keeping_lone()) {}

std::shared_ptr<const FrameCells> ReadyFrames::ready(std::vector<Eigen::Vector3f> sound_W,
                                                     const std::optional<Vector3d>& p_WS, bool keep_lone) {
  Question question{std::move(sound_W), p_WS, keep_lone};
  if (most_ == 0) return std::make_shared<const FrameCells>(work_out(question));
  const std::size_t hash = hash_of(question.sound_W);
  std::shared_ptr<Known> one;
  {
    const std::scoped_lock lock(mutex_);
    one = known(std::move(question), hash);
  }
  std::call_once(one->worked_out, [&] { one->frame = work_out(one->question); });
  return {one, &one->frame};
}

FrameCells ReadyFrames::work_out(const Question& question) const {
  return rays_.trace(filter(question.keep_lone).thinned(question.sound_W), question.p_WS);
}

std::shared_ptr<ReadyFrames::Known> ReadyFrames::known(Question&& question, std::size_t hash) {
  for (std::size_t n = 0; n < known_.size(); ++n) {
    const std::size_t place = (expected_ + n) % known_.size();
    if (hashes_[place] != hash || known_[place]->question != question) continue;
    expected_ = place + 1;
    return known_[place];
  }
  auto one = std::make_shared<Known>();
  one->question = std::move(question);
  if (known_.size() < most_) {
    hashes_.push_back(hash);
    return known_.emplace_back(std::move(one));
  }
  const std::size_t place = std::exchange(oldest_, (oldest_ + 1) % known_.size());
  hashes_[place] = hash;
  return known_[place] = std::move(one);
}

}  // namespace skein::agent

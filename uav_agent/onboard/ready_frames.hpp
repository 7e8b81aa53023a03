// Cache of key frames that are prepared for a map: thinned, and traced into cells. The result depends only on the
// frame, and many UAVs receive the same frame, so the agents of one process compute it once. Frame W.   Units: metres.
// Results do not depend on the cache's contents.   Threads: any. A thread that asks for a frame that another thread is
// just computing waits for it.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "uav_agent/maps/occupancy_map.hpp"
#include "uav_agent/onboard/key_frame_filter.hpp"

namespace skein::agent {

class ReadyFrames {
 public:
  /// @param most  number of frames that are remembered; 0: no cache, for a process with a single agent.
  explicit ReadyFrames(std::size_t most = 0);

  /// @param sound_W     see KeyFrameFilter::sound()
  /// @param p_WS        position of the sensor, if known
  /// @param keep_lone   whether isolated hits are kept
  /// @returns the frame for OccupancyMap::insert(), for maps with the default Config.
  std::shared_ptr<const FrameCells> ready(std::vector<Eigen::Vector3f> sound_W, const std::optional<Vector3d>& p_WS,
                                          bool keep_lone);

  const KeyFrameFilter& filter(bool keep_lone) const { return keep_lone ? keeping_lone_ : usual_; }

 private:
  struct Question {
    std::vector<Eigen::Vector3f> sound_W;
    std::optional<Vector3d> p_WS;
    bool keep_lone = false;
    bool operator==(const Question&) const = default;
  };
  struct Known {
    Question question;
    FrameCells frame;
    std::once_flag worked_out;
  };

  FrameCells work_out(const Question& question) const;
  /// The remembered entry for this question, or a new one. The caller holds mutex_.
  std::shared_ptr<Known> known(Question&& question, std::size_t hash);

  const std::size_t most_;
  const KeyFrameFilter usual_;
  const KeyFrameFilter keeping_lone_;
  const OccupancyMap rays_;                    ///< stays empty; used for trace() only
  std::mutex mutex_;                           ///< guards all members below
  std::vector<std::shared_ptr<Known>> known_;  ///< at most most_; a new entry replaces the oldest
  std::vector<std::size_t> hashes_;            ///< of the questions in known_
  std::size_t oldest_ = 0;
  std::size_t expected_ = 0;  ///< index in known_ to try first: all agents use the same frames in the same order
};

}  // namespace skein::agent

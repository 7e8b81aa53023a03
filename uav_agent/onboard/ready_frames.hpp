// Key frames, ready for a map. What it takes to get one ready depends on nothing but the frame, and most frames are
// heard by many: the agents of one process do it once for all of them. Frame W.   Units: metres.
// Pure to who asks: an answer is the same whether or not it was worked out before.   Threads: any. Who asks for what
// another thread works out just now waits for it.
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
  /// @param most  frames that are remembered; one without memory is for an agent that is alone.
  explicit ReadyFrames(std::size_t most = 0);

  /// @param sound_W     see KeyFrameFilter::sound()
  /// @param p_WS        where the sensor stood, if known
  /// @param keep_lone   whether hits without any other near them are kept
  /// @returns what is to be inserted into maps of the usual Config.
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
  /// The one that is remembered; a new one if there is none. Under the lock.
  std::shared_ptr<Known> known(Question&& question, std::size_t hash);

  const std::size_t most_;
  const KeyFrameFilter usual_;
  const KeyFrameFilter keeping_lone_;
  const OccupancyMap rays_;                    ///< empty: it traces
  std::mutex mutex_;                           ///< of all below
  std::vector<std::shared_ptr<Known>> known_;  ///< the oldest is replaced
  std::vector<std::size_t> hashes_;            ///< of the questions in known_
  std::size_t oldest_ = 0;
  std::size_t expected_ = 0;  ///< in known_: who comes after another asks for the same in the same order
};

}  // namespace skein::agent

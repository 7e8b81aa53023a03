#include "results/run_record.hpp"

#include <stdexcept>

#include "results/result_file.hpp"
#include "results/run_rows.hpp"

namespace skein::results {

std::vector<CaptureRow> read_captures(const std::filesystem::path& dir) {
  std::vector<CaptureRow> captures;
  each_row<CaptureCells>(dir, [&](const CaptureCells& row) {
    captures.push_back({row.uav(), row.capture(), row.time_s(), static_cast<int>(row.point()), row.q(),
                        row.delivered_at_s(), row.reason(), row.q_blur(), row.q_res(), row.q_distance()});
  });
  return captures;
}

RunRecord read_run(const std::filesystem::path& dir) {
  RunRecord record;
  record.dir = dir;
  try {
    record.result = read_result_file(dir);
  } catch (const InputError& error) {
    throw std::runtime_error(error.what());
  }
  record.captures = read_captures(dir);
  each_row<EventCells>(dir, [&](const EventCells& row) {
    record.events.push_back({row.step(), row.event(), row.subject(), row.object()});
  });
  each_row<MessageCells>(dir, [&](const MessageCells& row) {
    record.messages.push_back({row.step(), row.uav(), row.arrives()});
  });
  each_row<PoseCells>(dir, [&](const PoseCells& row) {
    const Vector3d p_W = row.p_W(), v_W = row.v_W();
    record.positions.push_back(
        {row.time_s(), row.uav(), p_W, v_W, row.alive_beyond_doubt(), row.clearance_m(), row.charge()});
  });
  each_row<ScoreCells>(dir, [&](const ScoreCells& row) {
    record.scores.push_back({row.time_s(), row.score(), row.points()});
  });
  each_row<WorkCells>(dir, [&](const WorkCells& row) {
    record.work.push_back({row.time_s(), row.uav(), row.without_work_s()});
  });
  return record;
}

}  // namespace skein::results

#include "cli/run/record.hpp"

#include <stdexcept>

#include "process/results/result_file.hpp"
#include "process/run_folder.hpp"
#include "report/csv_table.hpp"

namespace skein::cli {

using report::CsvTable;

std::vector<CaptureRow> read_captures(const std::filesystem::path& dir) {
  std::vector<CaptureRow> captures;
  for (CsvTable table(dir / run_folder::kCaptures); table.next();) {
    captures.push_back({table.text("uav"), table.count("capture"), table.number("time_s"),
                        static_cast<int>(table.number("point")), table.number("q"),
                        table.number_if_any("delivered_at_s"), table.text("reason"), table.number("q_blur"),
                        table.number("q_res"), table.number("q_distance")});
  }
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
  for (CsvTable table(dir / run_folder::kEvents); table.next();) {
    record.events.push_back({table.count("step"), table.text("event"), table.text("subject"), table.text("object")});
  }
  for (CsvTable table(dir / run_folder::kCaptureMessages); table.next();) {
    MessageRow row{table.count("step"), table.text("uav"), std::nullopt};
    if (const auto arrives = table.number_if_any("arrives")) row.arrives = static_cast<std::uint64_t>(*arrives);
    record.messages.push_back(std::move(row));
  }
  for (CsvTable table(dir / run_folder::kTrajectories); table.next();) {
    const Vector3d p_W(table.number("x"), table.number("y"), table.number("z"));
    const Vector3d v_W(table.number("vx"), table.number("vy"), table.number("vz"));
    record.positions.push_back({table.number("time_s"), table.text("uav"), p_W, v_W, table.number("alive") != 0.0,
                                table.number_if_any("clearance")});
  }
  for (CsvTable table(dir / run_folder::kScoreTimeline); table.next();) {
    record.scores.push_back({table.number("time_s"), table.number("score"), table.number("points")});
  }
  for (CsvTable table(dir / run_folder::kWork); table.next();) {
    record.work.push_back({table.number("time_s"), table.text("uav"), table.number("without_work_s")});
  }
  return record;
}

}  // namespace skein::cli

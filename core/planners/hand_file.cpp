#include "core/planners/hand_file.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "core/files/file_bytes.hpp"
#include "core/text/text.hpp"

namespace skein::hand_file {
namespace {

constexpr std::size_t kColumns = 8;
constexpr const char* kHead = "step,tick,ahead,left,up,yaw_rate,gimbal_pitch_rate,gimbal_yaw_rate";
constexpr double kMostCount = 9007199254740992.0;  ///< a double represents all whole numbers up to this one

std::optional<std::uint64_t> whole(const std::string& text) {
  const std::optional<double> number = parse_number(text);
  const bool is_count = number && *number >= 0.0 && *number < kMostCount && std::floor(*number) == *number;
  return is_count ? std::optional(static_cast<std::uint64_t>(*number)) : std::nullopt;
}

std::optional<HandRow> row_of(const std::string& line) {
  const std::vector<std::string> cells = split(line);
  if (cells.size() != kColumns) return std::nullopt;
  const auto step = whole(cells[0]), tick = whole(cells[1]);
  std::array<double, kColumns - 2> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = parse_number(cells[i + 2]);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  if (!step || !tick) return std::nullopt;
  return HandRow{.step = *step,
                 .tick = static_cast<Tick>(*tick),
                 .command = {.velocity = {numbers[0], numbers[1], numbers[2]},
                             .yaw_rate = numbers[3],
                             .gimbal_pitch_rate = numbers[4],
                             .gimbal_yaw_rate = numbers[5]}};
}

}  // namespace

std::string head() { return std::string(kHead) + "\n"; }

std::string line_of(const HandRow& row) {
  const HandCommand& command = row.command;
  std::string line = std::to_string(row.step) + "," + std::to_string(row.tick);
  for (const double number : {command.velocity.x(), command.velocity.y(), command.velocity.z(), command.yaw_rate,
                              command.gimbal_pitch_rate, command.gimbal_yaw_rate}) {
    line += "," + shortest(number);
  }
  return line + "\n";
}

std::vector<HandRow> read(const std::filesystem::path& file) {
  std::ifstream in = open_text(file);
  if (!in) throw InputError(file.string() + ": there is no such file, or it cannot be read");
  std::vector<HandRow> rows;
  std::string line;
  const bool has_head = next_line(in, line, file);
  if (!has_head || line != kHead) {
    throw InputError(file.string() + ":1: a file of commands by hand begins with '" + kHead + "'");
  }
  for (int number = 2; next_line(in, line, file); ++number) {
    const std::string place = file.string() + ":" + std::to_string(number) + ": ";
    const std::optional<HandRow> row = row_of(line);
    if (!row) {
      throw InputError(place + "'" + line.substr(0, 100) + "' is not a command; there must be " +
                       std::to_string(kColumns) + " numbers, of which step and tick are whole and not negative");
    }
    if (!rows.empty() && row->tick <= rows.back().tick) {
      throw InputError(place + "tick " + std::to_string(row->tick) + " does not come after " +
                       std::to_string(rows.back().tick));
    }
    rows.push_back(*row);
  }
  return rows;
}

}  // namespace skein::hand_file

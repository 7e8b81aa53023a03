#include "results/csv_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <sstream>

#include "tests/support/scratch_folder.hpp"

namespace skein::results {
namespace {

class CsvCells : public testing::Test {
 protected:
  /// The result of `read` for a table with this cell in its third line.
  auto read_cell(const std::string& cell, const auto& read) const {
    std::ofstream(file_) << "name,value\nfirst,1\nsecond," << cell << "\n";
    CsvTable table(file_);
    table.next();
    table.next();
    return read(table);
  }
  double number(const std::string& cell) const {
    return read_cell(cell, [](const CsvTable& table) { return table.number("value"); });
  }
  std::uint64_t count(const std::string& cell) const {
    return read_cell(cell, [](const CsvTable& table) { return table.count("value"); });
  }
  /// The error of `read`; "" if there was none.
  std::string error(const auto& read) const {
    try {
      static_cast<void>(read());
      return "";
    } catch (const std::runtime_error& wrong) {
      return wrong.what();
    }
  }

  const ScratchFolder scratch_;
  const std::filesystem::path file_ = scratch_.path() / "table.csv";
};

TEST_F(CsvCells, AreReadAsTheyAreWritten) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const std::uint64_t whole = random() >> (random() % 64);
    EXPECT_EQ(count(std::to_string(whole)), whole);
    const double value = std::ldexp(static_cast<double>(random()) - 0x1p63, static_cast<int>(random() % 200) - 150);
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << value;
    EXPECT_EQ(number(text.str()), value) << text.str();
  }
}

TEST_F(CsvCells, InvalidNumbersAreReportedWithFileAndLine) {
  for (const std::string cell : {"", "x", "1.5abc", "1.5 ", " 1", "1;5", "0x10", "nan", "inf", "1e999", "--1"}) {
    EXPECT_EQ(error([&] { return number(cell); }),
              file_.string() + ":3: column 'value': '" + cell + "' is not a number");
  }
}

TEST_F(CsvCells, InvalidCountsAreReportedWithFileAndLine) {
  for (const std::string cell : {"", "x", "1.5", "-1", "1e3", "3 ", "nan", "18446744073709551616", "1e300"}) {
    const std::string words = "' is not a whole number of at least 0";
    EXPECT_EQ(error([&] { return count(cell); }), file_.string() + ":3: column 'value': '" + cell + words);
  }
  const auto if_any = [](const CsvTable& table) { return table.count_if_any("value"); };
  EXPECT_EQ(read_cell("", if_any), std::nullopt);
  EXPECT_EQ(read_cell("7", if_any), std::optional<std::uint64_t>(7));
}

}  // namespace
}  // namespace skein::results

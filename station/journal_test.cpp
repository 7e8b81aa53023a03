#include "station/journal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "tests/support/text_files.hpp"

namespace skein::station {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, gone afterwards.
class JournalTest : public testing::Test {
 protected:
  JournalTest() {
    std::string pattern = (fs::temp_directory_path() / "skein-journal-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    file_ = folder_ / "station.journal";
  }
  ~JournalTest() override { fs::remove_all(folder_); }

  std::string content() const { return read_text(file_); }
  void set_content(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary | std::ios::trunc) << bytes;
  }

  fs::path folder_, file_;
};

/// Reports with 0, 1, 2, ... points, and a collision now and then.
std::vector<TallyRecord> some_records(std::size_t count) {
  std::vector<TallyRecord> records;
  for (std::size_t i = 0; i < count; ++i) {
    TallyRecord record{static_cast<Tick>(20 * i), {i, static_cast<Tick>(20 * i) - 7, UavIndex(i % 5), i % 4 == 3, {}}};
    if (!record.entry.collision) {
      record.entry.capture = {UavIndex(i % 5), i, record.entry.tick, ~std::uint64_t{i}, {}};
      for (std::uint32_t p = 0; p < i; ++p)
        record.entry.capture.points.push_back({p << 20, 0.1F * p, 0.3F, 0.7F, 0.9F});
    }
    records.push_back(record);
  }
  return records;
}

TEST_F(JournalTest, AppendedRecordsAreReadBackAndCanBeContinued) {
  const std::vector<TallyRecord> records = some_records(9);
  Journal(file_).append(std::span(records).first(4));
  {
    Journal journal(file_);
    EXPECT_EQ(journal.replayed(), std::vector<TallyRecord>(records.begin(), records.begin() + 4));
    journal.append({});
    journal.append(std::span(records).subspan(4));
  }
  EXPECT_EQ(Journal(file_).replayed(), records);
}

TEST_F(JournalTest, AFileCutAtAnyByteReturnsAPrefixOfTheRecords) {
  const std::vector<TallyRecord> records = some_records(6);
  Journal(file_).append({});
  const std::size_t head = content().size();
  std::vector<std::size_t> ends = {head};
  for (const TallyRecord& record : records) {
    Journal(file_).append({&record, 1});
    ends.push_back(content().size());
  }
  const std::string whole = content();
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    set_content(whole.substr(0, size));
    std::size_t kept = 0;
    while (kept + 1 < ends.size() && ends[kept + 1] <= size) ++kept;
    {
      Journal journal(file_);
      ASSERT_EQ(journal.replayed(), std::vector<TallyRecord>(records.begin(), records.begin() + kept)) << size;
      ASSERT_EQ(content().size(), ends[kept]) << "the broken end is cut off";
      journal.append(std::span(records).subspan(kept));  // the run goes on from there
    }
    ASSERT_EQ(content(), whole) << size;
  }
}

TEST_F(JournalTest, AFlippedBitDiscardsItsRecordAndAllLaterOnes) {
  const std::vector<TallyRecord> records = some_records(4);
  Journal(file_).append(records);
  const std::string whole = content();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string broken = whole;
    broken[at] = static_cast<char>(broken[at] ^ 0x10);
    set_content(broken);
    const Journal journal(file_);
    ASSERT_LT(journal.replayed().size(), records.size()) << at;
    for (std::size_t i = 0; i < journal.replayed().size(); ++i) ASSERT_EQ(journal.replayed()[i], records[i]) << at;
    ASSERT_LT(content().size(), whole.size()) << at;
  }
}

TEST_F(JournalTest, TheJournalOfAnotherRunIsNotContinued) {
  const std::vector<TallyRecord> records = some_records(5);
  Journal(file_, RunId{7}).append(records);
  EXPECT_EQ(Journal(file_, RunId{7}).replayed(), records);
  {
    Journal journal(file_, RunId{8});
    EXPECT_TRUE(journal.replayed().empty());
    journal.append(std::span(records).first(2));
  }
  EXPECT_EQ(Journal(file_, RunId{8}).replayed().size(), 2U) << "the file is now the journal of the other run";
  EXPECT_TRUE(Journal(file_, RunId{7}).replayed().empty());
  set_content("no journal");
  Journal(file_, RunId{7}).append(records);
  EXPECT_EQ(Journal(file_, RunId{7}).replayed(), records) << "a file that is not a journal is replaced";
}

TEST_F(JournalTest, AppendedRecordsOutliveAKilledProcess) {
  const std::vector<TallyRecord> records = some_records(5);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Journal journal(file_);
    journal.append(records);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(Journal(file_).replayed(), records);
}

TEST_F(JournalTest, AFileThatCannotBeOpenedIsNamed) {
  const fs::path missing = folder_ / "missing" / "station.journal";
  try {
    const Journal journal(missing);
    FAIL() << "opened";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(missing.string()), std::string::npos);
  }
}

TEST_F(JournalTest, AWriteErrorIsReportedOnceAndEndsTheJournal) {
  const std::vector<TallyRecord> records = some_records(5);
  const pid_t child = ::fork();  // the limit must not touch this process
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{116, 116};  // room for the file's head, the first record and a part of the second
    ::setrlimit(RLIMIT_FSIZE, &limit);
    Journal journal(file_);
    const std::string trouble = journal.append(records), again = journal.append(records);
    ::_exit(trouble.find(file_) != std::string::npos && again.empty() ? 42 : 0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(Journal(file_).replayed(), std::vector<TallyRecord>(records.begin(), records.begin() + 1));
}

}  // namespace
}  // namespace skein::station

// docs/topics.md is correct: its tables list exactly the topics of the code's table, each with its type, its depth and
// its writer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/radio/radio_routes.hpp"
#include "core/topics.hpp"
#include "tests/support/places.hpp"

namespace skein {
namespace {

struct TopicRow {
  std::string topic, type, depth, writer, when;
};

std::vector<TopicRow> rows_of_page() {
  std::ifstream page(source_path("docs/topics.md"));
  std::vector<TopicRow> rows;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `/")) continue;
    std::vector<std::string> cells;
    std::istringstream text(line.substr(2));
    for (std::string cell; std::getline(text, cell, '|');) cells.push_back(cell.substr(cell.front() == ' ' ? 1 : 0));
    for (std::string& cell : cells) {
      cell.erase(cell.find_last_not_of(' ') + 1);
      if (cell.starts_with('`') && cell.find('`', 1) == cell.size() - 1) cell = cell.substr(1, cell.size() - 2);
    }
    EXPECT_EQ(cells.size(), 5u) << line;
    if (cells.size() == 5) rows.push_back({cells[0], cells[1], cells[2], cells[3], cells[4]});
  }
  return rows;
}

std::string with_id(std::string_view pattern, const std::string& id) {
  std::string name(pattern);
  if (const std::size_t at = name.find("{id}"); at != std::string::npos) name.replace(at, 4, id);
  return name;
}

/// The writer of a topic, if its direction implies it; otherwise empty.
std::string writer(topics::Direction direction) {
  switch (direction) {
    case topics::Direction::to_agent:
    case topics::Direction::to_viewer:
      return "sim_server";
    case topics::Direction::from_agent:
    case topics::Direction::shown_by_agent:
      return "the agent";
    case topics::Direction::from_station:
      return "station";
    case topics::Direction::internal:
      break;
  }
  return "";
}

TEST(TopicsPage, HasEveryTopicAndNoOther) {
  const std::vector<TopicRow> rows = rows_of_page();
  std::set<std::string> known;
  const auto expect_row = [&](const topics::TopicInfo& topic, const std::string& id) {
    const std::string name = with_id(topic.pattern, id);
    known.insert(name);
    std::size_t found = 0;
    for (const TopicRow& row : rows) {
      if (row.topic != name) continue;
      ++found;
      EXPECT_EQ(row.type, topic.type) << name;
      EXPECT_EQ(row.depth, std::to_string(topic.depth)) << name;
      EXPECT_EQ(row.when.find("latched") != std::string::npos, topic.latched) << name;
      EXPECT_FALSE(row.writer.empty()) << name;
      const std::string expected = writer(topic.direction);
      EXPECT_TRUE(expected.empty() || row.writer == expected) << name << ": " << row.writer;
    }
    EXPECT_GT(found, 0u) << name << " is missing";
  };
  for (const topics::TopicInfo& topic : topics::uav_topics()) expect_row(topic, "{id}");
  for (const topics::TopicInfo& topic : topics::gcs_topics()) expect_row(topic, "gcs");
  for (const topics::TopicInfo& topic : topics::viewer_topics()) expect_row(topic, "");
  for (const topics::TopicInfo& topic : topics::lockstep_topics()) expect_row(topic, "");
  const std::string captures = captures_topic("{id}"), acks = captures_ack_topic("{id}"), plan(kPlanTopic);
  for (const std::string& name : {captures, arrival_topic(captures, "gcs"), acks, arrival_topic(acks, "{id}"), plan,
                                  arrival_topic(plan, "{id}")}) {
    known.insert(name);
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const TopicRow& row) { return row.topic == name; })) << name;
  }
  for (const TopicRow& row : rows) EXPECT_TRUE(known.contains(row.topic)) << row.topic << " does not exist";
}

}  // namespace
}  // namespace skein

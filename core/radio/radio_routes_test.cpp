#include "core/radio/radio_routes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <utility>

#include "core/math/random_stream.hpp"
#include "core/scenario/scenario_reader.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace skein {
namespace {

Scenario three_uavs() {
  Scenario scenario;
  scenario.file = "towers.yaml";
  for (const char* name : {"jurong", "raffles", "sentosa"}) {
    UavConfig uav;
    uav.name = name;
    scenario.fleet.push_back(uav);
  }
  return scenario;
}

std::vector<RadioRoute> routes_of(const Scenario& scenario, const std::string& topic) {
  std::vector<RadioRoute> routes = radio_routes(scenario);
  std::erase_if(routes, [&](const RadioRoute& route) { return route.ros_topic != topic; });
  return routes;
}

std::vector<std::string> arrivals(const RadioRoute& route) {
  std::vector<std::string> names;
  for (const RadioTarget& target : route.targets) names.push_back(target.topic);
  return names;
}

/// The error message when `declared` is added to the scenario; empty if there is no error.
std::string routes_complaint(const std::vector<RadioTopicConfig>& declared) {
  Scenario scenario = three_uavs();
  scenario.radio = declared;
  try {
    radio_routes(scenario);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(RadioRoutes, CapturesAndAcknowledgementsAreAlwaysThere) {
  const std::vector<RadioRoute> routes = radio_routes(three_uavs());
  ASSERT_EQ(routes.size(), 10U) << "these and the routes of /plan";
  for (const UavIndex uav : FirstUavs(3)) {
    const RadioRoute& report = routes[2 * uav];
    const RadioRoute& ack = routes[2 * uav + 1];
    EXPECT_EQ(report.source, node_of_uav(uav));
    ASSERT_EQ(report.targets.size(), 1U);
    EXPECT_EQ(report.targets[0].node, kStationNode);
    EXPECT_EQ(ack.source, kStationNode);
    ASSERT_EQ(ack.targets.size(), 1U);
    EXPECT_EQ(ack.targets[0].node, node_of_uav(uav));
  }
  EXPECT_EQ(routes[0].topic, topics::captures("jurong").name);
  EXPECT_EQ(routes[0].type, "skein_msgs::msg::dds_::CaptureReports_");
  EXPECT_EQ(routes[0].targets[0].topic, topics::captures_at_station("jurong").name);
  EXPECT_EQ(routes[0].targets[0].topic, "rt/captures/jurong/gcs");
  EXPECT_EQ(routes[1].topic, topics::captures_ack("jurong").name);
  EXPECT_EQ(routes[1].targets[0].topic, topics::captures_ack_at_uav("jurong").name);
}

TEST(RadioRoutes, AllNodesCanSendPlansUnlessTheScenarioDeclaresThePlanTopic) {
  EXPECT_EQ(routes_of(three_uavs(), "/plan").size(), 4U) << "all to all";
  EXPECT_EQ(routes_of(Scenario(), "/plan").size(), 0U) << "without UAVs, nobody can talk";
  Scenario restricted = three_uavs();
  restricted.radio = {{"/plan", "std_msgs/msg/String", {"jurong"}, {"sentosa"}}};
  EXPECT_EQ(routes_of(restricted, "/plan").size(), 1U);
}

TEST(RadioRoutes, AllMeansEveryOtherNode) {
  Scenario scenario = three_uavs();
  scenario.radio = {{"/broadcast", "std_msgs/msg/String", {"all"}, {"all"}}};
  const std::vector<RadioRoute> routes = routes_of(scenario, "/broadcast");
  ASSERT_EQ(routes.size(), 4U);
  for (const Node source : FirstNodes(4)) {
    EXPECT_EQ(routes[source].source, source);
    EXPECT_EQ(routes[source].topic, "rt/broadcast");
    EXPECT_EQ(routes[source].type, "std_msgs::msg::dds_::String_");
    EXPECT_EQ(routes[source].targets.size(), 3U);
    EXPECT_TRUE(
        std::ranges::none_of(routes[source].targets, [&](const RadioTarget& target) { return target.node == source; }));
  }
  EXPECT_EQ(arrivals(routes[2]),
            (std::vector<std::string>{"rt/broadcast/gcs", "rt/broadcast/jurong", "rt/broadcast/sentosa"}));
}

TEST(RadioRoutes, AllSourcesDoesNotIncludeTheOnlyTarget) {
  Scenario scenario = three_uavs();
  scenario.radio = {{"/status", "std_msgs/msg/String", {"all"}, {"gcs"}}};
  const std::vector<RadioRoute> routes = routes_of(scenario, "/status");
  ASSERT_EQ(routes.size(), 3U);
  EXPECT_EQ(routes[0].source, node_of_uav(UavIndex{0}));
}

TEST(RadioRoutes, ATopicMayHaveDifferentTargetsForEachSource) {
  Scenario scenario = three_uavs();
  scenario.radio = {{"/x", "std_msgs/msg/String", {"jurong"}, {"gcs"}},
                    {"/x", "std_msgs/msg/String", {"sentosa", "raffles"}, {"gcs", "jurong"}}};
  EXPECT_EQ(routes_of(scenario, "/x").size(), 3U);
}

TEST(RadioRoutes, TheScoreNeverGoesOnTheRadio) {
  const std::string cloud = "sensor_msgs/msg/PointCloud";
  const Scenario scenario = three_uavs();
  RadioTable table(scenario);
  for (const std::string name : {"/gcs/score", "/score_eval"}) {
    for (const char* source : {"gcs", "jurong"}) {
      const std::string said = routes_complaint({{name, cloud, {source}, {"all"}}});
      EXPECT_NE(said.find("radio.topics[0].name: '" + name + "' is the station's own"), std::string::npos) << said;
    }
    for (const Node node : FirstNodes(scenario.fleet.size() + 1)) {
      EXPECT_THROW(table.open(node, name, cloud, {"all"}), InputError) << name << " from node " << node;
      EXPECT_THROW(table.arrival(node, name, cloud), InputError) << name << " at node " << node;
    }
  }
  EXPECT_EQ(routes_complaint({{"/score", cloud, {"gcs"}, {"all"}}}), "")
      << "without the station's prefix the name is free";
}

TEST(RadioRoutes, ATopicThatWouldArriveUnderTheNameOfTheScoreIsRefused) {
  Scenario scenario = three_uavs();
  scenario.fleet[0].name = "score";  // "/gcs" arrives there as "/gcs/score"
  scenario.radio = {{"/gcs", "sensor_msgs/msg/PointCloud", {"gcs"}, {"score"}}};
  EXPECT_THROW(radio_routes(scenario), InputError);
}

struct BadDeclaration {
  const char* what;
  std::vector<RadioTopicConfig> declared;
  const char* key;   ///< that the message must name
  const char* hint;  ///< that it must contain
};

class BadRadioTopics : public testing::TestWithParam<BadDeclaration> {};

TEST_P(BadRadioTopics, AreRefusedWithFileAndKey) {
  const std::string message = routes_complaint(GetParam().declared);
  EXPECT_TRUE(message.starts_with("towers.yaml: ")) << message;
  EXPECT_NE(message.find(GetParam().key), std::string::npos) << message;
  EXPECT_NE(message.find(GetParam().hint), std::string::npos) << message;
}

const std::string kString = "std_msgs/msg/String";

INSTANTIATE_TEST_SUITE_P(
    All, BadRadioTopics,
    testing::Values(
        BadDeclaration{"RelativeName", {{"x", kString, {"all"}, {"all"}}}, "radio.topics[0].name", "/broadcast"},
        BadDeclaration{"Ros1Type", {{"/x", "std_msgs/String", {"all"}, {"all"}}}, "radio.topics[0].type", "/msg/"},
        BadDeclaration{"UnknownNode", {{"/x", kString, {"changi"}, {"all"}}}, ".sources", "jurong, raffles, sentosa"},
        BadDeclaration{"NoTarget", {{"/x", kString, {"all"}, {}}}, ".targets", "empty"},
        BadDeclaration{"Repeated", {{"/x", kString, {"all"}, {"gcs", "gcs"}}}, ".targets", "twice"},
        BadDeclaration{"AllAndMore", {{"/x", kString, {"all", "gcs"}, {"gcs"}}}, ".sources", "stands alone"},
        BadDeclaration{"OnlyItself", {{"/x", kString, {"gcs"}, {"gcs"}}}, ".targets", "besides itself"},
        BadDeclaration{"SourceTwice",
                       {{"/x", kString, {"jurong"}, {"gcs"}}, {"/x", kString, {"all"}, {"all"}}},
                       "radio.topics[1].sources",
                       "before"},
        BadDeclaration{"TwoTypes",
                       {{"/x", kString, {"jurong"}, {"gcs"}}, {"/x", "std_msgs/msg/Bool", {"raffles"}, {"gcs"}}},
                       "radio.topics[1].type",
                       "one type"},
        BadDeclaration{"SensorTopic",
                       {{"/jurong/gimbal", "geometry_msgs/msg/TwistStamped", {"jurong"}, {"all"}}},
                       ".name",
                       "Skein writes"},
        BadDeclaration{"ScoreOfAnotherType", {{"/gcs/score", kString, {"gcs"}, {"all"}}}, ".name", "never goes"},
        BadDeclaration{"LockStepName", {{"/skein/step2", kString, {"all"}, {"all"}}}, ".name", "Skein's own"},
        BadDeclaration{"CaptureTopic",
                       {{"/captures/jurong", "skein_msgs/msg/CaptureReports", {"jurong"}, {"gcs"}}},
                       ".sources",
                       "before"},
        BadDeclaration{"ArrivalIsSent",
                       {{"/x/jurong", kString, {"jurong"}, {"gcs"}}, {"/x", kString, {"gcs"}, {"jurong"}}},
                       "radio.topics[1].name",
                       "sends"},
        BadDeclaration{"SentIsArrival",
                       {{"/x", kString, {"gcs"}, {"jurong"}}, {"/x/jurong", kString, {"jurong"}, {"gcs"}}},
                       "radio.topics[1].name",
                       "arrives"}),
    [](const auto& test) { return std::string(test.param.what); });

// ---- registered while the run lasts ------------------------------------------------------------------------------

std::string refusal(RadioTable& table, Node source, const std::string& name, const std::string& type,
                    const std::vector<std::string>& targets) {
  try {
    table.open(source, name, type, targets);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(RadioTable, GrowsWithoutChangingNumbers) {
  const Scenario scenario = three_uavs();
  RadioTable table(scenario);
  const std::size_t declared = table.routes().size();
  EXPECT_EQ(table.open(Node{1}, "/note", "some/msg/Note", {"sentosa"}), declared);
  EXPECT_EQ(table.open(Node{2}, "/note", "some/msg/Note", {"all"}), declared + 1);
  EXPECT_EQ(table.open(Node{1}, "/note", "some/msg/Note", {"gcs", "sentosa"}), declared)
      << "more targets, the same route";
  EXPECT_EQ(arrivals(table.routes()[declared]), (std::vector<std::string>{"rt/note/sentosa", "rt/note/gcs"}));
  EXPECT_EQ(arrivals(table.routes()[declared + 1]),
            (std::vector<std::string>{"rt/note/gcs", "rt/note/jurong", "rt/note/sentosa"}));
  EXPECT_EQ(table.arrival(Node{2}, "/note", "some/msg/Note").topic, "rt/note/raffles");
}

TEST(RadioTable, RefusalsSayWhyAndChangeNothing) {
  const Scenario scenario = three_uavs();
  RadioTable table(scenario);
  table.open(Node{1}, "/note", "some/msg/Note", {"sentosa"});
  const std::size_t before = table.routes().size();
  const struct {
    std::string name, type;
    std::vector<std::string> targets;
    std::string reason;
  } wrong[] = {{"note", "some/msg/Note", {"all"}, "name: 'note' is not an absolute topic name"},
               {"/note2", "Note", {"all"}, "type: 'Note' is not a message type"},
               {"/note", "some/msg/Other", {"all"}, "type: '/note' was declared as some/msg/Note"},
               {"/note2", "some/msg/Note", {"jurong"}, "targets: 'jurong' is the source itself"},
               {"/note2", "some/msg/Note", {"sentosa", "sentosa"}, "targets: names 'sentosa' twice"},
               {"/note2", "some/msg/Note", {"sentosa", "nobody"}, "there is no node 'nobody'"},
               {"/note2", "some/msg/Note", {}, "targets: is empty"},
               {"/skein/note", "some/msg/Note", {"all"}, "Skein's own"},
               {"/captures/jurong2", "some/msg/Note", {"all"}, "carry the score"},
               {"/clock", "some/msg/Note", {"all"}, "is taken by a topic that Skein writes"},
               {"/" + std::string(240, 'x'), "some/msg/Note", {"sentosa"}, ""},
               {"/" + std::string(246, 'x'), "some/msg/Note", {"sentosa"}, "name: '/xxx"},
               {"/" + std::string(1 << 20, 'x'), "some/msg/Note", {"sentosa"}, "name: '/xxx"},
               {"/note2", "some/msg/" + std::string(255, 'x'), {"all"}, "type: 'some/msg/xxx"},
               {"/jurong", "some/msg/Note", {"all"}, ""}};
  for (const auto& w : wrong) {
    const std::string said = refusal(table, Node{1}, w.name, w.type, w.targets);
    EXPECT_NE(said.find(w.reason), std::string::npos) << w.name << ": " << said;
    EXPECT_EQ(said.empty(), w.reason.empty()) << said;
  }
  EXPECT_EQ(table.routes().size(), before + 2) << "the table has only the valid routes";
  EXPECT_THROW(table.arrival(Node{1}, "/note", "some/msg/Other"), InputError);
  EXPECT_NO_THROW(table.arrival(Node{1}, "/not_yet", "some/msg/Other"));
}

TEST(RadioTable, ARouteThatIsClosedFreesItsNamesAndType) {
  const Scenario scenario = three_uavs();
  RadioTable table(scenario);
  const std::size_t note = table.open(Node{1}, "/note", "some/msg/Note", {"sentosa", "gcs"});
  EXPECT_NE(refusal(table, Node{3}, "/note/sentosa", "some/msg/Note", {"gcs"}), "")
      << "a message that arrives has this name";
  table.close(note);
  EXPECT_TRUE(table.routes()[note].targets.empty());
  EXPECT_EQ(refusal(table, Node{3}, "/note/sentosa", "some/msg/Note", {"gcs"}), "");
  EXPECT_NO_THROW(table.arrival(Node{2}, "/note", "some/msg/Other"));
  EXPECT_EQ(table.open(Node{1}, "/note", "some/msg/Other", {"raffles"}), note) << "the route keeps its number";
  EXPECT_EQ(table.routes()[note].type, "some::msg::dds_::Other_");
  EXPECT_EQ(arrivals(table.routes()[note]), std::vector<std::string>{"rt/note/raffles"});
}

TEST(RadioTable, ClosingARouteKeepsTheTypeAndNameThatOtherRoutesUse) {
  const Scenario scenario = three_uavs();
  RadioTable table(scenario);
  const std::size_t closed = table.open(Node{1}, "/note", "some/msg/Note", {"sentosa", "gcs"});
  table.open(Node{2}, "/note", "some/msg/Note", {"sentosa"});
  table.close(closed);
  EXPECT_NE(refusal(table, Node{1}, "/note", "some/msg/Other", {"gcs"}), "") << "the topic has its type";
  EXPECT_NE(refusal(table, Node{3}, "/note/sentosa", "some/msg/Note", {"gcs"}), "") << "the name is in use";
  EXPECT_EQ(refusal(table, Node{0}, "/note/gcs", "some/msg/Note", {"jurong"}), "") << "this one is not";
  const std::string own = "/jurong/command/trigger";
  table.close(table.open(Node{1}, own, "skein_msgs/msg/BoolStamped", {"gcs"}));
  EXPECT_NE(refusal(table, Node{1}, own, "some/msg/Note", {"gcs"}).find("standard topic"), std::string::npos);
}

/// The topics of one node in all routes: ROS topics that it sends, and DDS topics that arrive there.
std::pair<std::set<std::string>, std::set<std::string>> topics_in_routes(const Scenario& scenario, Node node) {
  std::set<std::string> sent, arriving;
  for (const RadioRoute& route : radio_routes(scenario)) {
    if (route.source == node) sent.insert(route.ros_topic + " " + route.topic + " " + route.type);
    for (const RadioTarget& target : route.targets) {
      if (target.node == node) arriving.insert(route.ros_topic + " " + target.topic + " " + route.type);
    }
  }
  return {sent, arriving};
}

TEST(RadioRoutes, TheTopicsOfANodeAreThoseOfItsRoutes) {
  RandomStream draw(11, "node_topics", 0);
  const auto drawn_nodes = [&](const Scenario& scenario) {
    std::vector<std::string> nodes;
    for (const Node node : scenario.nodes()) {
      if (draw.uniform() < 0.5) nodes.push_back(scenario.node_name(node));
    }
    return nodes.empty() || draw.uniform() < 0.3 ? std::vector<std::string>{"all"} : nodes;
  };
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    Scenario scenario = three_uavs();
    scenario.fleet.resize(1 + static_cast<std::size_t>(draw.uniform() * 3.0));
    for (const char* name : {"/a", "/b", "/plan"}) {
      if (draw.uniform() < 0.4) continue;
      const char* type = draw.uniform() < 0.5 ? "std_msgs/msg/String" : "nav_msgs/msg/Path";
      scenario.radio.push_back({name, type, drawn_nodes(scenario), drawn_nodes(scenario)});
    }
    try {
      radio_routes(scenario);
    } catch (const InputError&) {
      continue;
    }
    for (const Node node : scenario.nodes()) {
      const NodeTopics topics = node_topics(scenario, node);
      std::set<std::string> sent, arriving;
      for (const NodeTopic& t : topics.sent) sent.insert(t.ros_topic + " " + t.topic + " " + t.type);
      for (const NodeTopic& t : topics.arriving) arriving.insert(t.ros_topic + " " + t.topic + " " + t.type);
      EXPECT_EQ(std::pair(sent, arriving), topics_in_routes(scenario, node));
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(RadioRoutes, ABrokenRuleIsNamedWithTheLineOfTheScenario) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "talkers.yaml";
  const std::string topic = "    - {name: /x, type: std_msgs/msg/String, sources: [a], targets: [gcs]}\n";
  std::ofstream(file) << "desired_mm_per_pixel: 2\nscene: {family: towers}\nfleet: [{name: a, vehicle: explorer}]\n"
                      << "radio:\n  topics:\n"
                      << topic << topic;
  try {
    load_scenario(file, {.config_dir = source_path("config")});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), file.string() + ":7: radio.topics[1].sources: 'a' was declared as a source of /x before");
  }
}

}  // namespace
}  // namespace skein

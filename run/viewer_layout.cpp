#include "run/viewer_layout.hpp"

#include "core/topics.hpp"

namespace skein::cli {
namespace {

Json path(const std::string& value, const std::string& label) {
  return {{"value", value}, {"enabled", true}, {"timestampMethod", "receiveTime"}, {"label", label}};
}

Json plot(const std::string& title, const std::string& y, Json paths) {
  return {{"title", title},
          {"foxglovePanelTitle", title},
          {"paths", std::move(paths)},
          {"yAxisLabel", y},
          {"isSynced", true},
          {"xAxisVal", "timestamp"},
          {"showLegend", true},
          {"legendDisplay", "floating"},
          {"showXAxisLabels", true},
          {"showYAxisLabels", true}};
}

Json scene() {
  Json topics = Json::object();
  for (const topics::TopicInfo& topic : topics::viewer_topics()) {
    if (topic.pattern.starts_with("/viz/")) topics[std::string(topic.pattern)] = {{"visible", true}};
  }
  return {{"followMode", "follow-none"},
          {"fixedFrame", "world"},
          {"topics", topics},
          {"scene", {{"transforms", {{"axisScale", 2.0}}}}}};
}

}  // namespace

Json viewer_layout(const Scenario& scenario) {
  Json speeds = Json::array();
  for (const std::string& uav : scenario.uav_names()) {
    speeds.push_back(path("/" + uav + "/ground_truth/odometry.twist.twist.linear.@norm", uav));
  }
  const Json scores = {path("/skein/tally.score", "delivered"), path("/skein/tally.earned", "earned")};
  const Json panels = {{"3D!fleet", scene()},
                       {"Plot!score", plot("Score", "score [1]", scores)},
                       {"Plot!speed", plot("Speed", "speed [m/s]", speeds)},
                       {"RawMessages!events", {{"topicPath", "/skein/events"}, {"expansion", "all"}}}};
  const Json column = {{"direction", "column"},
                       {"first", "Plot!score"},
                       {"second", {{"direction", "column"}, {"first", "Plot!speed"}, {"second", "RawMessages!events"}}},
                       {"splitPercentage", 35}};
  return {{"configById", panels},
          {"globalVariables", Json::object()},
          {"userNodes", Json::object()},
          {"playbackConfig", {{"speed", 4}}},
          {"layout", {{"direction", "row"}, {"first", "3D!fleet"}, {"second", column}, {"splitPercentage", 65}}}};
}

}  // namespace skein::cli

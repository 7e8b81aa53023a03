// Effects of a directed radio link on the messages that it carries. By default a link is ideal: no message is lost,
// delayed, duplicated or reordered. Permanent effects are in a scenario (`radio.links`), temporary ones in a fault
// file. Times are simulated. The router delivers messages once per exchange, so delays are rounded up to whole
// exchanges.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config_reader.hpp"
#include "core/topics.hpp"

namespace skein {

/// Bursts of loss (Gilbert and Elliott): the link changes between a good and a bad state at random.
struct BurstLoss {
  double mean_good_s = 10.0, mean_burst_s = 1.0;  ///< mean duration of the good and of the bad state
  double loss = 1.0;                              ///< loss probability of a message sent in the bad state, [0, 1]

  void describe(auto& r) {
    r.required("mean_good_s", mean_good_s, within(0.05, 36000.0));
    r.required("mean_burst_s", mean_burst_s, within(0.05, 36000.0));
    r.field("loss", loss, within(0.0, 1.0));
  }
};

/// Some messages, chosen at random, are delayed, so that later messages overtake them.
struct Reordering {
  double probability = 0.0, delay_s = 0.0;

  void describe(auto& r) {
    r.required("probability", probability, within(0.0, 1.0));
    r.required("delay_s", delay_s, Bounds{0.0, 60.0, true});
  }
};

/// One stage of a link. Several stages on one link act one after the other, in the order in which they are given.
struct LinkEffect {
  std::vector<std::string> from = {"all"}, to = {"all"};  ///< node names, {"all"} or {"uavs"}: see names_node()
  std::optional<double> range_m;                          ///< beyond this distance there is no link
  double latency_s = 0.0, jitter_s = 0.0;  ///< latency + uniform draw from [0, jitter], on top of the usual exchange
  std::optional<double> bandwidth_bit_s;   ///< data rate; messages that exceed it wait in a queue
  std::int64_t queue_bytes = 65536;        ///< capacity of that queue; messages that do not fit are dropped
  double loss = 0.0;                       ///< loss probability of each message, independently, [0, 1]
  std::optional<BurstLoss> burst_loss;
  double duplication = 0.0;  ///< probability that a message arrives twice
  std::optional<Reordering> reordering;
  double corruption = 0.0;                    ///< probability that some bits of a message are flipped
  std::vector<std::string> topics = {"all"};  ///< topics to which the effect applies, or {"all"}; see names_topic()

  void describe(auto& r) {
    describe_names(r, "from", from);
    describe_names(r, "to", to);
    r.field("range_m", range_m, Bounds{0.0, 1e6, true});
    r.field("latency_s", latency_s, within(0.0, 60.0));
    r.field("jitter_s", jitter_s, within(0.0, 60.0));
    r.field("bandwidth_bit_s", bandwidth_bit_s, Bounds{0.0, 1e12, true});
    r.field("queue_bytes", queue_bytes, within(0.0, 1e12));
    r.field("loss", loss, within(0.0, 1.0));
    r.field("burst_loss", burst_loss);
    r.field("duplication", duplication, within(0.0, 1.0));
    r.field("reordering", reordering);
    r.field("corruption", corruption, within(0.0, 1.0));
    describe_names(r, "topics", topics);
    for (const std::string& topic : topics) {
      r.check(topic == "all" || is_topic_name(topic), "topics",
              "'" + topic + "' is not a topic; write it like '/plan': after each '/' letters, digits and '_'");
    }
    r.check(!topics.empty(), "topics", "must name at least one topic, or be the word all");
    r.check(names_every_topic() || !range_m, "topics", "cannot stand beside range_m, which is of the link as a whole");
  }

  /// Whether messages on the link can differ from those on an ideal link. If not, the effect limits the range only.
  bool acts_on_messages() const {
    const bool bursts = burst_loss && burst_loss->loss > 0.0;
    const bool reorders = reordering && reordering->probability > 0.0;
    const bool loses = loss > 0.0 || bursts || corruption > 0.0;
    const bool delays = latency_s > 0.0 || jitter_s > 0.0 || bandwidth_bit_s || reorders;
    return loses || delays || duplication > 0.0;
  }
  bool names_every_topic() const { return std::find(topics.begin(), topics.end(), "all") != topics.end(); }

  /// A list of names, or the single word `all`; `all` when the key is absent.
  static void describe_names(auto& r, const std::string& key, std::vector<std::string>& list) {
    std::variant<std::string, std::vector<std::string>> names = list;
    if (list.size() == 1) names = list[0];
    r.field(key, names);
    list = names.index() == 0 ? std::vector<std::string>{std::get<0>(names)} : std::get<1>(names);
  }
};

/// Whether a list of node names contains this node, or "all", or "uavs" and the node is no ground station.
inline bool names_node(const std::vector<std::string>& nodes, const std::string& node) {
  for (const std::string& name : nodes) {
    if (name == "all" || name == node || (name == "uavs" && node != "gcs")) return true;
  }
  return false;
}

/// Whether a list of topics covers this one: "all" covers every topic, and `/captures` also covers `/captures/jurong`.
inline bool names_topic(const std::vector<std::string>& topics, const std::string& ros_topic) {
  const auto means = [&](const std::string& name) {
    return name == "all" ||
           (ros_topic.starts_with(name) && (ros_topic.size() == name.size() || ros_topic[name.size()] == '/'));
  };
  return std::any_of(topics.begin(), topics.end(), means);
}

}  // namespace skein

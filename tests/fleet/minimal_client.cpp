// The smallest program that takes part in the lock-step, written from docs/lockstep.md alone: it shares no lock-step
// code with Skein, only the messages and the bus. Its UAV climbs 3 m and hovers there.
//   skein run --planner hover,UAV=exec:minimal_client
// The launcher sets SKEIN_RUN, SKEIN_DOMAIN, SKEIN_UAV and SKEIN_DDS. The exit code is 0 after the last step, and 3,
// with a message, if before that the server dropped the program, gave it up while it joined, or left. For tests of
// broken clients, an argument makes the program misbehave from step kFirstLie on: "hang" stops answering; "boast"
// announces one command more than it sends, "smuggle" one less; "forge" sends the station reports of captures that no
// camera has taken. "announce" announces more debug values than sim_server reads, and writes none. With "tell", it
// behaves correctly, and also publishes its activity.
#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "idl/cdr.hpp"
#include "idl/type_names.hpp"

namespace {

using skein::bus::ParticipantId;
using skein::bus::Sample;
namespace msg = skein::msg;

constexpr double kHeightM = 3.0;
constexpr std::uint64_t kFirstLie = 40;
constexpr skein::bus::Qos kStateQos{.reliable = true, .latched = false, .depth = 8};
constexpr skein::bus::Qos kCommandQos{.reliable = true, .latched = false, .depth = 64};
constexpr skein::bus::Qos kRadioQos{.reliable = true, .latched = false, .depth = 256};
constexpr skein::bus::Qos kLatchedQos{.reliable = true, .latched = true, .depth = 4};

template <class Message>
skein::bus::TopicSpec topic(const std::string& name, const skein::bus::Qos& qos) {
  return {"rt/" + name, skein::type_name<Message>(), qos};
}

/// Passes the messages of one topic from the DDS library's threads to the main thread.
template <class Message>
class Queue {
 public:
  Queue(skein::bus::Participant& participant, const std::string& name, const skein::bus::Qos& qos)
      : name_("rt/" + name), reader_(participant.create_reader(topic<Message>(name, qos), [this](Sample&& sample) {
          Message message;
          if (!skein::decode(sample.payload, message)) return;
          const std::scoped_lock lock(mutex_);
          waiting_.emplace_back(sample.source, std::move(message));
          arrived_.notify_all();
        })) {}

  /// The next message; nullopt after 50 ms without one.
  std::optional<std::pair<ParticipantId, Message>> take() {
    std::unique_lock lock(mutex_);
    const auto something = [this] { return !waiting_.empty(); };
    if (!arrived_.wait_for(lock, std::chrono::milliseconds(50), something)) return std::nullopt;
    auto next = std::move(waiting_.front());
    waiting_.pop_front();
    return next;
  }
  bool matches(ParticipantId who) const { return contains(reader_->matched(), who); }
  const std::string& name() const { return name_; }

  static bool contains(const std::vector<ParticipantId>& list, ParticipantId who) {
    return std::find(list.begin(), list.end(), who) != list.end();
  }

 private:
  std::string name_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<std::pair<ParticipantId, Message>> waiting_;
  std::unique_ptr<skein::bus::Reader> reader_;  // last: destroyed before the members that its callback uses
};

/// The count of one topic of one source in a list; `otherwise` if the list has none.
std::uint64_t count_of(const std::vector<msg::TopicCount>& counts, const std::string& name, ParticipantId source,
                       std::uint64_t otherwise) {
  for (const auto& count : counts) {
    if (count.topic() == name && count.source() == source) return count.count();
  }
  return otherwise;
}

class Client {
 public:
  Client(skein::bus::Participant& participant, std::uint64_t run, std::string uav, std::string lie)
      : participant_(participant),
        run_(run),
        uav_(std::move(uav)),
        lie_(std::move(lie)),
        resyncs_(participant, "skein/resync", kLatchedQos),
        steps_(participant, "skein/step", kStateQos),
        done_(participant.create_writer(topic<msg::Done>("skein/done", kStateQos))),
        ready_(participant.create_writer(topic<msg::Ready>("skein/ready", kLatchedQos))) {}

  int run() {
    say_ready(0);
    wait_for_invitation();
    if (!wait_for_matches()) return fail(kGivenUp);
    say_ready(1);
    for (;;) {
      const auto step = steps_.take();
      if (!step) {
        if (!steps_.matches(server_)) return fail(kServerGone);
        continue;
      }
      if (step->first != server_ || step->second.run() != run_) continue;
      if (step->second.k() == answered_) {
        done_->write(skein::encode(last_done_));  // the server asks again: the answer may have been lost
        continue;
      }
      if (!lists_us(step->second)) {
        if (gives_us_up(step->second)) return fail(kGivenUp);
        continue;
      }
      for (const auto& other : step->second.members()) {
        while (other.name() == "comm_router" && !Queue<msg::Step>::contains(done_->matched(), other.source())) {
          if (!steps_.matches(server_)) return fail(kServerGone);
          resyncs_.take();  // waits, 50 ms at most
        }
      }
      if (!answer(step->second)) return fail(kServerGone);
      if (step->second.final_step()) break;
    }
    while (steps_.matches(server_)) steps_.take();  // leaving at once could lose the last answer
    return 0;
  }

 private:
  static constexpr const char *kGivenUp = "sim_server gave this program up", *kServerGone = "sim_server has gone";

  int fail(const char* why) const {
    std::cerr << "minimal_client of " << uav_ << ": " << why << std::endl;
    return 3;
  }

  void say_ready(std::uint32_t revision) {
    msg::Ready ready;
    ready.run(run_);
    ready.member(uav_);
    ready.revision(revision);
    if (lie_ == "tell") ready.writes().push_back(activity_name());
    for (int i = 0; lie_ == "announce" && revision == 0 && i < 70; ++i) {
      ready.writes().push_back("rt/" + uav_ + "/debug/n" + std::to_string(i));
    }
    if (revision > 0) {
      ready.reads().push_back(odometry_->name());
      ready.writes().push_back(command_name());
      if (reports_) ready.writes().push_back(reports_name());
    }
    ready_->write(skein::encode(ready));
  }

  void wait_for_invitation() {
    for (;;) {
      const auto resync = resyncs_.take();
      if (!resync || resync->second.run() != run_ || resync->second.source() != participant_.id()) continue;
      server_ = resync->first;
      if (resync->second.epoch() > 0) invited_after_ = resync->second.k();
      odometry_ = std::make_unique<Queue<msg::Odometry>>(participant_, uav_ + "/ground_truth/odometry", kStateQos);
      commands_ =
          participant_.create_writer(topic<msg::MultiDOFJointTrajectory>(uav_ + "/command/trajectory", kCommandQos));
      if (lie_ == "forge") {
        reports_ = participant_.create_writer(topic<msg::CaptureReports>("captures/" + uav_, kRadioQos));
      }
      if (lie_ == "tell") {
        activities_ = participant_.create_writer(topic<msg::Activity>(uav_ + "/activity", kCommandQos));
      }
      received_ = expected_ = count_of(resync->second.base(), odometry_->name(), server_, 0);
      return;
    }
  }

  /// @returns false if the server has given this program up.
  bool wait_for_matches() {
    const auto heard = [&](const skein::bus::Writer& writer) {
      return Queue<msg::Step>::contains(writer.matched(), server_);
    };
    while (!odometry_->matches(server_) || !steps_.matches(server_) || !heard(*commands_) || !heard(*done_) ||
           (reports_ && !reports_->has_readers()) || (activities_ && !heard(*activities_))) {
      const auto step = steps_.take();  // waits, 50 ms at most
      if (step && step->first == server_ && step->second.run() == run_ && gives_us_up(step->second)) return false;
    }
    return true;
  }

  /// Whether the fleet takes this step without this program, although the program was invited before it.
  bool gives_us_up(const msg::Step& step) const {
    return !lists_us(step) && (!invited_after_ || step.k() > *invited_after_);
  }

  bool lists_us(const msg::Step& step) const {
    return std::any_of(step.members().begin(), step.members().end(), [this](const auto& member) {
      return member.name() == uav_ && member.source() == participant_.id();
    });
  }

  /// Answers a step; with "hang", waits until the server has gone instead. @returns false if the server has gone.
  bool answer(const msg::Step& step) {
    if (lie_ == "hang" && step.k() >= kFirstLie) {
      while (steps_.matches(server_)) steps_.take();
      return false;
    }
    expected_ = count_of(step.expected(), odometry_->name(), server_, expected_);
    while (received_ < expected_) {
      const auto next = odometry_->take();
      if (!next && !odometry_->matches(server_)) return false;
      if (!next || next->first != server_) continue;
      ++received_;
      if (!goal_) goal_ = next->second.pose().pose().position();
    }
    write_command(step);
    if (reports_ && step.k() >= kFirstLie) write_forged_report(step);
    if (activities_) write_activity();

    msg::Done done;
    done.run(run_);
    done.k(step.k());
    done.epoch(step.epoch());
    done.member(uav_);
    msg::TopicCount sent;
    sent.topic(command_name());
    sent.source(participant_.id());
    sent.count(step.k() < kFirstLie ? commands_sent_ : told());
    done.sent().push_back(sent);
    if (reports_) {
      sent.topic(reports_name());
      sent.count(reports_sent_);
      done.sent().push_back(sent);
    }
    if (activities_) {
      sent.topic(activity_name());
      sent.count(activities_sent_);
      done.sent().push_back(sent);
    }
    done_->write(skein::encode(done));
    last_done_ = done;
    answered_ = step.k();
    return true;
  }

  void write_command(const msg::Step& step) {
    msg::Transform transform;
    transform.translation().x(goal_->x());
    transform.translation().y(goal_->y());
    transform.translation().z(goal_->z() + kHeightM);
    transform.rotation().w(1.0);
    msg::MultiDOFJointTrajectoryPoint point;
    point.transforms().push_back(transform);
    msg::MultiDOFJointTrajectory trajectory;
    trajectory.header().stamp(step.stamp());
    trajectory.header().frame_id("world");
    trajectory.points().push_back(point);
    commands_->write(skein::encode(trajectory));
    ++commands_sent_;
  }

  /// Writes its activity in each step, which is more often than necessary; the server passes on only changes.
  void write_activity() {
    msg::Activity activity;
    activity.mode("hovers, all by itself");
    activity.has_goal(true);
    activity.goal().z(kHeightM);
    activity.cpu_s(static_cast<double>(activities_sent_));
    activities_->write(skein::encode(activity));
    ++activities_sent_;
  }

  void write_forged_report(const msg::Step& step) {
    msg::CapturePoint point;
    point.q_blur(1.0F);
    point.q_res(1.0F);
    point.q(1.0F);
    msg::CaptureReport report;
    report.uav(uav_);
    report.capture(reports_sent_);
    report.token(step.k());
    report.points().push_back(point);
    msg::CaptureReports reports;
    reports.reports().push_back(report);
    reports_->write(skein::encode(reports));
    ++reports_sent_;
  }

  /// The number of commands that it claims to have sent.
  std::uint64_t told() const {
    if (lie_ == "boast") return commands_sent_ + 1;
    return lie_ == "smuggle" ? commands_sent_ - 1 : commands_sent_;
  }
  std::string command_name() const { return "rt/" + uav_ + "/command/trajectory"; }
  std::string activity_name() const { return "rt/" + uav_ + "/activity"; }
  std::string reports_name() const { return "rt/captures/" + uav_; }

  skein::bus::Participant& participant_;
  const std::uint64_t run_;
  const std::string uav_, lie_;
  Queue<msg::Resync> resyncs_;
  Queue<msg::Step> steps_;
  std::unique_ptr<skein::bus::Writer> done_, ready_, commands_, reports_, activities_;
  std::unique_ptr<Queue<msg::Odometry>> odometry_;
  ParticipantId server_ = 0;
  std::uint64_t received_ = 0, expected_ = 0, commands_sent_ = 0, reports_sent_ = 0, activities_sent_ = 0;
  std::optional<std::uint64_t> invited_after_;  ///< the step before the invitation; none: invited before the first
  std::optional<std::uint64_t> answered_;
  msg::Done last_done_;
  std::optional<msg::Point> goal_;
};

}  // namespace

int main(int argc, char** argv) {
  const char *domain = std::getenv("SKEIN_DOMAIN"), *uav = std::getenv("SKEIN_UAV"), *vendor = std::getenv("SKEIN_DDS"),
             *run = std::getenv("SKEIN_RUN");
  if (domain == nullptr || uav == nullptr || vendor == nullptr) {
    std::cerr << "usage: [SKEIN_RUN=N] SKEIN_DOMAIN=N SKEIN_UAV=NAME SKEIN_DDS=VENDOR minimal_client "
                 "[hang|boast|smuggle|forge|announce|tell]\n";
    return 2;
  }
  const char* security = std::getenv("SKEIN_SECURITY");  // set with --secure
  const auto bus = skein::bus::make_bus({.vendor = vendor, .security = security != nullptr ? security : ""});
  const auto participant = bus->join(std::atoi(domain));
  return Client(*participant, run != nullptr ? std::strtoull(run, nullptr, 10) : 0, uav, argc > 1 ? argv[1] : "").run();
}

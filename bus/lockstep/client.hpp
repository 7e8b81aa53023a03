// A member's side of the lock-step (docs/lockstep.md). It joins (hello, matching, ready), then in each step: wait for
// all announced samples -> think -> done. "Think" means that the program computes its answer to a step. Event-driven,
// so that a test can try all orders of events.   Threads: all calls from the thread that dispatches the inbox.
#pragma once

#include <functional>
#include <map>
#include <optional>

#include "bus/lockstep/counted.hpp"
#include "bus/typed.hpp"

namespace skein::bus {

class LockstepClient {
 public:
  using Step = msg::Step;
  enum class Counterpart { server, router };
  enum class Event {
    none,     ///< nothing to do yet
    think,    ///< step() is complete, handlers have run: think, write, then call done()
    dropped,  ///< the server has removed this member, or given it up while it joined, and continues without it
    resumed,  ///< a fault that stopped this program is over: join again, with a new participant and a new client
  };
  /// The server's order to this program because of a fault (docs/lockstep.md).
  enum class Order { kill, stop };

  /// @param member  UAV name, "gcs", "station" or "comm_router".
  LockstepClient(Participant& participant, Inbox& inbox, std::string member);

  /// Declares a topic to read; call it before start(). Handlers run inside poll(), in an order that depends only on the
  /// server's announcement.
  void read(const TopicSpec& topic, Counterpart counterpart, CountedQueues::Handler handler);
  /// The same for messages: `handler` gets (message); invalid samples are dropped and counted (typed.hpp).
  template <WireMessage Message, class Handler>
  void read(const TopicSpec& topic, Counterpart counterpart, Handler handler) {
    read(topic, counterpart, decoding<Message>(inbox_, topic.name, std::move(handler)));
  }
  /// Declares a topic to write; call it before start(). The writer exists once the server has invited this program: use
  /// write() below from the first think on.
  void declare_writer(const TopicSpec& topic, Counterpart counterpart);

  /// For radio topics that are registered with the router during the run; only RadioTopics (radio_topics.hpp) calls
  /// these. Creates a writer, unless the topic has one; replaces one of another type that the router has not opened.
  /// The router does not match it before open_radio_writer().
  void add_radio_writer(const TopicSpec& topic);
  /// Call it in a handler, when the router has opened the topic: the current step waits until the router has matched
  /// the writer.
  void open_radio_writer(const std::string& topic);
  /// Creates a reader for messages from the next step on, in place of a former one that the router has refused. Call it
  /// in a handler: the current step waits until the router has matched the reader.
  void open_radio_reader(const TopicSpec& topic, CountedQueues::Handler handler);

  /// Sends the hello; poll() continues from there.
  void start();
  /// Call after every dispatch of the inbox.
  Event poll();
  /// The step that poll() announced.
  const Step& step() const { return *step_; }

  /// Sends on a declared topic. @returns false, without sending, if this step has used up the topic's history depth, or
  /// if the topic is the router's and no router is a member. @throws std::logic_error for an undeclared topic.
  bool write(const std::string& topic, std::span<const std::uint8_t> payload);
  template <WireMessage Message>
  bool write(const std::string& topic, const Message& message) {
    return write(topic, encode(message));
  }
  /// Answers step(): sends Done. @param digest  only from the station: hash of the tally changes.
  void done(const std::vector<std::uint8_t>& digest = {});

  /// True from the first step on in which this program is a member.
  bool is_member() const { return phase_ == Phase::member; }
  /// True once the client has sent its declaration (topics that it reads and writes): then it has matched the server.
  bool has_declared() const { return phase_ >= Phase::declared; }
  /// True while the server's step writer is matched (before the invitation: any step writer). After the last step, a
  /// program must stay until this is false.
  bool server_present() const;
  /// The run to which this program belongs.
  RunId run() const { return inbox_.run(); }
  /// This program's participant.
  ParticipantId id() const { return participant_.id(); }
  /// Participants of the server and of the router; 0 when unknown or absent.
  ParticipantId server() const { return server_; }
  ParticipantId router() const { return router_; }
  /// Counts that came with the server's invitation (the router needs those of its members).
  const std::vector<CountedQueues::Expected>& base() const { return base_; }
  /// Sets a further condition for sending the declaration (the router: its other endpoints).
  void declare_when(std::function<bool()> condition) { declare_condition_ = std::move(condition); }
  /// Sets a further condition for Event::think (the station: the ledger has arrived).
  void think_when(std::function<bool(const Step&)> condition) { think_condition_ = std::move(condition); }
  /// Sets how an order is executed. Default: by kill_ourselves() or stop_ourselves() (self_signal.hpp).
  void obey_with(std::function<void(Order)> obey) { obey_ = std::move(obey); }
  /// Sets a function that is called before an order is executed: the last chance to save something.
  void before_obeying(std::function<void()> prepare) { before_obeying_ = std::move(prepare); }
  /// True while the client waits for matches. No sample announces these, so call poll() often.
  bool waits_for_matches() const;
  /// For Inbox::dispatch(): the number of ringing samples before which poll() cannot make progress.
  std::size_t rings() const { return phase_ == Phase::member && !pending_ && !handed_out_ ? 1 : 0; }
  /// Sets the reaction when the server repeats a step that was answered already (the answer may be lost). Default: send
  /// Done again.
  void answer_again_with(std::function<void()> answer) { answer_again_ = std::move(answer); }
  /// Describes, for people, what the client waits for.
  std::string waiting_for() const;

 private:
  struct Reading {
    TopicSpec topic;
    Counterpart counterpart;
    std::unique_ptr<Reader> reader;
    bool registered = false;  ///< radio topic that was registered during the run, not declared before start()
  };
  struct Writing {
    TopicSpec topic;
    Counterpart counterpart;
    std::unique_ptr<CountedWriter> writer;
    bool registered = false;
    bool open = true;  ///< the counterpart must have matched it before Event::think
  };
  enum class Phase { created, hello, matching, declared, member, ordered, stopped, dropped };

  void on_resync(const msg::Resync& resync, ParticipantId source);
  void on_step(msg::Step& step, ParticipantId source);
  void change_router(ParticipantId router);
  void create_endpoints();
  void open_reader(Reading& reading);
  void say_ready(std::uint32_t revision);
  bool matched(Counterpart counterpart, ParticipantId who) const;
  bool router_matched();

  Participant& participant_;
  Inbox& inbox_;
  std::string member_;
  Phase phase_ = Phase::created;
  std::optional<std::uint64_t> invited_after_;  ///< the last step before the invitation; nullopt: there was none
  ParticipantId server_ = 0, router_ = 0;
  ParticipantId matched_router_ = 0;  ///< router that has matched all topics; avoids a check in every step
  std::vector<Reading> readings_;
  std::vector<Writing> writings_;
  CountedQueues queues_;
  std::vector<CountedQueues::Expected> base_;
  std::map<std::string, std::uint64_t> delivered_;  ///< samples from the current router, by topic, read or not
  std::function<bool()> declare_condition_;
  std::function<bool(const Step&)> think_condition_;
  std::function<void(Order)> obey_;
  std::function<void()> before_obeying_;
  std::function<void()> answer_again_;
  std::optional<msg::Done> last_done_;
  Order order_ = Order::kill;  ///< valid in phase `ordered`
  std::unique_ptr<CountedWriter> ready_, done_;
  std::unique_ptr<Reader> resync_reader_, step_reader_;
  std::optional<Step> pending_, step_;
  bool handed_out_ = false;  ///< step()'s handlers have run, but radio topics that they opened are not matched yet
};

}  // namespace skein::bus

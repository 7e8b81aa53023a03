// A participant's side of the lock-step (docs/lockstep.md): hello, matched, ready; then step after step
// "all that was announced is here" -> think -> done. Built from events, so that a test can drive every order of them.
// Threads: all calls from the thread that dispatches the inbox.
#pragma once

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
    dropped,  ///< the server goes on without us
    resumed,  ///< a fault stopped us and is over: join again, with a new participant and a new client
  };
  /// What a fault file does to this program (docs/lockstep.md).
  enum class Order { kill, stop };

  /// @param member  UAV name, "gcs", "station" or "comm_router".
  LockstepClient(Participant& participant, Inbox& inbox, std::string member);

  /// Declarations, before start(). Handlers run inside poll(), in an order that depends on nothing but
  /// the announcement.
  void read(const TopicSpec& topic, Counterpart counterpart, CountedQueues::Handler handler);
  /// The same for messages: `handler` gets (message); what is no Message is dropped and counted (typed.hpp).
  template <WireMessage Message, class Handler>
  void read(const TopicSpec& topic, Counterpart counterpart, Handler handler) {
    read(topic, counterpart, decoding<Message>(inbox_, topic.name, std::move(handler)));
  }
  /// The writer exists once the server has invited us: use write() below from the first think on.
  void declare_writer(const TopicSpec& topic, Counterpart counterpart);

  /// Radio topics that are registered with the router while the run lasts (radio_topics.hpp tells when to call these).
  /// A writer, from now on, unless there is one; what it sends counts once it is open.
  void add_radio_writer(const TopicSpec& topic);
  /// The router hears it: the present step is not thought about before it is matched. Inside a handler.
  void open_radio_writer(const std::string& topic);
  /// A reader of what arrives from the next step on; the present one is not thought about before it is matched. Inside
  /// a handler.
  void open_radio_reader(const TopicSpec& topic, CountedQueues::Handler handler);

  /// Says hello; poll() does the rest.
  void start();
  /// Call after every dispatch of the inbox.
  Event poll();
  /// The step that poll() announced.
  const Step& step() const { return *step_; }

  /// Sends on a declared topic. @returns false when the step's share of its history is used up (not sent).
  bool write(const std::string& topic, std::span<const std::uint8_t> payload);
  template <WireMessage Message>
  bool write(const std::string& topic, const Message& message) {
    return write(topic, encode(message));
  }
  /// Ends our part in step(). @param digest  station: hash of the tally changes.
  void done(const std::vector<std::uint8_t>& digest = {});

  /// True from the first step on in which we are a member.
  bool is_member() const { return phase_ == Phase::member; }
  /// True once it has said what it reads and writes: the server and it have matched each other's topics.
  bool has_declared() const { return phase_ >= Phase::declared; }
  /// True as long as the server's step writer is there (whoever's, before we are invited): after the last step, stay
  /// until it has gone.
  bool server_present() const;
  /// The run that we take part in.
  RunId run() const { return inbox_.run(); }
  /// Our participant.
  ParticipantId id() const { return participant_.id(); }
  /// Who the server and the router are; 0 when unknown or absent.
  ParticipantId server() const { return server_; }
  ParticipantId router() const { return router_; }
  /// Counts that the server told us at the invitation (the router needs its members').
  const std::vector<CountedQueues::Expected>& base() const { return base_; }
  /// A further condition that must hold before the declaration goes out (the router: its other endpoints).
  void declare_when(std::function<bool()> condition) { declare_condition_ = std::move(condition); }
  /// A further condition that must hold before a step is thought about (the station: the ledger).
  void think_when(std::function<bool(const Step&)> condition) { think_condition_ = std::move(condition); }
  /// How an order is carried out: by raising SIGKILL or SIGSTOP on this process, unless a test does otherwise.
  void obey_with(std::function<void(Order)> obey) { obey_ = std::move(obey); }
  /// What is done before an order is carried out: the last chance to write something down.
  void before_obeying(std::function<void()> prepare) { before_obeying_ = std::move(prepare); }
  /// True while it waits for matches, which no sample announces: poll often.
  bool waits_for_matches() const;
  /// For Inbox::dispatch(): how many rings there must be before poll() can do more than it did.
  std::size_t rings() const { return phase_ == Phase::member && !pending_ && !handed_out_ ? 1 : 0; }
  /// What is to be done when the server tells the last answered step again (its answer may be lost); by default Done is
  /// said again.
  void answer_again_with(std::function<void()> answer) { answer_again_ = std::move(answer); }
  /// What it waits for, for a human.
  std::string waiting_for() const;

 private:
  struct Reading {
    TopicSpec topic;
    Counterpart counterpart;
    std::unique_ptr<Reader> reader;
    bool registered = false;  ///< not declared at the start
  };
  struct Writing {
    TopicSpec topic;
    Counterpart counterpart;
    std::unique_ptr<CountedWriter> writer;
    bool registered = false;
    bool open = true;  ///< its counterpart is to match it
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
  ParticipantId server_ = 0, router_ = 0;
  ParticipantId matched_router_ = 0;  ///< found once, there is no need to look again at every step
  std::vector<Reading> readings_;
  std::vector<Writing> writings_;
  CountedQueues queues_;
  std::vector<CountedQueues::Expected> base_;
  std::map<std::string, std::uint64_t> delivered_;  ///< by the present router, by topic, whether we read it or not
  std::function<bool()> declare_condition_;
  std::function<bool(const Step&)> think_condition_;
  std::function<void(Order)> obey_;
  std::function<void()> before_obeying_;
  std::function<void()> answer_again_;
  std::optional<msg::Done> last_done_;
  Order order_ = Order::kill;  ///< in phase `ordered`
  std::unique_ptr<CountedWriter> ready_, done_;
  std::unique_ptr<Reader> resync_reader_, step_reader_;
  std::optional<Step> pending_, step_;
  bool handed_out_ = false;  ///< the handlers have run for step(), which still waits for what they opened to match
};

}  // namespace skein::bus

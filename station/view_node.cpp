#include "station/view_node.hpp"

#include "bus/lockstep/names.hpp"
#include "bus/typed.hpp"
#include "core/view_topics.hpp"
#include "process/json_text.hpp"
#include "view/pages.hpp"
#include "view/story.hpp"

namespace skein::station {
namespace {

msg::String message_with(const std::string& text) {
  msg::String message;
  message.data(text);
  return message;
}

/// Hands a text on from whatever thread the bus has.
template <class Use>
bus::OnSample each_text(const Use& use) {
  return [use](bus::Sample&& sample) {
    msg::String message;
    if (decode(sample.payload, message)) use(message.data());
  };
}

/// What only the launcher knows goes in front: sim_server's scene is an object.
std::string with_title(const std::string& scene, const std::string& title) {
  return "{\"title\":" + Json(title).dump(-1, ' ', false, Json::error_handler_t::replace) + "," + scene.substr(1);
}

}  // namespace

ReadyView::ReadyView(const ViewOptions& options)
    : listener(options.listener),
      key(view::Key::read_from(options.key)),
      site(view::site_of(options.title, options.script)),
      title(options.title) {}

ViewNode::ViewNode(const ReadyView& ready, bus::Participant& world, bus::Inbox& inbox)
    : orders_(world.create_writer(bus::spec(topics::view_time()))) {
  const auto obey = [this, &inbox](const view::TimeOrder& order) {
    inbox.post([this, order] { orders_->write(encode(message_with(text_of(order)))); });
  };
  server_.emplace(ready.listener, ready.key, ready.site, feed_, obey);
  // The first sample is the scene.
  story_ = world.create_reader(
      bus::spec(topics::view_story()),
      each_text([this, title = ready.title, first = std::make_shared<bool>(true)](const std::string& text) {
        if (std::exchange(*first, false)) return feed_.set_scene(with_title(text, title));
        feed_.add_line(text);
      }));
  state_ = world.create_reader(bus::spec(topics::view_state()),
                               each_text([this](const std::string& text) { feed_.set_state(text); }));
}

void ViewNode::add_records(const std::vector<TallyRecord>& records) {
  for (const TallyRecord& record : records) {
    if (record.entry.collision) continue;
    feed_.add_line(view::delivered_line(seconds(record.tick), record.entry.uav, record.entry.capture.capture));
  }
}

void ViewNode::end_step(const Scoreboard& scoreboard, const StepOutcome& outcome, std::uint64_t standing) {
  const std::vector<LedgerEntry>& ledger = scoreboard.ledger();
  for (; entries_told_ < standing; ++entries_told_) {
    const LedgerEntry& entry = ledger[entries_told_];
    if (!entry.collision) {
      feed_.add_line(view::capture_line(seconds(entry.tick), entry.uav, entry.capture.capture, entry.capture.points));
    } else if (scoreboard.is_void(entry.uav)) {
      feed_.add_line(view::void_line(seconds(entry.tick), entry.uav));
    }
  }
  add_records(outcome.records);
  const std::vector<TimelinePoint>& timeline = scoreboard.timeline();
  for (; scores_told_ < timeline.size(); ++scores_told_) {
    const TimelinePoint& point = timeline[scores_told_];
    feed_.add_line(view::score_line(seconds(point.tick), point.points, point.score));
  }
}

}  // namespace skein::station

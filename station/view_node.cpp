#include "station/view_node.hpp"

#include "bus/lockstep/names.hpp"
#include "bus/typed.hpp"
#include "core/messages/view_topics.hpp"
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

/// Passes each text on to `use`, in the thread in which the bus delivers it.
bus::OnSample each_text(const auto& use) {
  return [use](bus::Sample&& sample) {
    msg::String message;
    if (decode(sample.payload, message)) use(message.data());
  };
}

/// Adds the title, which only the launcher knows, to sim_server's scene, which is a JSON object.
std::string with_title(const std::string& scene, const std::string& title) {
  return "{\"title\":" + Json(title).dump(-1, ' ', false, Json::error_handler_t::replace) + "," + scene.substr(1);
}

}  // namespace

ReadyView::ReadyView(const ViewOptions& options)
    : own(options.listen.empty() ? nullptr : std::make_unique<view::Listener>(view::resolved(options.listen))),
      listener(own ? own->fd() : options.listener),
      key(view::Key::read_from(options.key)),
      site(view::site_of(options.title, options.script)),
      title(options.title) {
  site.names = options.names;
}

ViewNode::ViewNode(const ReadyView& ready, bus::Participant& world, bus::Inbox& inbox)
    : orders_(world.create_writer(bus::spec(topics::view_orders()))) {
  const auto obey = [this, &inbox](const view::Order& order) {
    inbox.post([this, order] { orders_->write(encode(message_with(view::text_of(order)))); });
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
  clouds_ = world.create_reader(bus::spec(topics::view_cloud()), each_text([this](const std::string& text) {
                                  const Json name = value_or(parse_json(text), "n", "");
                                  feed_.set_cloud(name.get<std::string>(), text);
                                }));
}

void ViewNode::add_records(const std::vector<TallyRecord>& records) {
  std::vector<view::ShownDelivery> deliveries;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const LedgerEntry& entry = records[i].entry;
    if (!entry.collision) deliveries.push_back({entry.uav, entry.capture.capture});
    const bool last_of_step = i + 1 == records.size() || records[i + 1].tick != records[i].tick;
    if (!last_of_step || deliveries.empty()) continue;
    feed_.add_line(view::delivered_line(seconds(records[i].tick), deliveries));
    deliveries.clear();
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

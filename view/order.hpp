// All that a browser may ask of a run. The same text goes from the page to the station and on to the server, and each
// reads it with the same suspicion. A new kind of order is a struct with text_of() and a reader of its own, and an
// alternative here.   Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "view/fault_order.hpp"
#include "view/fly_order.hpp"
#include "view/look_order.hpp"
#include "view/time_order.hpp"

namespace skein::view {

using Order = std::variant<TimeOrder, FaultOrder, FlyOrder, LookOrder>;

/// A JSON object; its key "do" names the order.
std::string text_of(const Order& order);
/// @returns nullopt when the text is no order, word for word in its keys, or longer than any order is.
std::optional<Order> read_order(std::string_view text);

}  // namespace skein::view

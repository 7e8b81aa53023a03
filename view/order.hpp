// All orders that a browser may give to a run. The text goes unchanged from the page to the station and on to
// sim_server; station and server both validate it. A new kind of order needs a struct with its own text_of() and
// reader, and an alternative in the variant below.   Pure; any thread.
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
/// @returns nullopt unless the text is exactly an order: known keys only, and no longer than an order may be.
std::optional<Order> read_order(std::string_view text);

}  // namespace skein::view

#include "view/order.hpp"

namespace skein::view {

std::string text_of(const Order& order) {
  return std::visit([](const auto& one) { return text_of(one); }, order);
}

std::optional<Order> read_order(std::string_view text) {
  if (const auto time = read_time_order(text)) return *time;
  if (const auto fault = read_fault_order(text)) return *fault;
  if (const auto fly = read_fly_order(text)) return *fly;
  if (const auto look = read_look_order(text)) return *look;
  return std::nullopt;
}

}  // namespace skein::view

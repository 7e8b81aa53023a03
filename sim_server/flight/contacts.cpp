#include "sim_server/flight/contacts.hpp"

#include <algorithm>
#include <tuple>

namespace skein::sim {

Contact contact_between(const BodyId& a, const BodyId& b, const Vector3d& p_W) {
  const bool swapped = a.kind != BodyId::Kind::uav || (b.kind == BodyId::Kind::uav && b.uav < a.uav);
  return swapped ? Contact{b.uav, a, p_W} : Contact{a.uav, b, p_W};
}

std::vector<Contact> one_for_each_pair(std::vector<ContactPoint> points) {
  const auto pair = [](const ContactPoint& point) {
    return std::tuple(point.contact.uav, point.contact.other.kind, point.contact.other.uav);
  };
  std::ranges::stable_sort(points, [&](const ContactPoint& x, const ContactPoint& y) {
    return pair(x) != pair(y) ? pair(x) < pair(y) : x.distance < y.distance;
  });
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || pair(points[i]) != pair(points[i - 1])) contacts.push_back(points[i].contact);
  }
  return contacts;
}

}  // namespace skein::sim

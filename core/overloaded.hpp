// For std::visit(): a function of each alternative.
#pragma once

namespace skein {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

}  // namespace skein

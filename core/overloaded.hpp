// A visitor for std::visit() made of several lambdas, one for each alternative of the variant.
#pragma once

namespace skein {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

}  // namespace skein

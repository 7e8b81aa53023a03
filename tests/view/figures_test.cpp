// The cost of the page: draw calls, bytes sent, memory over an hour, for a large artificial flight that the test
// advances. Nothing depends on the clock.
#include "view_fixture.hpp"

namespace skein::test {
namespace {

class FiguresOfThePage : public BrowserTest {};

TEST_F(FiguresOfThePage, StayWithinTheirBoundsOverAnHour) {
  look("figures", folder() / "door.html", helper_program("view_feeder"));
}

}  // namespace
}  // namespace skein::test

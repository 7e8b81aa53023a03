// What the page takes: draw calls, what is sent, memory over an hour. Of a large flight that is made up, at a pace of
// its own: nothing here depends on the clock.
#include "view_fixture.hpp"

namespace skein::test {
namespace {

class FiguresOfThePage : public BrowserTest {};

TEST_F(FiguresOfThePage, StayWithinTheirBoundsOverAnHour) {
  look("figures", folder() / "door.html", helper_program("view_feeder"));
}

}  // namespace
}  // namespace skein::test

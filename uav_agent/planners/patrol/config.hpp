// Parameters of the patrol planner (patrol.cpp): --planner patrol:overlap=0.3,survey=false.
// Units: SI unless the name says otherwise.
#pragma once

#include "core/config_reader.hpp"

namespace skein::agent {

struct PatrolConfig {
  bool use_map = true;             ///< false: knows nothing but the boxes; for comparison
  bool survey = true;              ///< explorers fly once around everything first
  bool top = true, bottom = true;  ///< look at these faces, too
  double clearance_m = 1.2;        ///< from the UAV's body to anything mapped
  double transit_mps = 5.0, survey_mps = 4.5, climb_mps = 3.0;
  double survey_standoff_m = 10.0;
  double standoff_ratio = 0.92;  ///< distance to the surface in units of d*
  double blind_ratio = 0.55;     ///< distance to a box's face where no surface is mapped
  double overlap = 0.2;
  double speed_gain = 1.0;           ///< 1: no blur
  double blind_height_ratio = 0.45;  ///< of the highest box: below it, only space that was seen free is entered
  double deliver_every_s = 240.0;
  double return_margin_s = 12.0;

  template <class R>
  void describe(R& r) {
    r.field("use_map", use_map);
    r.field("survey", survey);
    r.field("top", top);
    r.field("bottom", bottom);
    r.field("clearance_m", clearance_m, within(0.3, 10.0));
    r.field("transit_mps", transit_mps, within(0.5, 20.0));
    r.field("survey_mps", survey_mps, within(0.5, 20.0));
    r.field("climb_mps", climb_mps, within(0.2, 10.0));
    r.field("survey_standoff_m", survey_standoff_m, within(2.0, 50.0));
    r.field("standoff_ratio", standoff_ratio, within(0.3, 1.5));
    r.field("blind_ratio", blind_ratio, within(0.2, 1.5));
    r.field("overlap", overlap, within(0.0, 0.8));
    r.field("speed_gain", speed_gain, within(0.2, 5.0));
    r.field("blind_height_ratio", blind_height_ratio, within(0.0, 1.0));
    r.field("deliver_every_s", deliver_every_s, within(10.0, 1e6));
    r.field("return_margin_s", return_margin_s, within(0.0, 600.0));
  }
};

}  // namespace skein::agent

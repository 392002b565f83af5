#pragma once

namespace tushar::mpm::solid {

/// How the particles of a material take part when grains that do not touch move separately (DoGranularMPM).
struct Grain {
  int type = 0;            ///< MatTypeIdx: materials of one type exchange particles
  bool hasContact = true;  ///< whether it is for clusters that touch particles of other types
  bool maySplit = false;   ///< whether its particles may move to other materials
};

}  // namespace tushar::mpm::solid

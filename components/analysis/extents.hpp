#pragma once

#include <string>
#include <vector>

#include "components/analysis/sampling.hpp"
#include "core/collect/gather.hpp"
#include "core/input/schema.hpp"

// Lines and planes between two points, for lineExtract and planeExtract.

namespace tushar::analysis {

using grid::Level;

/// A tag `<line name=>` or `<plane name=>`.
struct Extent {
  Location where, whereOfName;
  std::string name;
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();  ///< two opposite corners [m]
  double step = 0;                                ///< spacing of the samples [m]; 0: every cell
};

struct ExtentList {
  std::vector<Extent> list;
};

/// The schemas of `<lines>`, with tags `line`, and of `<planes>`, with tags `plane`.
const input::Schema<ExtentList>& linesSchema();
const input::Schema<ExtentList>& planesSchema();

/// Throws InputError for lines (`axes` = 1) or planes (2) that contain no cells of the grid or are not parallel to
/// axes, and for names that cannot be folders of the archive.
void checkExtents(const std::vector<Extent>& extents, int axes, const grid::Level& level);

/// The box of the cells that an extent crosses; if the extent lies on faces between cells, the cells above these faces.
/// The nodes of an extent are the lower corners of these cells. `level` is the finest level; the box is on the level
/// that is `coarser` levels above it.
grid::Box cellsOf(const Extent& extent, const grid::Level& level, int coarser = 0);

/// A box of cells on a level; level 0 is the coarsest.
struct LevelBox {
  int level;
  grid::Box cells;
};

/// The tags of a module that samples variables in extents.
struct ExtentSettings : Sampling {
  ExtentList extents;
};

/// A module that samples variables in extents; it receives one part of the state for each extent. Its constructor
/// throws the exceptions of checkExtents.
class ExtentModule : public SamplingModule {
 public:
  ExtentModule(const ExtentSettings& settings, int axes, const grid::Level& level);

  std::vector<collect::Window> windows() const override;
  std::vector<simulation::OwnFile> files() const override;

 protected:
  /// The boxes of cells for which a part has values, in the order of the values.
  std::vector<LevelBox> boxesOf(std::size_t extent, const output::Snapshot& part) const;

  std::vector<Extent> extents_;
  const grid::Level* level_;
};

/// The axis (0: x, 1: y, 2: z) to which a line is parallel.
int axisOf(const Extent& line);

/// The index of a cell along x, y, z; 0 along the axes that the grid does not use.
Index3 sceneIndex(const Index3& cell, const grid::Level& level);
/// The position of a cell [m]: its centre or, if `isCorner`, its lower corner. Along the axes that the grid does not
/// use, it is the middle of the domain. `coarser` has the same meaning as for cellsOf.
Vec3 placeOf(const Index3& cell, bool isCorner, const grid::Level& level, int coarser = 0);

}  // namespace tushar::analysis

// Where a line leaves the shape, and whether it had to.
#pragma once

#include <marrow/surface_sides.hpp>

#include <span>
#include <vector>

namespace marrow {

/// A point of a line and what the surface says of it.
struct LineSample {
  Vec3 position;
  PointSide surface;
};

/// A piece of a line outside the surface, with the last sample before it and the first after it.
struct Excursion {
  std::vector<Vec3> samples;
  double clearance = 0;  ///< greatest on the way
};

/// How far from the surface a line gets where it runs outside, found out as far as one asks: a
/// piece whose ends are connected inside the shape within a voxel of it does not count, and to know
/// that takes long.
class LineOutside {
 public:
  /// A piece that gets beyond `hollow` counts, whatever there is around it.
  LineOutside(std::span<const LineSample> samples, double hollow);

  /// Not less than how far it gets; 0 where no piece counts.
  double at_most() const { return pieces_.empty() ? 0 : pieces_.back().clearance; }
  /// Whether it gets that far.
  bool is_known() const { return counts_ || pieces_.empty(); }
  /// Asks for the piece that at_most() comes from.
  void ask(SurfaceSides& surface, double voxel);

 private:
  std::vector<Excursion> pieces_;  // the farthest one last
  double hollow_;
  bool counts_ = false;  // the last one
};

}  // namespace marrow

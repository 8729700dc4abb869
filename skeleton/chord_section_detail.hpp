// How wide a shape is across a line.
#pragma once

#include <marrow/surface_scene.hpp>
#include <marrow/visual_hull.hpp>

#include <array>
#include <functional>

namespace marrow {

/// How far one gets from a point in a direction, a unit vector.
using FreeWay = std::function<double(const Vec3& from, const Vec3& direction)>;

/// To the end of the visual hull.
FreeWay free_way_in(const Projections& projections);

/// To the surface; to the end of the hull where there is a hole in it.
FreeWay free_way_in(const SurfaceScene& surface, const Projections& projections);

/// Unit vectors in the plane of two, all the way round in steps of 22.5 degrees from `u` to `v`.
std::array<Vec3, 16> directions_around(const Vec3& u, const Vec3& v);

/// Half the lengths of chords through a point.
struct ChordSection {
  double median = 0, widest = 0, thinnest = 0;
  Vec3 normal;  ///< unit vector along the thinnest
  Vec3 middle;  ///< of the thinnest
};

/// The section through `p` across the unit vector `tangent`, by chords in eight directions.
ChordSection section_across(const Vec3& p, const Vec3& tangent, const FreeWay& free_way);

/// The section with its normal turned out of it to where the shape is thinnest: that of a sheet.
ChordSection turned_to_normal(ChordSection section, const FreeWay& free_way);

}  // namespace marrow

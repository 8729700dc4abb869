// Where we look from (section 4.1): directions, and a stereo pair of images for each.
#pragma once

#include <marrow/vec.hpp>

#include <array>
#include <span>
#include <vector>

namespace marrow {

/// The 42 vertices of the once subdivided icosahedron, one of each antipodal pair: unit vectors.
std::span<const Vec3> hemisphere_directions();

/// The same of the twice subdivided icosahedron: 81, those of hemisphere_directions() first.
std::span<const Vec3> fine_hemisphere_directions();

/// `directions` as unit vectors, in their order; one that is within 1e-6 of an earlier one, or of
/// its opposite, is left out: it sees the same silhouettes. Throws Error: Usage (one is zero or not
/// finite).
std::vector<Vec3> distinct_directions(std::span<const Vec3> directions);

/// The axes of one image in the normalised frame: columns grow along u, rows along v.
struct ViewPlane {
  Vec3 u, v;

  friend bool operator==(const ViewPlane&, const ViewPlane&) = default;
};

/// Two orthographic images that share their rows: the front one looks along z, the side one along
/// x. y is the scanline axis.
struct StereoPair {
  Frame frame;

  ViewPlane front() const { return {frame.x, frame.y}; }
  ViewPlane side() const { return {frame.z, frame.y}; }
};

/// Any frame whose z is `direction`; the same for the same direction.
Frame frame_along(const Vec3& direction);

/// Square images of the unit ball, one pixel size for all of them, so that radii compare.
struct PixelGrid {
  int resolution = 256;  ///< pixels along a side, 64 to 1024

  /// Length of a pixel in the normalised frame; three pixels of margin on every side.
  double pixel() const { return 2.0 / (resolution - 6); }
  /// Image coordinate of `length` along an axis; pixel centres are integers.
  double to_pixels(double length) const { return length / pixel() + 0.5 * (resolution - 1); }
  /// The length along an axis of image coordinate `coordinate`.
  double to_length(double coordinate) const {
    return (coordinate - 0.5 * (resolution - 1)) * pixel();
  }
};

}  // namespace marrow

// What can be counted on a volume without skeletonising it.
#pragma once

#include <marrow/bounds.hpp>
#include <marrow/volume.hpp>

#include <cstddef>
#include <optional>

namespace marrow {

/// Parts, cavities and tunnels of the foreground, whose voxels touch in faces, edges and corners.
struct VolumeTopology {
  std::size_t components = 0;
  std::size_t cavities = 0;  ///< parts of the background that nothing connects to the outside
  std::size_t tunnels = 0;   ///< independent cycles through the foreground: a ring has one

  friend bool operator==(const VolumeTopology&, const VolumeTopology&) = default;
};

/// Foreground voxels.
std::size_t foreground_count(const Volume& volume);

/// The box around the foreground in world units, corners of voxels included; empty without any.
Bounds foreground_bounds(const Volume& volume);

/// Counts parts, cavities and tunnels; none for a volume so noisy that its rows fall into more
/// than some 60 million pieces.
std::optional<VolumeTopology> topology_of(const Volume& volume);

}  // namespace marrow

// Simple points of a voxel set: those whose removal changes no topology.
#pragma once

#include <cstdint>

namespace marrow {

/// The 26 neighbours of a voxel as bits: bit i is offset (i' % 3, i' / 3 % 3, i' / 9) - 1 with
/// i' = i for i < 13 and i + 1 from there on (the voxel itself has no bit).
using Neighbourhood = std::uint32_t;

/// Whether a voxel with these neighbours is simple: 26-connectivity for the set, 6 for the rest
/// (Bertrand and Malandain 1994).
bool is_simple(Neighbourhood neighbours);

}  // namespace marrow

// Bodies bent by their own bones.
#pragma once

#include "bones.hpp"

namespace marrow {

/// `body` in pose `number`, >= 0; 0 is the body as it is. Every limb turns about the joint that it
/// begins at, by up to a tenth of a turn, and about its middle, by up to an eighth, and takes along
/// what hangs on it. Limbs keep clear of each other: their gap stays at least the thinner one's
/// radius, or what it was. The bones must form a tree, each after the bone that ends where it
/// begins.
BoneGraph posed(const BoneGraph& body, int number);

}  // namespace marrow

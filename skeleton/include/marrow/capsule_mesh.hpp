// The shape that a curve-skeleton stands for, as a mesh.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>

#include <string>

namespace marrow {

/// A ball of 80 triangles for every node, and for every edge the round cone between its two balls,
/// where none of them lies in the other. They overlap and are closed and oriented each.
Shape capsule_mesh(const CurveSkeleton& skeleton);

/// A mesh as binary glTF, in single precision. Throws Error: Unsupported (a coordinate that single
/// precision cannot hold).
std::string format_glb(const Shape& mesh);

}  // namespace marrow

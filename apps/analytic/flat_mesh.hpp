// Flat shapes without thickness.
#pragma once

#include <marrow/shape.hpp>

#include "bones.hpp"
#include "field.hpp"

namespace marrow {

/// The part of the plane z = 0 where `field` is not positive, cut into triangles of edge `cell`: an
/// open sheet, its normals along z.
Shape fill_flat(const Field& field, const Box& box, double cell);

}  // namespace marrow

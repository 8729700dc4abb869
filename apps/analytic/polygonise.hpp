// From a distance field to a closed mesh.
#pragma once

#include <marrow/shape.hpp>

#include "bones.hpp"
#include "field.hpp"

namespace marrow {

/// The zero surface of `field` inside `box`, with one vertex for every sheet of the surface in
/// every cell of a grid of width `cell` (dual marching cubes: Nielson, "Dual marching cubes",
/// 2004). The mesh is closed, oriented with its normals outward, and 2-manifold whatever the field
/// does between the corners of the grid; parts thinner than a cell can be missed. The vertices lie
/// on the surface, evenly spread. The surface must stay inside the box.
Shape polygonise(const Field& field, const Box& box, double cell);

}  // namespace marrow

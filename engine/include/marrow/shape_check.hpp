// Whether a shape keeps what its type promises.
#pragma once

#include <marrow/shape.hpp>

namespace marrow {

/// Readers give no other shapes; callers may. Throws Error: Malformed, when a point that counts is
/// not finite, or a triangle has a corner that is no point.
void check_shape(const Shape& shape);

}  // namespace marrow

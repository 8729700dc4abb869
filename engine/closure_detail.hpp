// Whether a surface closes.
#pragma once

#include <marrow/shape.hpp>

namespace marrow {

struct Closure {
  bool closed = false;    ///< every edge has an even number of triangles
  bool oriented = false;  ///< closed, and every edge is run through as often in either direction
};

/// Points are welded by position. The exclusive or of one hash per edge vanishes when every edge
/// has an even number of triangles, the signed sum when every edge is run through as often in
/// either direction; for other shapes they do so but once in 2^64.
Closure closure_of(const Shape& shape);

}  // namespace marrow

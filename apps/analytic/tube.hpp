// Swept tubes: the envelope of the balls along a curve.
#pragma once

#include <marrow/shape.hpp>

#include "curve.hpp"

namespace marrow {

/// The closed surface that the balls along a smooth `curve` sweep out, with round caps at open
/// ends, `sides` corners around and a ring at every ball. Each ball touches the surface, so its
/// radius is the distance from the centre line, also where the radius changes along the curve (it
/// must change by less than the distance between the balls).
Shape make_tube(const Curve& curve, int sides);

/// `more` behind `shape`, not welded.
void append(Shape& shape, const Shape& more);

}  // namespace marrow

// OBJ, PLY and CSV files can hold a shape or a curve-skeleton: which one is it?
#pragma once

#include <string_view>

namespace marrow {

/// Lines and no faces, or the first line that we write ourselves.
bool obj_is_skeleton(std::string_view bytes);

/// An element `edge` and no element `face` in the header.
bool ply_is_skeleton(std::string_view bytes);

/// A column `neighbours` in the first line.
bool csv_is_skeleton(std::string_view bytes);

}  // namespace marrow

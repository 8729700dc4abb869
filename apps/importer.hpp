// Meshes of other ecosystems, read by a program of its own.
#pragma once

#include "command.hpp"

namespace marrow {

/// The formats that marrow-import reads, by their extensions.
const std::vector<std::string>& imported_formats();

bool is_imported(const InputFile& file);

/// The shape in a file of one of these formats. marrow-import, beside the program itself, reads it
/// as a process of its own, whose death is an Error like any other. Throws Error: Unsupported (also
/// where it is not installed), Malformed, Empty, Limit.
Shape imported_shape(const InputFile& file);

}  // namespace marrow

// What every stage of an extraction made, as pictures and graphs for a person to look at.
#pragma once

#include <marrow/extract.hpp>

#include <string>
#include <vector>

#include "command.hpp"

namespace marrow {

/// Sheets of all silhouettes, distance maps and medial axes, of slices through the votes and the
/// hull, and the graph of every stage as OBJ in the units of the shape: numbered files in `folder`,
/// in the order of the paper.
std::vector<OutputFile> draw_trace(const ExtractTrace& trace, const std::string& folder);

}  // namespace marrow

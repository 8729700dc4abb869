// Directions to look along, read from a text.
#pragma once

#include <marrow/vec.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace marrow {

/// Reads `x y z` from every line, apart by blanks; lines without words and what follows a word that
/// begins with # do not count. 1 to 1024 of any length but 0. `name` stands for the file in
/// messages. Throws Error: Malformed (with the line), Limit (more than 1024).
std::vector<Vec3> parse_directions(std::string_view bytes, const std::string& name);

/// The same from a file. Throws Error: CannotRead, Malformed, Limit (also above 1 MiB).
std::vector<Vec3> read_directions(const std::string& path);

}  // namespace marrow

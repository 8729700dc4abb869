// Counts and measures of shapes and curve-skeletons, for people and for programs.
#pragma once

#include <marrow/curve_skeleton.hpp>
#include <marrow/shape.hpp>
#include <marrow/volume.hpp>

#include <nlohmann/json.hpp>

#include <string>

namespace marrow {

/// Keys in the order in which they are shown.
using Statistics = nlohmann::ordered_json;

Statistics statistics_of(const Shape& shape);
Statistics statistics_of(const Volume& volume);
Statistics statistics_of(const CurveSkeleton& skeleton);

/// JSON with an end of line; bytes that are not UTF-8 are replaced.
std::string to_json(const Statistics& statistics);

/// One "key  value" line each, numbers to six figures.
std::string to_table(const Statistics& statistics);

}  // namespace marrow

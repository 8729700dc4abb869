#include "request.hpp"

#include <marrow/error.hpp>
#include <marrow/shape_io.hpp>

#include <analytic_shapes.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>

namespace marrow {

namespace {

// A loop, thin limbs, curled limbs, and a body.
constexpr const char* kDefaultShapes = "torus,hand,octopus,quadruped";

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');)
    if (!word.empty()) words.push_back(word);
  return words;
}

/// The value of "--name=value" if `argument` is that.
std::optional<std::string> value_of(const std::string& argument, const std::string& name) {
  const std::string start = "--" + name + "=";
  if (!argument.starts_with(start)) return {};
  return argument.substr(start.size());
}

template <class Number>
Number number_of(const std::string& text, const std::string& what) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    throw Error(ErrorKind::Usage, what + " must be a number, not \"" + text + "\"");
  return number;
}

ShapeSource made(const std::string& word) {
  const auto colon = word.find(':');
  if (colon == std::string::npos) return {word, {}, 1};
  return {word, {}, number_of<double>(word.substr(colon + 1), "the resolution in --make")};
}

bool is_shape_file(const std::filesystem::path& path) {
  constexpr std::array kExtensions{".obj", ".ply", ".stl", ".off"};
  return std::ranges::find(kExtensions, path.extension().string()) != kExtensions.end();
}

void add_path(std::vector<ShapeSource>& shapes, const std::string& path) {
  if (!std::filesystem::is_directory(path)) {
    shapes.push_back({std::filesystem::path(path).stem().string(), path});
    return;
  }
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (is_shape_file(entry.path())) files.push_back(entry.path().string());
  if (files.empty()) throw Error(ErrorKind::CannotRead, path + ": no shapes in this folder");
  std::ranges::sort(files);
  for (const auto& file : files) add_path(shapes, file);
}

/// Whether `argument` was one of ours.
bool take(BenchRequest& request, const std::string& argument) {
  if (const auto names = value_of(argument, "make")) {
    for (const auto& word : split(*names)) request.shapes.push_back(made(word));
  } else if (const auto paths = value_of(argument, "shapes")) {
    for (const auto& path : split(*paths)) add_path(request.shapes, path);
  } else if (const auto image = value_of(argument, "image")) {
    request.options.image_resolution = number_of<int>(*image, "--image");
  } else if (const auto grid = value_of(argument, "grid")) {
    request.options.grid_resolution = number_of<int>(*grid, "--grid");
  } else if (const auto threads = value_of(argument, "threads")) {
    request.options.max_threads = number_of<int>(*threads, "--threads");
  } else if (const auto simd = value_of(argument, "simd")) {
    request.simd = *simd;
  } else if (argument == "--per-view") {
    request.per_view = true;
  } else {
    return false;
  }
  return true;
}

}  // namespace

BenchRequest take_request(std::vector<std::string>& arguments) {
  BenchRequest request;
  request.options.max_threads = 1;
  std::erase_if(arguments, [&](const std::string& argument) { return take(request, argument); });
  if (const char* paths = std::getenv("MARROW_BENCH_SHAPES"); paths && request.shapes.empty())
    for (const auto& path : split(paths)) add_path(request.shapes, path);
  if (request.shapes.empty())
    for (const auto& word : split(kDefaultShapes)) request.shapes.push_back(made(word));
  return request;
}

Shape load(const ShapeSource& source) {
  if (!source.path.empty()) return read_shape(source.path);
  const std::string name = source.name.substr(0, source.name.find(':'));
  return make_analytic_shape(name, {source.resolution}).shape;
}

}  // namespace marrow

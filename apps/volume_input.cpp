#include "volume_input.hpp"

#include <marrow/error.hpp>

#include <array>
#include <charconv>
#include <cmath>

#include "limits.hpp"

namespace marrow {

namespace {

struct TypeName {
  const char* name;
  VoxelType type;
  std::endian order = std::endian::little;
};

constexpr TypeName kTypes[] = {
    {"u8", VoxelType::U8},
    {"i8", VoxelType::I8},
    {"u16", VoxelType::U16},
    {"i16", VoxelType::I16},
    {"u32", VoxelType::U32},
    {"i32", VoxelType::I32},
    {"u64", VoxelType::U64},
    {"i64", VoxelType::I64},
    {"f32", VoxelType::F32},
    {"f64", VoxelType::F64},
    {"u16be", VoxelType::U16, std::endian::big},
    {"i16be", VoxelType::I16, std::endian::big},
    {"u32be", VoxelType::U32, std::endian::big},
    {"i32be", VoxelType::I32, std::endian::big},
    {"u64be", VoxelType::U64, std::endian::big},
    {"i64be", VoxelType::I64, std::endian::big},
    {"f32be", VoxelType::F32, std::endian::big},
    {"f64be", VoxelType::F64, std::endian::big},
};

/// Three numbers between commas.
template <class Number>
std::array<Number, 3> triple_of(const std::string& option, const std::string& text) {
  std::array<Number, 3> values{};
  const char *at = text.data(), *const end = text.data() + text.size();
  bool is_right = true;
  for (std::size_t i = 0; i < 3 && is_right; ++i) {
    const auto [stop, error] = std::from_chars(at, end, values[i]);
    is_right = error == std::errc{} && (i == 2 ? stop == end : stop != end && *stop == ',');
    at = is_right && i < 2 ? stop + 1 : stop;
  }
  if (!is_right)
    throw Error(ErrorKind::Usage,
                option + ": " + one_line(text) + " is not three numbers like 64,64,32");
  return values;
}

}  // namespace

void add_volume_options(CLI::App& verb, VolumeRequest& request) {
  verb.add_option("--iso", request.iso, "Voxels of a volume are foreground above this value")
      ->type_name("VALUE")
      ->capture_default_str();
  verb.add_option("--dims", request.dims,
                  "Of a raw volume: voxels along x, y and z; x runs fastest")
      ->type_name("NX,NY,NZ");
  std::vector<std::string> names;
  for (const TypeName& t : kTypes) names.push_back(t.name);
  verb.add_option("--type", request.type,
                  "Of a raw volume: u8 i8 u16 i16 u32 i32 u64 i64 f32 f64, and u16be to f64be")
      ->check(CLI::IsMember(names).description(""))
      ->type_name("TYPE")
      ->capture_default_str();
  verb.add_option("--spacing", request.spacing, "Of a raw volume: from voxel to voxel")
      ->type_name("X,Y,Z")
      ->capture_default_str();
  verb.add_option("--max-voxels", request.max_voxels, "Voxels of a volume at most")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->group(kLimitGroup);
}

VolumeOptions volume_options_of(const VolumeRequest& request) {
  VolumeOptions options;
  if (std::isnan(request.iso)) throw Error(ErrorKind::Usage, "--iso: nan is not a number");
  options.iso = request.iso;
  options.max_voxels = request.max_voxels;
  if (!request.dims.empty()) options.dims = triple_of<std::uint64_t>("--dims", request.dims);
  for (const TypeName& t : kTypes)
    if (request.type == t.name) options.type = t.type, options.order = t.order;
  const auto [x, y, z] = triple_of<double>("--spacing", request.spacing);
  options.spacing = {x, y, z};
  return options;
}

bool is_volume(const InputFile& file) { return volume_format_of("x." + file.format).has_value(); }

Volume volume_of(const InputFile& file, const VolumeRequest& request) {
  VolumeOptions options = volume_options_of(request);
  options.max_bytes = file.limits.max_bytes;
  try {
    return parse_volume(file.bytes, *volume_format_of("x." + file.format), file.name, options);
  } catch (const Error& e) {
    throw_with_option(e, "--max-voxels");
  }
}

std::variant<Shape, Volume> shape_or_volume_of(const InputFile& file,
                                               const VolumeRequest& request) {
  if (is_volume(file)) return volume_of(file, request);
  return shape_of(file);
}

}  // namespace marrow

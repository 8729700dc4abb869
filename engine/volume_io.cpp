#include <marrow/error.hpp>
#include <marrow/file_io.hpp>
#include <marrow/volume_io.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include "text_detail.hpp"
#include "volume_detail.hpp"

namespace marrow {

namespace volume_detail {

namespace {

constexpr double kFarthest = 1e100;  // world units: far from where squares overflow
constexpr double kFlat = 1e-9;       // volume of a voxel over the product of its edges

bool is_far(const Vec3& v) {
  return !(std::abs(v.x) < kFarthest && std::abs(v.y) < kFarthest && std::abs(v.z) < kFarthest);
}

void check_steps(const Placement& p, const Source& source) {
  bool is_bad = is_far(p.origin);
  double edges = 1;
  for (const Vec3& step : p.steps) {
    is_bad = is_bad || is_far(step) || !(length(step) > 1 / kFarthest);
    edges *= length(step);
  }
  if (is_bad)
    fail(ErrorKind::Malformed, source,
         "the distances between voxels or the origin are no sensible numbers; mend the header");
  const double volume = dot(p.steps[0], cross(p.steps[1], p.steps[2]));
  if (!(std::abs(volume) > kFlat * edges))
    fail(ErrorKind::Malformed, source,
         "the directions of its axes lie in one plane; mend the header");
}

std::string text_of(const std::array<std::uint64_t, 3>& dims) {
  return std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
         std::to_string(dims[2]);
}

void check_sizes(const Placement& p, std::uint64_t most_voxels, const Source& source) {
  constexpr auto kLongest = static_cast<std::uint64_t>(Volume::kLongestSide);
  // In doubles, which hold any product of three sizes near enough.
  double voxels = 1;
  for (const std::uint64_t n : p.dims) {
    if (n == 0)
      fail(ErrorKind::Malformed, source,
           "has " + text_of(p.dims) + " voxels; every side needs at least one");
    voxels *= static_cast<double>(n);
  }
  if (voxels > static_cast<double>(most_voxels))
    fail(ErrorKind::Malformed, source,
         "says that it has " + text_of(p.dims) +
             " voxels, but holds no values for so many; get a "
             "whole file or mend the sizes");
  const std::uint64_t longest = std::max({p.dims[0], p.dims[1], p.dims[2]});
  if (longest > kLongest)
    fail(ErrorKind::Limit, source,
         "has " + std::to_string(longest) + " voxels along a side, more than " +
             std::to_string(kLongest) + "; crop or coarsen it");
  const std::uint64_t row = (p.dims[0] + 63) / 64 * 64;
  const double in_memory =
      static_cast<double>(row) * static_cast<double>(p.dims[1]) * static_cast<double>(p.dims[2]);
  if (in_memory > static_cast<double>(source.options.max_voxels))
    fail(ErrorKind::Limit, source,
         "has " + text_of(p.dims) + " voxels, more than the limit of " +
             std::to_string(source.options.max_voxels) +
             " (a row counts as a multiple of 64); "
             "raise the limit, crop or coarsen it");
}

Volume parse(const Source& source, VolumeFormat format) {
  switch (format) {
    case VolumeFormat::Nrrd:
      return parse_nrrd(source);
    case VolumeFormat::Nifti:
      return parse_nifti(source);
    case VolumeFormat::Binvox:
      return parse_binvox(source);
    case VolumeFormat::Raw:
      return parse_raw(source);
  }
  throw Error(ErrorKind::Internal, "no such format of volumes");
}

}  // namespace

void fail(ErrorKind kind, const Source& source, const std::string& what) {
  text_detail::fail(kind, source.path, "", what);
}

Volume make_volume(const Placement& p, std::uint64_t most_voxels, const Source& source) {
  check_sizes(p, most_voxels, source);
  check_steps(p, source);
  Volume volume(static_cast<int>(p.dims[0]), static_cast<int>(p.dims[1]),
                static_cast<int>(p.dims[2]));
  volume.origin = p.origin;
  volume.steps = p.steps;
  return volume;
}

}  // namespace volume_detail

std::optional<VolumeFormat> volume_format_of(const std::string& path) {
  std::string extension = extension_of(path);
  if (extension == "nrrd" || extension == "nhdr") return VolumeFormat::Nrrd;
  if (extension == "binvox") return VolumeFormat::Binvox;
  // These two may be compressed as a whole.
  if (extension == "gz") extension = extension_of(path.substr(0, path.size() - 3));
  if (extension == "nii") return VolumeFormat::Nifti;
  if (extension == "raw") return VolumeFormat::Raw;
  return {};
}

Volume parse_volume(std::string_view bytes, VolumeFormat format, const std::string& path,
                    const VolumeOptions& options) {
  const volume_detail::Source source{bytes, path, options};
  if (bytes.empty()) volume_detail::fail(ErrorKind::Empty, source, "is empty (0 bytes)");
  try {
    return volume_detail::parse(source, format);
  } catch (const std::bad_alloc&) {
    volume_detail::fail(ErrorKind::Limit, source, "needs more memory than there is; coarsen it");
  } catch (const std::length_error&) {
    volume_detail::fail(ErrorKind::Limit, source, "needs more memory than there is; coarsen it");
  }
}

Volume read_volume(const std::string& path, const VolumeOptions& options) {
  const auto format = volume_format_of(path);
  if (!format)
    throw Error(ErrorKind::Unsupported,
                path + ": volumes are .nrrd .nhdr .nii .nii.gz .binvox .raw or .raw.gz files");
  return parse_volume(read_file(path, options.max_bytes), *format, path, options);
}

}  // namespace marrow

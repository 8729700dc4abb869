#include <marrow/error.hpp>

#include <array>
#include <cmath>
#include <optional>

#include "bytes_detail.hpp"
#include "volume_detail.hpp"

namespace marrow::volume_detail {

namespace {

constexpr std::size_t kHeaderBytes = 348;
constexpr std::int32_t kNifti2Bytes = 540;
constexpr double kNoCosine = 1e-7;  // what single precision leaves of a squared cosine of zero

/// The fields of the header, by their place in it.
class Header {
 public:
  explicit Header(const Source& source, bytes_detail::ByteStream& stream) {
    if (stream.read(bytes_) < kHeaderBytes)
      fail(ErrorKind::Malformed, source, "is shorter than a NIfTI header; get a whole file");
    if (at<std::int32_t>(0) != kHeaderBytes) order_ = std::endian::big;
    const auto size = at<std::int32_t>(0);
    order_ = size == kHeaderBytes ? order_ : std::endian::little;
    if (size != kHeaderBytes && at<std::int32_t>(0) == kNifti2Bytes)
      fail(ErrorKind::Unsupported, source, "is NIfTI-2; save it as NIfTI-1 or NRRD");
    const std::string_view magic(bytes_.data() + 344, 4);
    if (size == kHeaderBytes && magic == std::string_view("ni1\0", 4))
      fail(ErrorKind::Unsupported, source, "has its voxels in another file; save it as one .nii");
    if (size != kHeaderBytes || magic != std::string_view("n+1\0", 4))
      fail(ErrorKind::Malformed, source, "has no NIfTI-1 header; is it a .nii file?");
  }

  std::endian order() const { return order_; }

  template <class Number>
  Number at(std::size_t offset) const {
    const char* from = bytes_.data() + offset;
    return order_ == std::endian::little ? bytes_detail::load<Number, std::endian::little>(from)
                                         : bytes_detail::load<Number, std::endian::big>(from);
  }
  double real(std::size_t offset) const { return static_cast<double>(at<float>(offset)); }
  Vec3 vector(std::size_t offset) const {
    return {real(offset), real(offset + 4), real(offset + 8)};
  }

 private:
  std::array<char, kHeaderBytes> bytes_{};
  std::endian order_ = std::endian::little;
};

std::optional<VoxelType> type_of(int code) {
  switch (code) {
    case 2:
      return VoxelType::U8;
    case 4:
      return VoxelType::I16;
    case 8:
      return VoxelType::I32;
    case 16:
      return VoxelType::F32;
    case 64:
      return VoxelType::F64;
    case 256:
      return VoxelType::I8;
    case 512:
      return VoxelType::U16;
    case 768:
      return VoxelType::U32;
    case 1024:
      return VoxelType::I64;
    case 1280:
      return VoxelType::U64;
    default:
      return {};
  }
}

std::array<std::uint64_t, 3> dims_of(const Header& header, const Source& source) {
  const int axes = header.at<std::int16_t>(40);
  if (axes < 1 || axes > 7)
    fail(ErrorKind::Malformed, source,
         "has " + std::to_string(axes) + " axes, not 1 to 7; mend dim[0]");
  std::array<std::uint64_t, 3> dims{1, 1, 1};
  for (int i = 1; i <= axes; ++i) {
    const int n = header.at<std::int16_t>(40 + 2 * static_cast<std::size_t>(i));
    if (n < 1)
      fail(ErrorKind::Malformed, source,
           "has " + std::to_string(n) + " voxels along axis " + std::to_string(i) + "; mend dim[" +
               std::to_string(i) + "]");
    if (i > 3 && n > 1)
      fail(ErrorKind::Unsupported, source,
           "holds " + std::to_string(n) + " volumes along axis " + std::to_string(i) +
               "; save one of them alone");
    if (i <= 3) dims[static_cast<std::size_t>(i) - 1] = static_cast<std::uint64_t>(n);
  }
  return dims;
}

/// Columns of the rotation by the quaternion of the header, by spacing.
std::array<Vec3, 3> steps_by_quaternion(const Header& header) {
  Vec3 q = header.vector(256);
  const double rest = 1 - squared_length(q);
  if (rest < kNoCosine) q = normalized(q);  // half a turn, or too long
  const double a = rest < kNoCosine ? 0 : std::sqrt(rest);
  const auto [b, c, d] = q;
  const double handedness = header.real(76) < 0 ? -1 : 1;
  const Vec3 spacing = header.vector(80);
  return {Vec3{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)} * spacing.x,
          Vec3{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)} * spacing.y,
          Vec3{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b} *
              (spacing.z * handedness)};
}

Placement placement_of(const Header& header, const Source& source) {
  Placement p;
  p.dims = dims_of(header, source);
  const bool has_sform = header.at<std::int16_t>(254) > 0;
  const bool has_qform = header.at<std::int16_t>(252) > 0;
  if (has_sform) {
    for (std::size_t i = 0; i < 3; ++i)
      p.steps[i] = {header.real(280 + 4 * i), header.real(296 + 4 * i), header.real(312 + 4 * i)};
    p.origin = {header.real(292), header.real(308), header.real(324)};
  } else if (has_qform) {
    p.steps = steps_by_quaternion(header);
    p.origin = header.vector(268);
  } else {
    const Vec3 spacing = header.vector(80);
    p.steps = {Vec3{spacing.x, 0, 0}, Vec3{0, spacing.y, 0}, Vec3{0, 0, spacing.z}};
  }
  return p;
}

Samples samples_of(const Header& header, const Source& source) {
  const int code = header.at<std::int16_t>(70);
  const auto type = type_of(code);
  if (!type)
    fail(ErrorKind::Unsupported, source,
         "its values have data type " + std::to_string(code) +
             ", which are no single numbers of at most 64 bits; convert them");
  Samples samples{*type, header.order()};
  const double slope = header.real(112), intercept = header.real(116);
  // A slope of zero says that values are not scaled.
  if (std::isfinite(slope) && std::isfinite(intercept) && slope != 0)
    samples.slope = slope, samples.intercept = intercept;
  return samples;
}

}  // namespace

Volume parse_nifti(const Source& source) {
  bytes_detail::ByteStream stream(source.bytes, bytes_detail::is_gzip(source.bytes), source.path);
  const Header header(source, stream);
  const Samples samples = samples_of(header, source);
  const Placement placement = placement_of(header, source);
  const double offset = header.real(108);
  const bool has_offset = offset >= kHeaderBytes && offset < 0x1p40;
  if (!has_offset || !stream.skip(static_cast<std::uint64_t>(offset) - kHeaderBytes))
    fail(ErrorKind::Malformed, source,
         "its voxels begin where the file has none; mend vox_offset or get a whole file");
  Volume volume = make_volume(placement, stream.most_left() / bytes_of(samples.type), source);
  read_samples(volume, stream, samples, source);
  return volume;
}

}  // namespace marrow::volume_detail

// NIfTI-1, binvox and raw volumes.
#include <cstring>

#include "volume_bytes.hpp"

using namespace marrow;
using namespace marrow::test;

namespace {

constexpr auto kNifti = VolumeFormat::Nifti;

/// The header of a NIfTI-1 file, field by field.
class NiftiHeader {
 public:
  explicit NiftiHeader(std::endian order = std::endian::little) : order_(order) {
    put(0, std::int32_t{348});
    put(40, std::int16_t{3});
    for (const std::size_t i : {42, 44, 46}) put(i, std::int16_t{2});
    put(70, std::int16_t{2});  // uint8
    for (const std::size_t i : {76, 80, 84, 88}) put(i, 1.0f);
    put(108, 352.0f);
    std::memcpy(bytes_.data() + 344, "n+1", 4);
  }

  template <class Number>
  NiftiHeader& put(std::size_t offset, Number value) {
    bytes_.replace(offset, sizeof value, bytes_of(value, order_));
    return *this;
  }
  NiftiHeader& magic(const char* words) {
    std::memcpy(bytes_.data() + 344, words, 4);
    return *this;
  }
  std::string with(const std::string& values) const { return bytes_ + values; }

 private:
  std::string bytes_ = std::string(352, '\0');
  std::endian order_;
};

const std::string kEight("\0\1\0\1\0\1\0\1", 8);

Volume parse(const std::string& bytes, double iso = 0) {
  VolumeOptions options;
  options.iso = iso;
  return parse_volume(bytes, kNifti, "file", options);
}

void check_near(const Vec3& a, const Vec3& b) {
  INFO(a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z);
  CHECK(distance(a, b) < 1e-6);
}

}  // namespace

TEST_CASE("NIfTI values of any type and byte order", "[volume][nifti]") {
  const std::vector<double> values{0, 1, 2, 3, 0, 5, 0, 7};
  for (const auto order : {std::endian::little, std::endian::big}) {
    const auto check = [&](int code, const std::string& raw) {
      INFO("type " << code);
      const std::string bytes =
          NiftiHeader(order).put(70, static_cast<std::int16_t>(code)).with(raw);
      CHECK(flags_of(parse(bytes, 1)) == "00110101");
      CHECK(flags_of(parse(gzip(bytes), 1)) == "00110101");
    };
    check(2, bytes_of<std::uint8_t>(values, order));
    check(4, bytes_of<std::int16_t>(values, order));
    check(8, bytes_of<std::int32_t>(values, order));
    check(16, bytes_of<float>(values, order));
    check(64, bytes_of<double>(values, order));
    check(256, bytes_of<std::int8_t>(values, order));
    check(512, bytes_of<std::uint16_t>(values, order));
    check(768, bytes_of<std::uint32_t>(values, order));
    check(1024, bytes_of<std::int64_t>(values, order));
    check(1280, bytes_of<std::uint64_t>(values, order));
  }
}

TEST_CASE("NIfTI values are scaled before they are compared", "[volume][nifti]") {
  const std::string bytes = NiftiHeader().put(112, -2.0f).put(116, 1.0f).with(kEight);
  CHECK(flags_of(parse(bytes)) == "10101010");  // 1 and -1
  CHECK(flags_of(parse(bytes, 1)) == "00000000");
  CHECK(flags_of(parse(NiftiHeader().put(112, 0.0f).put(116, 9.0f).with(kEight))) == "01010101");
}

TEST_CASE("NIfTI positions", "[volume][nifti]") {
  NiftiHeader header;
  header.put(80, 2.0f).put(84, 3.0f).put(88, 4.0f);
  check_near(parse(header.with(kEight)).to_world({1, 1, 1}), {2, 3, 4});
  // A quarter turn about z, and an offset: x goes to y, y to -x.
  const float half = 0.70710678f;
  header.put(252, std::int16_t{1}).put(264, half).put(268, 10.0f).put(272, 20.0f).put(276, 30.0f);
  const Volume turned = parse(header.with(kEight));
  check_near(turned.to_world({0, 0, 0}), {10, 20, 30});
  check_near(turned.to_world({1, 0, 0}), {10, 22, 30});
  check_near(turned.to_world({0, 1, 1}), {7, 20, 34});
  // Of a quaternion that is too long only the direction counts.
  const Volume half_turn = parse(NiftiHeader(header).put(264, 5.0f).with(kEight));
  check_near(half_turn.to_world({1, 1, 1}), {8, 17, 34});
  header.put(76, -1.0f);  // left-handed
  check_near(parse(header.with(kEight)).to_world({0, 1, 1}), {7, 20, 26});
  // The affine wins.
  header.put(254, std::int16_t{2});
  const float rows[3][4] = {{0, 0, 5, -1}, {6, 0, 0, -2}, {0, 7, 1, -3}};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c) header.put(280 + 16 * r + 4 * c, rows[r][c]);
  check_near(parse(header.with(kEight)).to_world({1, 2, 3}), {14, 4, 14});
}

TEST_CASE("NIfTI files with mistakes are refused", "[volume][nifti]") {
  const auto refused = [](const NiftiHeader& header, ErrorKind kind, std::string_view part) {
    check_refused(header.with(kEight), kNifti, kind, part);
  };
  CHECK_NOTHROW(parse(NiftiHeader().with(kEight)));
  check_refused(NiftiHeader().with(kEight).substr(0, 300), kNifti, ErrorKind::Malformed, "shorter");
  const std::string packed = gzip(NiftiHeader().with(kEight));
  for (const std::size_t left : {packed.size() - 1, packed.size() / 2})
    check_refused(packed.substr(0, left), kNifti, ErrorKind::Malformed, "cut off");
  refused(NiftiHeader().put(0, std::int32_t{347}), ErrorKind::Malformed, "no NIfTI-1");
  refused(NiftiHeader().put(0, std::int32_t{540}), ErrorKind::Unsupported, "NIfTI-2");
  refused(NiftiHeader().magic("ni1"), ErrorKind::Unsupported, "another file");
  refused(NiftiHeader().magic("abc"), ErrorKind::Malformed, "no NIfTI-1");
  refused(NiftiHeader().put(40, std::int16_t{0}), ErrorKind::Malformed, "dim[0]");
  refused(NiftiHeader().put(40, std::int16_t{8}), ErrorKind::Malformed, "dim[0]");
  refused(NiftiHeader().put(42, std::int16_t{-5}), ErrorKind::Malformed, "dim[1]");
  refused(NiftiHeader().put(42, std::int16_t{32767}), ErrorKind::Malformed, "holds no values");
  refused(NiftiHeader().put(40, std::int16_t{4}).put(48, std::int16_t{3}), ErrorKind::Unsupported,
          "volumes along axis 4");
  CHECK_NOTHROW(
      parse(NiftiHeader().put(40, std::int16_t{4}).put(48, std::int16_t{1}).with(kEight)));
  refused(NiftiHeader().put(70, std::int16_t{128}), ErrorKind::Unsupported, "data type 128");
  for (const float offset : {0.0f, 347.0f, 361.0f, 1e30f, -1e30f, std::nanf("")})
    refused(NiftiHeader().put(108, offset), ErrorKind::Malformed, "");
  refused(NiftiHeader().put(84, 0.0f), ErrorKind::Malformed, "no sensible numbers");
  refused(NiftiHeader().put(84, std::nanf("")), ErrorKind::Malformed, "no sensible numbers");
  refused(NiftiHeader().put(254, std::int16_t{1}), ErrorKind::Malformed, "no sensible numbers");
}

TEST_CASE("binvox volumes", "[volume][binvox]") {
  const auto file = [](const std::string& lines, const std::string& runs) {
    return "#binvox 1\n" + lines + "data\n" + runs;
  };
  const auto parse_binvox = [](const std::string& bytes) {
    return parse_volume(bytes, VolumeFormat::Binvox, "file");
  };
  // y runs fastest, then z, then x.
  const std::string lines = "dim 2 2 2\ntranslate -1 -2 -3\nscale 4\n";
  const Volume v = parse_binvox(file(lines, std::string("\0\1\1\1\0\2\0\3\1\1", 10)));
  CHECK(v(1, 0, 0));  // the second voxel: one step along y
  check_near(v.to_world({0, 0, 0}), {0, -1, -2});
  check_near(v.to_world({1, 0, 0}), {0, 1, -2});
  check_near(v.to_world({0, 1, 0}), {0, -1, 0});
  check_near(v.to_world({0, 0, 1}), {2, -1, -2});
  CHECK(flags_of(v) == "01000001");
  const auto refused = [&](const std::string& bytes, std::string_view part) {
    check_refused(bytes, VolumeFormat::Binvox, ErrorKind::Malformed, part);
  };
  refused("#bin", "#binvox");
  refused("#binvox 1\ndim 2 2 2\n", "'data'");
  refused(file("dim 2 2\n", "\1\10"), "file:2:");
  refused(file("dim 2 2 2\ntranslate 1 2\n", "\1\10"), "file:3:");
  refused(file("dim 2 2 2\n", "\1\7"), "end early");
  refused(file("dim 2 2 2\n", "\1\11"), "longer");
  refused(file("dim 2000 2000 2000\n", "\1\7"), "holds no values");
  refused(file("dim 2 2 2\nscale 0\n", "\1\10"), "no sensible numbers");
  refused(file("", "\1\10"), "at least one");
}

TEST_CASE("raw volumes", "[volume][raw]") {
  VolumeOptions options;
  options.dims = {2, 1, 2};
  options.type = VoxelType::I16;
  options.order = std::endian::big;
  options.spacing = {1, 2, 3};
  const std::string bytes = bytes_of<std::int16_t>({1, -1, 0, 256}, std::endian::big);
  for (const std::string& file : {bytes, gzip(bytes)}) {
    const Volume v = parse_volume(file, VolumeFormat::Raw, "file", options);
    CHECK(flags_of(v) == "1001");
    CHECK(v.to_world({1, 1, 1}) == Vec3{1, 2, 3});
    check_refused(file.substr(0, file.size() - 1), VolumeFormat::Raw, ErrorKind::Malformed, "",
                  options);
  }
  check_refused(bytes + "x", VolumeFormat::Raw, ErrorKind::Malformed, "more bytes", options);
  check_refused(gzip(bytes + "x"), VolumeFormat::Raw, ErrorKind::Malformed, "more bytes", options);
  check_refused(bytes, VolumeFormat::Raw, ErrorKind::Usage, "--dims");
  options.spacing.y = 0;
  check_refused(bytes, VolumeFormat::Raw, ErrorKind::Malformed, "no sensible numbers", options);
}

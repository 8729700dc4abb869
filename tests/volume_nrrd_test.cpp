#include <marrow/volume_io.hpp>

#include <filesystem>
#include <fstream>
#include <limits>

#include "random.hpp"
#include "volume_bytes.hpp"

using namespace marrow;
using namespace marrow::test;
namespace fs = std::filesystem;

namespace {

constexpr auto kNrrd = VolumeFormat::Nrrd;

std::string header(const std::string& fields) { return "NRRD0004\ndimension: 3\n" + fields + "\n"; }

/// A volume of 2 x 2 x 2 with the values 0, 1, 0, 1 ...
std::string small(const std::string& fields = "") {
  return header("type: uint8\nsizes: 2 2 2\nencoding: raw\n" + fields) +
         std::string("\0\1\0\1\0\1\0\1", 8);
}

Volume parse(const std::string& bytes, const VolumeOptions& options = {}) {
  return parse_volume(bytes, kNrrd, "file", options);
}

/// An empty folder that goes away with all that is in it.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "marrow-nrrd-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ + "/" + name, std::ios::binary) << bytes;
    return path_ + "/" + name;
  }

 private:
  std::string path_;
};

template <class Number>
void check_type(const std::string& name, bool is_signed) {
  for (const auto order : {std::endian::little, std::endian::big})
    for (const bool is_compressed : {false, true}) {
      // More than a word in a row, and not a multiple of it.
      std::vector<double> values;
      std::string expected;
      for (int i = 0; i < 70 * 3 * 2; ++i) {
        const double v = i % 7 == 0 ? 100 : i % 5 == 0 && is_signed ? -3 : i % 3;
        values.push_back(v);
        expected += v > 1 ? '1' : '0';
      }
      const std::string raw = bytes_of<Number>(values, order);
      const std::string bytes =
          header("type: " + name +
                 "\nsizes: 70 3 2\nencoding: " + (is_compressed ? "gzip" : "raw") +
                 "\nendian: " + (order == std::endian::big ? "big" : "little") + "\n") +
          (is_compressed ? gzip(raw) : raw);
      VolumeOptions options;
      options.iso = 1;
      INFO(name << (order == std::endian::big ? " big" : " little"));
      CHECK(flags_of(parse(bytes, options)) == expected);
    }
}

}  // namespace

TEST_CASE("NRRD values of any type and byte order", "[volume][nrrd]") {
  check_type<std::uint8_t>("uchar", false);
  check_type<std::int8_t>("signed char", true);
  check_type<std::uint16_t>("unsigned short", false);
  check_type<std::int16_t>("int16", true);
  check_type<std::uint32_t>("uint", false);
  check_type<std::int32_t>("int", true);
  check_type<std::uint64_t>("unsigned long long int", false);
  check_type<std::int64_t>("int64_t", true);
  check_type<float>("float", true);
  check_type<double>("double", true);
}

TEST_CASE("The iso value parts numbers exactly", "[volume][nrrd]") {
  const auto flags = [](const std::string& type, const std::string& value, double iso) {
    VolumeOptions options;
    options.iso = iso;
    return flags_of(parse(header("type: " + type +
                                 "\nsizes: 1 1 1\nencoding: raw\n"
                                 "endian: little\n") +
                              value,
                          options));
  };
  const double huge = 0x1p63;
  CHECK(flags("uint8", bytes_of(std::uint8_t{255}), 254.5) == "1");
  CHECK(flags("uint8", bytes_of(std::uint8_t{255}), 255) == "0");
  CHECK(flags("uint8", bytes_of(std::uint8_t{255}), 1e300) == "0");
  CHECK(flags("uint8", bytes_of(std::uint8_t{0}), -0.5) == "1");
  CHECK(flags("int16", bytes_of(std::int16_t{-32768}), -32768) == "0");
  CHECK(flags("int16", bytes_of(std::int16_t{-32768}), -32768.5) == "1");
  CHECK(flags("int64", bytes_of(std::numeric_limits<std::int64_t>::max()), huge) == "0");
  CHECK(flags("int64", bytes_of((std::int64_t{1} << 53) + 1), 0x1p53) == "1");
  CHECK(flags("uint64", bytes_of(~std::uint64_t{0}), huge) == "1");
  CHECK(flags("uint64", bytes_of(~std::uint64_t{0}), 0x1p64) == "0");
  CHECK(flags("float", bytes_of(0.1f), 0.1) == "1");  // the nearest float is a little more
  CHECK(flags("float", bytes_of(std::numeric_limits<float>::quiet_NaN()), -1) == "0");
  CHECK(flags("double", bytes_of(std::numeric_limits<double>::infinity()), 1e300) == "1");
}

TEST_CASE("NRRD positions", "[volume][nrrd]") {
  const Volume plain = parse(small());
  CHECK(plain.to_world({1, 1, 1}) == Vec3{1, 1, 1});
  const Volume spaced = parse(small("spacings: 2 0.5 nan\n"));
  CHECK(spaced.to_world({1, 1, 1}) == Vec3{2, 0.5, 1});
  const Volume turned =
      parse(small("space: left-posterior-superior\nspacings: 9 9 9\nspace directions: (0,2,0) "
                  "( -3, 0, 0 ) (0,0,1e-1)\nspace origin: (10,20,30)\n"));
  CHECK(turned.to_world({0, 0, 0}) == Vec3{10, 20, 30});
  CHECK(turned.to_world({1, 1, 1}) == Vec3{7, 22, 30.1});
}

TEST_CASE("NRRD axes of one place are left out", "[volume][nrrd]") {
  const std::string values(24, '\1');
  const Volume v = parse(
      "NRRD0005\n# a comment\nkey:=value: 3\ntype: uint8\ndimension: 4\n"
      "sizes: 1 2 3 4\nspace dimension: 3\nspace directions: none (1,0,0) "
      "(0,2,0) (0,0,3)\nencoding: raw\n\n" +
      values);
  CHECK(v.nx == 2);
  CHECK(v.ny == 3);
  CHECK(v.nz == 4);
  CHECK(v.to_world({1, 1, 1}) == Vec3{1, 2, 3});
  check_refused("NRRD0004\ntype: uint8\ndimension: 4\nsizes: 3 2 2 2\nencoding: raw\n\n" + values,
                kNrrd, ErrorKind::Unsupported, "4 axes");
  check_refused("NRRD0004\ntype: uint8\ndimension: 2\nsizes: 3 8\nencoding: raw\n\n" + values,
                kNrrd, ErrorKind::Unsupported, "2 axes");
}

TEST_CASE("NRRD skips and text", "[volume][nrrd]") {
  const std::string fields = "type: uint8\nsizes: 2 1 1\n";
  CHECK(flags_of(parse(header(fields + "encoding: raw\nline skip: 2\nbyteskip: 1\n") +
                       "one\ntwo\n#" + std::string("\1\0", 2))) == "10");
  CHECK(flags_of(parse(header(fields + "encoding: raw\nbyte skip: -1\n") + "any thing" +
                       std::string("\0\1", 2))) == "01");
  CHECK(flags_of(parse(header(fields + "encoding: gz\nbyte skip: 3\n") +
                       gzip(std::string("abc\1\0", 5)))) == "10");
  CHECK(flags_of(parse(header(fields + "encoding: ascii\n") + "0\n 7\n")) == "01");
  check_refused(header(fields + "encoding: text\n") + "0 x", kNrrd, ErrorKind::Malformed, "'x'");
  check_refused(header(fields + "encoding: text\n") + "0  ", kNrrd, ErrorKind::Malformed,
                "1 values less");
  check_refused(header(fields + "encoding: raw\nline skip: 9\n") + "a\nb", kNrrd,
                ErrorKind::Malformed, "line skip");
  check_refused(header(fields + "encoding: raw\nbyte skip: 9\n") + "ab", kNrrd,
                ErrorKind::Malformed, "byte skip");
  check_refused(header(fields + "encoding: gzip\nbyte skip: -1\n") + "ab", kNrrd,
                ErrorKind::Malformed, "-1");
}

TEST_CASE("Compressed values may come in several members", "[volume][nrrd]") {
  const std::string fields = "type: uint8\nsizes: 3 1 1\nencoding: gzip\n";
  CHECK(flags_of(parse(header(fields) + gzip(std::string("\1\0", 2)) + gzip("\1"))) == "101");
}

TEST_CASE("Damaged compressed values are refused", "[volume][nrrd]") {
  Random random(5);
  std::string values;
  for (int i = 0; i < 32 * 32 * 32; ++i) values += static_cast<char>(random.below(256));
  const std::string fields = header("type: uint8\nsizes: 32 32 32\nencoding: gzip\n");
  const std::string packed = gzip(values);
  CHECK_NOTHROW(parse(fields + packed));
  // Cut off, down to a missing byte of the checksum at the end.
  for (const std::size_t left :
       {packed.size() - 1, packed.size() - 9, packed.size() / 2, std::size_t{12}, std::size_t{1}})
    check_refused(fields + packed.substr(0, left), kNrrd, ErrorKind::Malformed,
                  left > packed.size() / 3 ? "cut off" : "");
  std::string wrong = packed;
  wrong[wrong.size() - 6] ^= 1;  // the checksum
  check_refused(fields + wrong, kNrrd, ErrorKind::Malformed, "broken");
  check_refused(fields + "no gzip at all, and long enough for it to be seen by zlib........", kNrrd,
                ErrorKind::Malformed, "");
  // Too few values, whole.
  check_refused(fields + gzip(values.substr(5)), kNrrd, ErrorKind::Malformed, "fewer values");
}

TEST_CASE("NRRD headers that lie are refused before anything is allocated", "[volume][nrrd]") {
  const auto raw = [](const std::string& sizes) {
    return header("type: uint8\nsizes: " + sizes + "\nencoding: raw\n") + "12345678";
  };
  const auto packed = [](const std::string& sizes) {
    return header("type: uint8\nsizes: " + sizes + "\nencoding: gzip\n") + gzip("12345678");
  };
  check_refused(raw("100000 100000 100000"), kNrrd, ErrorKind::Malformed, "holds no values");
  check_refused(packed("100000 100000 100000"), kNrrd, ErrorKind::Malformed, "holds no values");
  check_refused(raw("18446744073709551615 18446744073709551615 2"), kNrrd, ErrorKind::Malformed,
                "holds no values");
  check_refused(raw("18446744073709551616 1 1"), kNrrd, ErrorKind::Malformed, "3 numbers");
  check_refused(raw("3 3 1"), kNrrd, ErrorKind::Malformed, "holds no values");
  check_refused(raw("0 3 1"), kNrrd, ErrorKind::Malformed, "at least one");
  check_refused(raw("-1 3 1"), kNrrd, ErrorKind::Malformed, "3 numbers");
  check_refused(raw("2 2"), kNrrd, ErrorKind::Malformed, "3 numbers");
  VolumeOptions options;
  options.max_voxels = 100;  // of rows of 64
  check_refused(raw("2 2 1"), kNrrd, ErrorKind::Limit, "limit of 100", options);
  options.max_voxels = 128;
  CHECK_NOTHROW(parse(raw("2 2 1"), options));
  const std::string row(20000, '\1');
  check_refused(header("type: uint8\nsizes: 20000 1 1\nencoding: raw\n") + row, kNrrd,
                ErrorKind::Limit, "16384");
}

TEST_CASE("NRRD headers with mistakes are refused by line", "[volume][nrrd]") {
  check_refused("NRRD", kNrrd, ErrorKind::Malformed, "NRRD000");
  check_refused("", kNrrd, ErrorKind::Empty, "empty");
  check_refused(header("sizes: 2 2 2\nencoding: raw\n"), kNrrd, ErrorKind::Malformed, "'type'");
  check_refused(header("type: uint16\nsizes: 2 2 2\nencoding: raw\n") + std::string(16, '\1'),
                kNrrd, ErrorKind::Malformed, "'endian'");
  check_refused(header("type: block\nsizes: 2 2 2\nencoding: raw\n"), kNrrd, ErrorKind::Unsupported,
                "file:3:");
  check_refused(header("type: uint8\nsizes: 2 2 2\nencoding: bzip2\n"), kNrrd,
                ErrorKind::Unsupported, "'bzip2'");
  check_refused(small("type: int8\n"), kNrrd, ErrorKind::Malformed, "twice");
  check_refused(small("no colon\n"), kNrrd, ErrorKind::Malformed, "file:6:");
  check_refused(small("spacings: 1 0 1\n"), kNrrd, ErrorKind::Malformed, "no sensible numbers");
  check_refused(small("spacings: 1 inf 1\n"), kNrrd, ErrorKind::Malformed, "no sensible numbers");
  check_refused(small("space origin: (nan,0,0)\n"), kNrrd, ErrorKind::Malformed,
                "no sensible numbers");
  check_refused(small("space origin: (0,0)\n"), kNrrd, ErrorKind::Malformed, "file:6:");
  check_refused(small("space directions: (1,0,0) (0,1,0) (1,1,0)\n"), kNrrd, ErrorKind::Malformed,
                "one plane");
  check_refused(small("space directions: (1,0,0) (0,1,0)\n"), kNrrd, ErrorKind::Malformed,
                "file:6:");
  check_refused(small("space directions: none (1,0,0) (0,1,0)\n"), kNrrd, ErrorKind::Malformed,
                "no direction");
  check_refused("NRRD0004\ntype: uint8\nencoding: raw\ndimension: 99\n\n", kNrrd,
                ErrorKind::Malformed, "1 to 16");
}

TEST_CASE("A detached data file lies beside its header, or is not opened", "[volume][nrrd]") {
  const Folder folder;
  const std::string fields = header("type: uint8\nsizes: 2 1 1\nencoding: raw\n");
  const auto with = [&](const std::string& name) {
    return folder.write("a.nhdr", fields.substr(0, fields.size() - 1) + "data file: " + name);
  };
  folder.write("a.raw", std::string("\1\0", 2));
  fs::create_directory(fs::path(folder.write("x", "")).parent_path() / "sub");
  folder.write("sub/b.raw", std::string("\1\0", 2));
  CHECK(flags_of(read_volume(with("a.raw"))) == "10");
  CHECK(flags_of(read_volume(with("./a.raw"))) == "10");

  const auto kind_of = [&](const std::string& name) {
    try {
      read_volume(with(name));
      return ErrorKind::Internal;
    } catch (const Error& e) {
      CHECK(std::string(e.what()).find('\n') == std::string::npos);
      return e.kind();
    }
  };
  for (const char* name : {"sub/b.raw", "../a.raw", "..", ".", "", "/etc/passwd", "./sub/b.raw",
                           "a\\b.raw", "LIST", "a%03d.raw 1 2 1", "a\1raw"})
    CHECK(kind_of(name) == ErrorKind::Unsupported);
  CHECK(kind_of("none.raw") == ErrorKind::CannotRead);
  CHECK(kind_of("-") == ErrorKind::CannotRead);  // no standard input
  CHECK(kind_of("sub") == ErrorKind::CannotRead);
}

TEST_CASE("What is written reads back", "[volume][nrrd]") {
  Random random(3);
  Volume v(70, 5, 4);
  for (int z = 0; z < v.nz; ++z)
    for (int y = 0; y < v.ny; ++y)
      for (int x = 0; x < v.nx; ++x)
        if (random.below(3) == 0) v.set(x, y, z);
  v.origin = {0.1, -2e-7, 1e20};
  v.steps = {Vec3{0.1, 0, 0.3}, Vec3{0, -1, 0}, Vec3{0, 0.2, 1.0 / 3}};
  CHECK(parse(format_nrrd(v)) == v);
}

TEST_CASE("The end of a name tells the format", "[volume]") {
  CHECK(volume_format_of("a.nrrd") == VolumeFormat::Nrrd);
  CHECK(volume_format_of("a/b.NHDR") == VolumeFormat::Nrrd);
  CHECK(volume_format_of("a.nii.gz") == VolumeFormat::Nifti);
  CHECK(volume_format_of("a.nii") == VolumeFormat::Nifti);
  CHECK(volume_format_of("a.raw.gz") == VolumeFormat::Raw);
  CHECK(volume_format_of("a.binvox") == VolumeFormat::Binvox);
  for (const char* name : {"a.gz", "a.obj", "nrrd", "a.nrrd.gz", "a.nii.gz.gz", ".gz", ""})
    CHECK_FALSE(volume_format_of(name));
}

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "bytes_detail.hpp"
#include "text_detail.hpp"
#include "volume_detail.hpp"

namespace marrow::volume_detail {

namespace {

constexpr std::size_t kPiece = std::size_t{1}
                               << 18;  // bytes read at once; whole values of any type

/// One bit each of 64 bytes that are 0 or 1.
Volume::Word packed(const std::array<std::uint8_t, 64>& flags) {
  Volume::Word word = 0;
  for (std::size_t i = 0; i < 64; i += 8) {
    const auto eight = bytes_detail::load<std::uint64_t, std::endian::little>(
        reinterpret_cast<const char*>(flags.data()) + i);
    // Byte k is moved to bit 56 + k; no two of the products meet.
    word |= (eight * 0x0102040810204080u >> 56) << i;
  }
  return word;
}

/// Values greater than `iso`. Of integers only the floor of it counts, exactly.
template <class Number>
class Above {
 public:
  explicit Above(double iso) : iso_(iso) {
    if constexpr (std::is_integral_v<Number>) {
      const double floor = std::floor(iso);
      constexpr Number kLeast = std::numeric_limits<Number>::min();
      constexpr Number kMost = std::numeric_limits<Number>::max();
      if (floor < static_cast<double>(kLeast)) all_ = 1;
      // The greatest value as a double may be one more than it is.
      else if (!(floor < static_cast<double>(kMost)))
        floor_ = kMost;
      else
        floor_ = static_cast<Number>(floor);
    }
  }

  std::uint8_t operator()(Number value) const {
    if constexpr (std::is_integral_v<Number>)
      return static_cast<std::uint8_t>(value > floor_) | all_;
    else
      return static_cast<double>(value) > iso_;
  }

 private:
  double iso_;
  Number floor_{};
  std::uint8_t all_ = 0;
};

/// The same of scaled values.
template <class Number>
struct ScaledAbove {
  double slope, intercept, iso;

  std::uint8_t operator()(Number value) const {
    return static_cast<double>(value) * slope + intercept > iso;
  }
};

template <class Number, std::endian order, class Test>
void write_flags(FlagWriter& writer, const char* at, std::size_t count, const Test& test) {
  while (count > 0) {
    const auto n = std::min({count, std::size_t{64}, static_cast<std::size_t>(writer.room())});
    std::array<std::uint8_t, 64> flags{};
    if (n == 64) {
      for (std::size_t i = 0; i < 64; ++i)
        flags[i] = test(bytes_detail::load<Number, order>(at + i * sizeof(Number)));
    } else {
      for (std::size_t i = 0; i < n; ++i)
        flags[i] = test(bytes_detail::load<Number, order>(at + i * sizeof(Number)));
    }
    writer.put(packed(flags), static_cast<int>(n));
    at += n * sizeof(Number);
    count -= n;
  }
}

template <class Number, std::endian order, class Test>
void read_with(Volume& volume, bytes_detail::ByteStream& stream, const Source& source,
               const Test& test) {
  FlagWriter writer(volume);
  const auto next = [&] {
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(kPiece, writer.left() * sizeof(Number)));
  };
  std::vector<char> piece(next());
  while (writer.left() > 0) {
    const std::size_t want = next();
    if (stream.read(std::span(piece).first(want)) < want)
      fail(ErrorKind::Malformed, source,
           "holds fewer values than it has voxels; " + std::to_string(writer.left()) +
               " or a few less are missing, get a whole file or mend the sizes");
    write_flags<Number, order>(writer, piece.data(), want / sizeof(Number), test);
  }
}

template <class Number, std::endian order>
void read_as(Volume& volume, bytes_detail::ByteStream& stream, const Samples& samples,
             const Source& source) {
  const double iso = source.options.iso;
  if (samples.slope == 1 && samples.intercept == 0)
    read_with<Number, order>(volume, stream, source, Above<Number>(iso));
  else
    read_with<Number, order>(volume, stream, source,
                             ScaledAbove<Number>{samples.slope, samples.intercept, iso});
}

template <class Number>
void read_any_order(Volume& volume, bytes_detail::ByteStream& stream, const Samples& samples,
                    const Source& source) {
  if (samples.order == std::endian::little)
    read_as<Number, std::endian::little>(volume, stream, samples, source);
  else
    read_as<Number, std::endian::big>(volume, stream, samples, source);
}

void read_any_type(Volume& volume, bytes_detail::ByteStream& stream, const Samples& samples,
                   const Source& source) {
  switch (samples.type) {
    case VoxelType::U8:
      return read_any_order<std::uint8_t>(volume, stream, samples, source);
    case VoxelType::I8:
      return read_any_order<std::int8_t>(volume, stream, samples, source);
    case VoxelType::U16:
      return read_any_order<std::uint16_t>(volume, stream, samples, source);
    case VoxelType::I16:
      return read_any_order<std::int16_t>(volume, stream, samples, source);
    case VoxelType::U32:
      return read_any_order<std::uint32_t>(volume, stream, samples, source);
    case VoxelType::I32:
      return read_any_order<std::int32_t>(volume, stream, samples, source);
    case VoxelType::U64:
      return read_any_order<std::uint64_t>(volume, stream, samples, source);
    case VoxelType::I64:
      return read_any_order<std::int64_t>(volume, stream, samples, source);
    case VoxelType::F32:
      return read_any_order<float>(volume, stream, samples, source);
    case VoxelType::F64:
      return read_any_order<double>(volume, stream, samples, source);
  }
}

}  // namespace

std::uint64_t bytes_of(VoxelType type) {
  switch (type) {
    case VoxelType::U8:
    case VoxelType::I8:
      return 1;
    case VoxelType::U16:
    case VoxelType::I16:
      return 2;
    case VoxelType::U32:
    case VoxelType::I32:
    case VoxelType::F32:
      return 4;
    case VoxelType::U64:
    case VoxelType::I64:
    case VoxelType::F64:
      return 8;
  }
  return 1;
}

void FlagWriter::put_run(bool flag, std::uint64_t count) {
  while (count > 0) {
    const int n =
        static_cast<int>(std::min({count, std::uint64_t{64}, static_cast<std::uint64_t>(room())}));
    put(flag ? ~Volume::Word{0} >> (64 - n) : 0, n);
    count -= static_cast<std::uint64_t>(n);
  }
}

bool read_samples(Volume& volume, bytes_detail::ByteStream& stream, const Samples& samples,
                  const Source& source) {
  read_any_type(volume, stream, samples, source);
  // Behind the last value compressed data have their checksum.
  std::array<char, 1> more{};
  return stream.read(more) > 0;
}

}  // namespace marrow::volume_detail

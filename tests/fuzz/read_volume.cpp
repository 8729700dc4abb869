// Bytes as a file of a volume in MARROW_FUZZ_FORMAT: a volume, which reads back the same after it
// is written, or one clean error.
#include <marrow/volume_io.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "expect.hpp"

using namespace marrow;

namespace {

constexpr VolumeFormat kFormat = VolumeFormat::MARROW_FUZZ_FORMAT;

std::optional<Volume> read(std::string_view bytes, VolumeFormat format) {
  VolumeOptions options;
  options.dims = {5, 3, 2};
  options.max_voxels = 1 << 14;  // what is read is written again, voxel by voxel
  options.max_bytes = 1 << 20;
  try {
    return parse_volume(bytes, format, "file", options);
  } catch (const Error& e) {
    // A detached data file is looked for in the folder that the fuzzer runs in.
    if (e.kind() != ErrorKind::CannotRead) fuzz::expect_clean(e);
    return {};
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto volume = read({reinterpret_cast<const char*>(data), size}, kFormat);
  if (!volume) return 0;
  fuzz::expect(read(format_nrrd(*volume), VolumeFormat::Nrrd) == volume,
               "a written volume reads back the same");
  return 0;
}

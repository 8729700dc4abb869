// Bytes as a file of a curve-skeleton in MARROW_FUZZ_FORMAT: a valid skeleton, which reads back the
// same after it is written, or one clean error.
#include <marrow/skeleton_io.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "../skeleton_faults.hpp"
#include "expect.hpp"

using namespace marrow;

namespace {

constexpr SkeletonFormat kFormat = SkeletonFormat::MARROW_FUZZ_FORMAT;

std::optional<CurveSkeleton> read(std::string_view bytes) {
  try {
    return parse_skeleton(bytes, kFormat, "file");
  } catch (const Error& e) {
    fuzz::expect_clean(e);
    return {};
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto skeleton = read({reinterpret_cast<const char*>(data), size});
  if (!skeleton) return 0;
  const std::string fault = test::fault_of(*skeleton);
  fuzz::expect(fault.empty(), fault);
  fuzz::expect(read(format_skeleton(*skeleton, kFormat)) == skeleton,
               "a written skeleton reads back the same");
  return 0;
}

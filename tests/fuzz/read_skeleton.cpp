// Bytes as a file of a curve-skeleton in MARROW_FUZZ_FORMAT: a valid skeleton, which reads back the
// same after it is written, as far as the format keeps the order of nodes, or one clean error.
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
    return parse_skeleton(bytes, kFormat, "file", 1);
  } catch (const Error& e) {
    fuzz::expect_clean(e);
    return {};
  }
}

void check_way_back(const CurveSkeleton& skeleton) {
  const std::string text = format_skeleton(skeleton, kFormat);
  const auto back = read(text);
  if (kFormat == SkeletonFormat::Swc)
    fuzz::expect(back && format_skeleton(*back, kFormat) == text,
                 "a tree is written the same again");
  else if (kFormat == SkeletonFormat::Polylines)
    fuzz::expect(back && back->nodes.size() == skeleton.nodes.size() &&
                     back->edges.size() == skeleton.edges.size(),
                 "written polylines read back with all nodes and edges");
  else
    fuzz::expect(back == skeleton, "a written skeleton reads back the same");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto skeleton = read({reinterpret_cast<const char*>(data), size});
  if (!skeleton) return 0;
  const std::string fault = test::fault_of(*skeleton);
  fuzz::expect(fault.empty(), fault);
  check_way_back(*skeleton);
  return 0;
}

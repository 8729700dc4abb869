#include <marrow/error.hpp>
#include <marrow/simd.hpp>

#include <algorithm>

#include "catch.hpp"

using namespace marrow;

TEST_CASE("simd: every instruction set that there is can be chosen") {
  const std::vector<std::string> names = simd_targets();
  REQUIRE_FALSE(names.empty());
  for (const std::string& name : names) {
    CHECK(std::count(names.begin(), names.end(), name) == 1);
    CHECK_NOTHROW(set_simd_target(name));
    CHECK(simd_targets() == names);
  }
  CHECK_NOTHROW(set_simd_target(""));
}

TEST_CASE("simd: one that there is not is refused, with the names of those that there are") {
  try {
    set_simd_target("MMX");
    FAIL("no error");
  } catch (const Error& e) {
    CHECK(e.kind() == ErrorKind::Usage);
    for (const std::string& name : simd_targets())
      CHECK(std::string(e.what()).find(name) != std::string::npos);
  }
}

// Sizes of test shapes and resolutions: smaller where every instruction is checked.
#pragma once

/// `full`, or `small` in the sanitize preset, which is ten to thirty times slower. For sizes only:
/// a test asserts the same at both.
constexpr int scaled([[maybe_unused]] int full, [[maybe_unused]] int small) {
#ifdef MARROW_SANITIZE
  return small;
#else
  return full;
#endif
}

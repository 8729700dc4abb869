// Running a check on every instruction set that the machine has.
#pragma once

#include <marrow/simd.hpp>

#include "catch.hpp"

namespace marrow::test {

/// Runs `check` once on each; afterwards the best is chosen again.
template <class Check>
void on_each_simd_target(Check check) {
  for (const std::string& name : simd_targets()) {
    INFO("instruction set " << name);
    set_simd_target(name);
    check();
  }
  set_simd_target("");
}

}  // namespace marrow::test

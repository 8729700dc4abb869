// The instruction sets that the kernels are compiled for; all of them give the same bits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace marrow {

/// Those that this machine can run, the best first, by the names that Highway gives them: "AVX3"
/// is AVX-512, "EMU128" and "SCALAR" are plain C++.
std::vector<std::string> simd_targets();

/// From now on all kernels run on this one; on the best where `name` is empty, as they do if this
/// is never called. For tests: not to be called while another thread is inside the library.
/// Throws Error: Usage, when it is none of simd_targets().
void set_simd_target(std::string_view name);

}  // namespace marrow

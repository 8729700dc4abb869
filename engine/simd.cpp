#include <marrow/error.hpp>
#include <marrow/simd.hpp>

#include <hwy/targets.h>

namespace marrow {

namespace {

using Targets = decltype(hwy::SupportedTargets());  // a set of bits, the best is the lowest

Targets best_of(Targets targets) { return targets & -targets; }

/// What this machine can run and the kernels are compiled for.
Targets runnable_targets() {
  static const Targets all = hwy::SupportedTargets() & static_cast<Targets>(HWY_TARGETS);
  return all;
}

std::string name_of(Targets target) { return hwy::TargetName(target); }

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (Targets t = runnable_targets(); t != 0; t &= t - 1) names.push_back(name_of(best_of(t)));
  return names;
}

void set_simd_target(std::string_view name) {
  Targets chosen = 0, rest = runnable_targets();
  std::string known;
  for (; rest != 0 && !name.empty() && chosen == 0; rest &= rest - 1) {
    if (name_of(best_of(rest)) == name) chosen = best_of(rest);
    known += (known.empty() ? "" : ", ") + name_of(best_of(rest));
  }
  if (chosen == 0 && !name.empty())
    throw Error(ErrorKind::Usage, "no instruction set " + std::string(name) +
                                      " on this machine; choose one of " + known);
  hwy::SetSupportedTargetsForTest(chosen);  // 0 takes the choice back
  hwy::GetChosenTarget().DeInit();          // what has run before would go on otherwise
}

}  // namespace marrow

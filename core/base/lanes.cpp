// First of all: compiles this file once for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/base/lanes.cpp"
#include <hwy/foreach_target.h>
// clang-format on

#include "core/base/lanes.h"

#include "core/base/check.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hybray::HWY_NAMESPACE {

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace hybray::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybray {

HWY_EXPORT(target_name);

std::string lanes_target() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

std::vector<std::string> lanes_targets() {
  std::vector<std::string> names;  // Highway lists the widest first
  for (const int64_t target : hwy::SupportedAndGeneratedTargets())
    names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_lanes_target(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  int64_t chosen = 0;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) chosen = target;
  HYBRAY_CHECK(name.empty() || chosen != 0);
  hwy::SetSupportedTargetsForTest(chosen);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace hybray
#endif

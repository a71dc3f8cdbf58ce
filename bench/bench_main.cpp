#include "core/base/lanes.h"
#include "core/base/parallel.h"
#include "core/tracer/tracer.h"

#include <benchmark/benchmark.h>

namespace hybray::bench {
void register_caustics();
void register_ssrm();
}  // namespace hybray::bench

int main(int argc, char** argv) {
  benchmark::AddCustomContext("embree", hybray::embree_version());
  // HYBRAY_LANES=AVX2 and the like: vector code of another instruction set than the widest.
  if (const char* target = std::getenv("HYBRAY_LANES")) hybray::use_lanes_target(target);
  benchmark::AddCustomContext("lanes", hybray::lanes_target());
  benchmark::AddCustomContext("threads", std::to_string(hybray::thread_count()));
  hybray::bench::register_ssrm();
  hybray::bench::register_caustics();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

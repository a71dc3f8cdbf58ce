#include "core/base/parallel.h"
#include "core/tracer/tracer.h"

#include <benchmark/benchmark.h>

namespace hybray::bench {
void register_caustics();
void register_ssrm();
}  // namespace hybray::bench

int main(int argc, char** argv) {
  benchmark::AddCustomContext("embree", hybray::embree_version());
  benchmark::AddCustomContext("threads", std::to_string(hybray::thread_count()));
  hybray::bench::register_ssrm();
  hybray::bench::register_caustics();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

// Experiment `ssrm`: strict screen space ray marching of mirror reflections, its verdicts against traced
// truth, and the hybrid tracer, estimated and measured (SSRM paper, Tables 1 to 3).
#pragma once

#include "harness/experiments/experiment.h"

namespace hybray {

const Experiment& ssrm_experiment();

namespace ssrm_parts {

std::vector<Parameter> parameters();
std::vector<Column> columns();
Row run(const Point& point, Workspace& workspace);
double memory_bytes(const Point& point);
double cost_seconds(const Point& point, const SceneFacts& scene);
std::vector<SharedCost> shared_costs(const Point& point, const SceneFacts& scene);

}  // namespace ssrm_parts
}  // namespace hybray

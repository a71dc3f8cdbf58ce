// An experiment with a column of every sort, and tables of it.
#pragma once

#include "core/base/error.h"
#include "harness/config/json_source.h"
#include "harness/experiments/columns.h"
#include "harness/gate/evaluate.h"
#include "harness/gate/gate_rules.h"
#include "tests/temporary_folder.h"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray::test {

inline Experiment gated_experiment() {
  using enum ColumnKind;
  return {"made",
          "Made up.",
          {},
          {
              {"scene", "", key, Better::none, "scene"},
              {"size", "px", key, Better::none, "size"},
              {"alpha", "1", metric, Better::higher, "share", {}, {0.25, 0.0}},
              {"loss", "1", metric, Better::lower, "error"},
              {"drift", "W", metric, Better::none, "either way"},
              {"items", "", count, Better::none, "how many", {}, {2.0, 0.125}},
              column::finding("good", "a flag", Comparison::value),
              column::finding("mode", "by measurement", Comparison::none),
              {"speedup", "1", time, Better::higher, "ratio of times"},
              {"t_ms", "ms", time, Better::lower, "time"},
              {"rate", "1/s", time, Better::higher, "rate"},
          },
          {},
          {},
          {}};
}

class GateFixture : public ::testing::Test {
 protected:
  static constexpr const char* kHeader = "id,scene,size,alpha,loss,drift,items,good,mode,speedup,t_ms,rate\n";

  GatedTable table(const std::string& rows) {
    return GatedTable::of_run(folder_.write("t.csv", kHeader + rows), experiment_);
  }
  Baseline baseline(const std::string& csv) {
    const auto file = folder_.write("baseline/t.csv", csv);
    return {file, GatedTable::accepted(file, experiment_)};
  }
  Baseline no_baseline() { return {"baseline/t.csv", {}}; }

  std::vector<Gate> gates(const std::string& list) {
    const JsonSource source(list, "g.json");
    throw_problems(gate_problems(source, "", experiment_));
    return gates_from(source.root(), experiment_);
  }
  Gate gate(const std::string& json) { return gates("[" + json + "]").at(0); }

  // The messages with this test's folder taken out.
  std::string problem_of(const std::function<void()>& action) {
    std::string message = message_of<InputError>(action);
    const std::string folder = folder_.path().string() + "/";
    for (size_t at; (at = message.find(folder)) != std::string::npos;) message.erase(at, folder.size());
    return message;
  }

  const TemporaryFolder folder_;
  const Experiment experiment_ = gated_experiment();
};

}  // namespace hybray::test

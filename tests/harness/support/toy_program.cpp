// The program `hybray` over the toy experiments.
#include "harness/cli/program.h"
#include "tests/harness/support/toy_experiment.h"

int main(int argc, char** argv) {
  const auto experiments = hybray::test::toy_experiments();
  return hybray::program_main(argc, argv, experiments);
}

#include "harness/cli/program.h"

int main(int argc, char** argv) {
  return hybray::program_main(argc, argv, hybray::experiments());
}

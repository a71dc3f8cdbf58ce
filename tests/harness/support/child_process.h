// Runs a program as a user would, and keeps what it says.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace hybray::test {

struct Outcome {
  int exit_code = -1;  // minus the signal's number where one ended it
  std::string out, err;
};

struct ProcessOptions {
  std::string folder;  // to start in; empty: the present one
  std::map<std::string, std::string>
      environment;             // beside what is inherited; an empty text removes a variable
  std::string interrupt_when;  // sends SIGINT once when stdout and stderr so far hold this text
};

Outcome run_process(const std::vector<std::string>& command, const ProcessOptions& options = {});

}  // namespace hybray::test

// Runs a program as a user would, and keeps what it says.
#pragma once

#include <csignal>
#include <map>
#include <optional>
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
  std::string interrupt_when;  // sends `signal` once when stdout and stderr so far hold this text
  int signal = SIGINT;
  // Sends `signal` so many milliseconds after the text of interrupt_when; without a text, after the start.
  std::optional<int> interrupt_after_ms = {};
  std::optional<size_t> file_size_limit = {};  // bytes; of any file that the program writes
};

Outcome run_process(const std::vector<std::string>& command, const ProcessOptions& options = {});

}  // namespace hybray::test

#include "tests/harness/support/child_process.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hybray::test {
namespace {

struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  void close_end(int i) {
    if (ends[i] >= 0) close(ends[i]);
    ends[i] = -1;
  }
};

[[noreturn]] void become(const std::vector<std::string>& command, const ProcessOptions& options, Pipe& out,
                         Pipe& err) {
  dup2(out.ends[1], STDOUT_FILENO);
  dup2(err.ends[1], STDERR_FILENO);
  for (int i : {0, 1}) out.close_end(i), err.close_end(i);
  for (const auto& [name, value] : options.environment) {
    if (value.empty())
      unsetenv(name.c_str());
    else
      setenv(name.c_str(), value.c_str(), 1);
  }
  if (options.file_size_limit) {
    const rlimit limit{*options.file_size_limit, *options.file_size_limit};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

// Appends what can be read now; closes the pipe at its end.
void drain(Pipe& pipe, std::string& text) {
  char buffer[4096];
  const ssize_t count = read(pipe.ends[0], buffer, sizeof buffer);
  if (count > 0)
    text.append(buffer, static_cast<size_t>(count));
  else
    pipe.close_end(0);
}

}  // namespace

Outcome run_process(const std::vector<std::string>& command, const ProcessOptions& options) {
  Pipe out, err;
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) become(command, options, out, err);
  out.close_end(1);
  err.close_end(1);

  Outcome outcome;
  using Clock = std::chrono::steady_clock;
  bool interrupted = options.interrupt_when.empty() && !options.interrupt_after_ms;
  std::optional<Clock::time_point> due;  // when to send the signal, once that is known
  while (out.ends[0] >= 0 || err.ends[0] >= 0) {
    pollfd waiting[2] = {{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}};
    if (!interrupted && !due && (outcome.out + outcome.err).find(options.interrupt_when) != std::string::npos)
      due = Clock::now() + std::chrono::milliseconds(options.interrupt_after_ms.value_or(0));
    using std::chrono::milliseconds;
    const auto left = due ? std::chrono::ceil<milliseconds>(*due - Clock::now()) : milliseconds(-1);
    if (due && left.count() <= 0) {
      kill(child, options.signal);
      interrupted = true;
      due.reset();
      continue;
    }
    poll(waiting, 2, static_cast<int>(left.count()));
    if (waiting[0].revents) drain(out, outcome.out);
    if (waiting[1].revents) drain(err, outcome.err);
  }
  int status = 0;
  waitpid(child, &status, 0);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return outcome;
}

}  // namespace hybray::test

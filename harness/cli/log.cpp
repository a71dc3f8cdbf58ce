#include "harness/cli/log.h"

#include <cstdlib>
#include <memory>
#include <sstream>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace hybray {
namespace {

void log_lines(spdlog::level::level_enum level, const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) spdlog::log(level, "{}", line);
}

}  // namespace

void set_up_log(bool quiet) {
  const char* no_color = std::getenv("NO_COLOR");
  const auto color = no_color && *no_color ? spdlog::color_mode::never : spdlog::color_mode::automatic;
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_st>(color);
  auto logger = std::make_shared<spdlog::logger>("hybray", std::move(sink));
  logger->set_pattern("hybray: %^%l%$: %v");
  logger->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void log_info(const std::string& text) {
  log_lines(spdlog::level::info, text);
}
void log_warning(const std::string& text) {
  log_lines(spdlog::level::warn, text);
}
void log_error(const std::string& text) {
  log_lines(spdlog::level::err, text);
}

bool stderr_is_terminal() {
  return isatty(STDERR_FILENO) != 0;
}

size_t stderr_columns() {
  constexpr size_t kUsual = 80;
  winsize size = {};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

}  // namespace hybray

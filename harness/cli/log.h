// Messages for people, on stderr. Data never goes this way.
#pragma once

#include <string>

namespace hybray {

// Before the first message: `quiet` leaves only warnings and errors. Colours where stderr is a terminal and
// NO_COLOR is not set.
void set_up_log(bool quiet);

// Each line of the text becomes a message of its own.
void log_info(const std::string& text);
void log_warning(const std::string& text);
void log_error(const std::string& text);

// Whether stderr is a terminal that lines can be redrawn on.
bool stderr_is_terminal();

}  // namespace hybray

// Messages for people, on stderr. Data never goes this way.
#pragma once

#include <cstddef>
#include <string>

namespace hybray {

// Before the first message: `quiet` leaves only warnings and errors. Colours where stderr is a terminal and
// NO_COLOR is not set.
void set_up_log(bool quiet);

// Each line of the text becomes a message of its own.
void log_info(const std::string& text);
void log_warning(const std::string& text);
void log_error(const std::string& text);

// Whether stderr is a terminal that lines can be redrawn on, and how wide it is: a longer line would wrap,
// and only its end could be redrawn.
bool stderr_is_terminal();
size_t stderr_columns();

}  // namespace hybray

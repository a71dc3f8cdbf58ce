// Shell completion scripts, made from the command line's own declaration.
#pragma once

#include <span>
#include <string>

namespace CLI {
class App;
}

namespace hybray {

enum class Shell { bash, zsh, fish };

// A script that, sourced by `shell`, completes the commands and options of `app`, files where an option or
// argument takes one, scenes by asking the program, and `experiments` where a name of one is wanted.
std::string completion_script(const CLI::App& app, Shell shell, std::span<const std::string> experiments);

}  // namespace hybray

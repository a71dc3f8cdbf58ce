#include "harness/cli/completion.h"

#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hybray {
namespace {

// What may follow on the command line, as bash's `compgen` is asked for it.
struct Wanted {
  bool files = false, folders = false, scenes = false, experiments = false;
};

Wanted wanted(const CLI::Option& option) {
  const std::string type = option.get_type_name(), name = option.get_name(true, true);
  Wanted w;
  w.files = type.starts_with("FILE") || name.find("TABLE") != std::string::npos;
  w.folders = type == "DIR";
  w.experiments = name.find("EXPERIMENT") != std::string::npos;
  w.scenes = type == "SCENE";
  return w;
}

// "--output", "-o"; none of an argument.
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

std::vector<const CLI::App*> commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

// `compgen` calls for the values that an option or argument takes, or an empty text.
std::string values(const Wanted& w, std::span<const std::string> experiments) {
  std::string calls;
  if (w.files) calls += " $(compgen -f -- \"$word\")";
  if (w.folders) calls += " $(compgen -d -- \"$word\")";
  if (w.scenes)
    calls += " $(compgen -W \"$(\"$program\" scene list 2>/dev/null | cut -d' ' -f1)\" -- \"$word\")";
  if (w.experiments) calls += fmt::format(" $(compgen -W \"{}\" -- \"$word\")", fmt::join(experiments, " "));
  return calls;
}

// One `case` branch for the command at `path` ("run", "scene render", ...), then those below it.
void add_branches(const CLI::App& app, const std::string& path, std::span<const std::string> experiments,
                  std::string& branches, std::string& paths) {
  std::vector<std::string> words;
  std::string by_option, by_argument;
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string> names = names_of(*option);
    words.insert(words.end(), names.begin(), names.end());
    const std::string calls = values(wanted(*option), experiments);
    if (calls.empty()) continue;
    if (option->get_positional()) {
      by_argument += calls;
      continue;
    }
    by_option += fmt::format("        {}) COMPREPLY=({}); return ;;\n", fmt::join(names, "|"), calls);
  }
  for (const CLI::App* command : commands(app)) words.push_back(command->get_name());
  branches += fmt::format("    \"{}\")\n", path);
  if (!by_option.empty()) branches += fmt::format("      case \"$before\" in\n{}      esac\n", by_option);
  branches += fmt::format("      COMPREPLY=($(compgen -W \"{}\" -- \"$word\"){}) ;;\n", fmt::join(words, " "),
                          by_argument);
  for (const CLI::App* command : commands(app)) {
    const std::string below = path.empty() ? command->get_name() : path + " " + command->get_name();
    paths += fmt::format("      \"{}\") path=\"{}\" ;;\n", below, below);
    add_branches(*command, below, experiments, branches, paths);
  }
}

std::string bash_script(const CLI::App& app, std::span<const std::string> experiments) {
  std::string branches, paths;
  add_branches(app, "", experiments, branches, paths);
  return fmt::format(R"(_hybray() {{
  local program="${{COMP_WORDS[0]}}" word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}"
  local path="" i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "${{path:+$path }}${{COMP_WORDS[i]}}" in
{}    esac
  done
  case "$path" in
{}  esac
}}
complete -o filenames -F _hybray hybray
)",
                     paths, branches);
}

std::string quoted(std::string text) {
  for (size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return "'" + text + "'";
}

void add_fish_lines(const CLI::App& app, const std::string& condition,
                    std::span<const std::string> experiments, std::string& lines) {
  for (const CLI::App* command : commands(app)) {
    const std::string name = command->get_name();
    const std::string here = condition.empty() ? "__fish_use_subcommand" : condition;
    lines += fmt::format("complete -c hybray -n {} -f -a {} -d {}\n", quoted(here), name,
                         quoted(command->get_description()));
    add_fish_lines(*command, "__fish_seen_subcommand_from " + name, experiments, lines);
  }
  for (const CLI::Option* option : app.get_options()) {
    const Wanted w = wanted(*option);
    std::string line = "complete -c hybray";
    if (!condition.empty()) line += " -n " + quoted(condition);
    if (w.scenes)
      line += " -f -a '(hybray scene list 2>/dev/null | string split -f1 \" \")'";
    else if (w.experiments)
      line += fmt::format(" -f -a '{}'", fmt::join(experiments, " "));
    if (option->get_positional()) {
      if (w.scenes || w.experiments) lines += line + "\n";
      continue;
    }
    for (const std::string& name : option->get_lnames()) line += " -l " + name;
    for (const std::string& name : option->get_snames()) line += " -s " + name;
    if (option->get_items_expected_max() > 0) line += w.files || w.folders ? " -r -F" : " -r";
    lines += line + " -d " + quoted(option->get_description()) + "\n";
  }
}

}  // namespace

std::string completion_script(const CLI::App& app, Shell shell, std::span<const std::string> experiments) {
  switch (shell) {
    case Shell::bash:
      return bash_script(app, experiments);
    case Shell::zsh:
      return "autoload -U +X bashcompinit && bashcompinit\n" + bash_script(app, experiments);
    case Shell::fish:
      break;
  }
  std::string lines;
  add_fish_lines(app, "", experiments, lines);
  return lines;
}

}  // namespace hybray

#include "harness/cli/program.h"

#include "core/base/error.h"
#include "harness/cli/commands.h"
#include "harness/cli/completion.h"
#include "harness/cli/log.h"
#include "harness/cli/project_root.h"
#include "harness/table/build_info.h"

#include <iostream>
#include <map>

#include <CLI/CLI.hpp>

namespace hybray {
namespace {

constexpr const char* kFooter = R"(
Configs, scenes and results/ are looked for in the project's folder: the one that HYBRAY_ROOT names, else
the nearest folder with scenes/ and configs/ in it, from the present folder upward, then from the program's
own folder upward. Scene files are looked for in its scenes/external and in the folders of
HYBRAY_SCENE_PATH, separated by colons.

Exit codes: 0 ok, 1 a gate failed, 2 wrong usage or config, 3 some points failed, 130 interrupted.)";

// Options that `run` and `points` share.
void add_sweep_options(CLI::App& command, std::vector<std::string>& assignments,
                       std::vector<std::string>& filters) {
  command.add_option("--set", assignments, "Replace a parameter, a whole sweep, or the seed")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--filter", filters, "Keep only the points that match (of one KEY: any of its values)")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
}

// The command line. Each command, once parsed, leaves what it is to do in `action`.
class CommandLine {
 public:
  CommandLine() : app_("Measures approximate light transport against ray-traced truth.", "hybray") {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", [] { return version_line(); });
    app_.footer(kFooter);
    add_run();
    add_points();
    add_describe();
    add_scene();
    add_doctor();
    add_completion();
  }

  CLI::App& app() { return app_; }
  bool quiet() const { return run_.quiet; }
  int act(const Environment& environment) const { return action_(environment); }

 private:
  void add_run() {
    CLI::App* command = app_.add_subcommand("run", "Run configs and write their tables");
    command->add_option("CONFIG", run_.configs, "Config files")->required()->type_name("FILE");
    command
        ->add_option(
            "-o,--output", run_.output,
            "Folder for CONFIG.csv and manifest.json; with several configs, one folder for each in it "
            "(default: results/out/CONFIG in the project's folder)")
        ->type_name("DIR");
    add_sweep_options(*command, run_.assignments, run_.filters);
    command->add_flag_callback(
        "--no-timing", [this] { run_.timing = false; }, "Measure no times: repeatable output, faster");
    command->add_option("--threads", run_.threads, "Threads to use (default: all)")
        ->type_name("N")
        ->check(CLI::Range(1, 4096));
    command->add_flag("-q,--quiet", run_.quiet, "Only warnings and errors on stderr");
    command->callback([this] { action_ = [this](const Environment& e) { return run_command(e, run_); }; });
  }

  void add_points() {
    CLI::App* command = app_.add_subcommand(
        "points", "List the points of a config: id, parameters, estimated time and memory");
    command->add_option("CONFIG", points_.config, "Config file")->required()->type_name("FILE");
    add_sweep_options(*command, points_.assignments, points_.filters);
    command->callback(
        [this] { action_ = [this](const Environment& e) { return points_command(e, points_); }; });
  }

  void add_describe() {
    CLI::App* command = app_.add_subcommand("describe", "Parameters and columns of an experiment");
    command->add_option("EXPERIMENT", describe_.experiment, "Name of the experiment (default: list all)")
        ->type_name("NAME");
    CLI::Option* schema = command->add_flag("--schema", schema_, "JSON Schema of its configs");
    CLI::Option* markdown = command->add_flag("--markdown", markdown_, "As Markdown tables");
    schema->excludes(markdown);
    command->callback([this] {
      if (schema_) describe_.format = DescribeFormat::schema;
      if (markdown_) describe_.format = DescribeFormat::markdown;
      action_ = [this](const Environment& e) { return describe_command(e, describe_); };
    });
  }

  void add_scene() {
    CLI::App* scene = app_.add_subcommand("scene", "Look at scenes");
    scene->require_subcommand(1);
    CLI::App* list =
        scene->add_subcommand("list", "All scenes that can be found, and whether their source is there");
    list->callback([this] { action_ = scene_list_command; });

    CLI::App* info = scene->add_subcommand("info", "What is in a scene");
    info->add_option("NAME", render_.scene, "Scene")->required()->type_name("SCENE");
    info->callback(
        [this] { action_ = [this](const Environment& e) { return scene_info_command(e, render_.scene); }; });

    CLI::App* save = scene->add_subcommand("export", "Write a scene as binary glTF");
    save->add_option("NAME", render_.scene, "Scene")->required()->type_name("SCENE");
    save->add_option("-o,--output", render_.file, "File to write")->required()->type_name("FILE.glb");
    save->callback([this] {
      action_ = [this](const Environment& e) { return scene_export_command(e, render_.scene, render_.file); };
    });

    CLI::App* render = scene->add_subcommand("render", "Draw a scene, to look at it");
    render->add_option("NAME", render_.scene, "Scene")->required()->type_name("SCENE");
    render->add_option("--camera", render_.camera, "Camera (default: the scene's first)")->type_name("NAME");
    render->add_option("--resolution", render_.resolution, "Size of the picture in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    render->add_option("-o,--output", render_.file, "File to write (default: NAME-CAMERA.png)")
        ->type_name("FILE.png");
    render->callback(
        [this] { action_ = [this](const Environment& e) { return scene_render_command(e, render_); }; });
  }

  void add_doctor() {
    app_.add_subcommand("doctor", "What the program runs on, what would spoil its numbers, what is missing")
        ->callback([this] { action_ = doctor_command; });
  }

  void add_completion() {
    CLI::App* command = app_.add_subcommand("completion", "Print a script that completes this command line");
    command->footer("For example: source <(hybray completion bash)");
    const std::map<std::string, Shell> shells{
        {"bash", Shell::bash}, {"zsh", Shell::zsh}, {"fish", Shell::fish}};
    command->add_option("SHELL", shell_, "bash, zsh or fish")
        ->required()
        ->transform(CLI::CheckedTransformer(shells))
        ->type_name("TEXT");
    command->callback([this] {
      action_ = [this](const Environment& environment) {
        std::vector<std::string> names;
        for (const Experiment& experiment : environment.experiments) names.push_back(experiment.name);
        std::cout << completion_script(app_, shell_, names);
        return int{kOk};
      };
    });
  }

  CLI::App app_;
  RunOptions run_;
  PointsOptions points_;
  DescribeOptions describe_;
  bool schema_ = false, markdown_ = false;
  Shell shell_ = Shell::bash;
  SceneRenderOptions render_;  // its scene and file serve info and export as well
  std::function<int(const Environment&)> action_;
};

}  // namespace

int program_main(int argc, char** argv, std::span<const Experiment> experiments) {
  set_up_log(false);
  try {
    CommandLine line;
    try {
      line.app().parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return line.app().exit(error) == 0 ? kOk : kUsage;
    }
    set_up_log(line.quiet());
    const std::filesystem::path root = find_project_root();
    return line.act({experiments, root, default_scene_paths(root)});
  } catch (const InputError& error) {
    log_error(error.what());
    return kUsage;
  } catch (const std::exception& error) {
    log_error(error.what());
    return kSomeFailed;
  }
}

}  // namespace hybray

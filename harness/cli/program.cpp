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
HYBRAY_SCENE_PATH, separated by colons. HYBRAY_CACHE_DIR and HYBRAY_CACHE_BYTES stand for --cache-dir and
--cache-bytes.

Exit codes: 0 ok, 1 a gate failed, 2 wrong usage or config, 3 some points failed, 130 interrupted.)";

// Options that `run` and `points` share.
void add_sweep_options(CLI::App& command, std::vector<std::string>& assignments,
                       std::vector<std::string>& filters, std::string& shard) {
  command
      .add_option("--set", assignments,
                  "Replace what the config says of a parameter, or the seed; VALUE,VALUE,... makes a sweep")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command
      .add_option("--filter", filters,
                  "Keep only the points that match (of one KEY: any of its values, also VALUE,VALUE,...)")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--shard", shard, "Only the I-th of N parts of the points, of about equal cost")
      ->type_name("I/N");
}

void add_cache_folder(CLI::App& command, CacheOptions& cache) {
  command
      .add_option("--cache-dir", cache.folder,
                  "Folder of converged references (default: hybray in XDG_CACHE_HOME or ~/.cache)")
      ->envname("HYBRAY_CACHE_DIR")
      ->type_name("DIR");
}

void add_cache_bytes(CLI::App& command, CacheOptions& cache) {
  command
      .add_option("--cache-bytes", cache.max_bytes,
                  "Size that the references may have on disk, such as 500MB or 4GB (default: 4GB; 0: keep "
                  "none)")
      ->envname("HYBRAY_CACHE_BYTES")
      ->transform(CLI::AsSizeValue(false))
      ->type_name("SIZE");
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
    add_merge();
    add_check();
    add_accept();
    add_describe();
    add_scene();
    add_cache();
    add_doctor();
    add_completion();
  }

  CLI::App& app() { return app_; }
  bool quiet() const { return run_.quiet; }
  int act(const Environment& environment) const { return action_(environment); }

 private:
  void add_run() {
    CLI::App* command =
        app_.add_subcommand("run", "Run configs and write their tables; resume where a run was interrupted");
    command->add_option("CONFIG", run_.configs, "Configs, and suites of configs")
        ->required()
        ->type_name("FILE");
    command
        ->add_option(
            "-o,--output", run_.output,
            "Folder for CONFIG.csv and manifest.json; with several configs, one folder for each in it "
            "(default: results/out/CONFIG in the project's folder). A shard goes to shard-I-of-N in it")
        ->type_name("DIR");
    add_sweep_options(*command, run_.assignments, run_.filters, run_.shard);
    command->add_flag("--fresh", run_.fresh, "Start over: take over no row of an earlier run");
    command->add_flag_callback(
        "--no-timing", [this] { run_.timing = false; }, "Measure no times: repeatable output, faster");
    command->add_option("--threads", run_.threads, "Threads to use (default: all)")
        ->type_name("N")
        ->check(CLI::Range(1, 4096));
    command->add_flag("-q,--quiet", run_.quiet, "Only warnings and errors on stderr");
    command->add_flag_callback(
        "--no-cache", [this] { run_.use_cache = false; }, "Neither use nor keep references on disk");
    add_cache_folder(*command, run_.cache);
    add_cache_bytes(*command, run_.cache);
    command->callback([this] { action_ = [this](const Environment& e) { return run_command(e, run_); }; });
  }

  void add_points() {
    CLI::App* command = app_.add_subcommand(
        "points", "List the points of configs: id, parameters, estimated time and memory");
    command->add_option("CONFIG", points_.configs, "Configs, and suites of configs")
        ->required()
        ->type_name("FILE");
    add_sweep_options(*command, points_.assignments, points_.filters, points_.shard);
    CLI::Option* csv = command->add_flag_callback(
        "--csv", [this] { points_.format = PointsFormat::csv; }, "As a table, a column for each parameter");
    CLI::Option* json = command->add_flag_callback(
        "--json", [this] { points_.format = PointsFormat::json; }, "As JSON, an object for each config");
    csv->excludes(json);
    command->callback(
        [this] { action_ = [this](const Environment& e) { return points_command(e, points_); }; });
  }

  void add_merge() {
    CLI::App* command = app_.add_subcommand("merge", "Make one table of those of shards");
    command->add_option("DIR", merge_.folders, "Folders of the shards")->required()->type_name("DIR");
    command->add_option("-o,--output", merge_.output, "Folder for the table and its manifest.json")
        ->required()
        ->type_name("DIR");
    command->add_flag("--allow-missing", merge_.allow_missing, "Merge although points have no row");
    command->callback(
        [this] { action_ = [this](const Environment& e) { return merge_command(e, merge_); }; });
  }

  // Options that `check` and `accept` share.
  void add_table_options(CLI::App& command) {
    command.add_option("TABLE", check_.tables, "Tables that runs wrote")->required()->type_name("FILE.csv");
    command
        .add_option(
            "--gates", check_.gates,
            "Config or file of gates to hold them against (default: the config that the manifest beside the "
            "table names)")
        ->type_name("FILE");
    command
        .add_option("--baseline", check_.baseline,
                    "Folder of the accepted tables (default: results/baseline in the project's folder)")
        ->type_name("DIR");
  }

  void add_check() {
    CLI::App* command = app_.add_subcommand(
        "check",
        "Hold tables against the gates of their configs; where there are none, against the accepted tables");
    add_table_options(*command);
    command->add_option("--junit", check_.junit, "Write JUnit XML too")->type_name("FILE");
    command->add_option("--markdown", check_.markdown, "Write a Markdown summary too")->type_name("FILE");
    command->callback(
        [this] { action_ = [this](const Environment& e) { return check_command(e, check_); }; });
  }

  void add_accept() {
    CLI::App* command = app_.add_subcommand(
        "accept", "Make tables the accepted ones, and print what differs from those before");
    add_table_options(*command);
    command->callback(
        [this] { action_ = [this](const Environment& e) { return accept_command(e, check_); }; });
  }

  void add_describe() {
    CLI::App* command = app_.add_subcommand("describe", "Parameters and columns of an experiment");
    command
        ->add_option("EXPERIMENT", describe_.experiment,
                     "Name of the experiment (default: list all), or suite")
        ->type_name("NAME");
    CLI::Option* schema = command->add_flag("--schema", schema_, "JSON Schema of its configs");
    CLI::Option* markdown = command->add_flag("--markdown", markdown_, "As Markdown tables");
    CLI::Option* gate_schema = command->add_flag("--gate-schema", gate_schema_,
                                                 "JSON Schema of files of gates, for all experiments");
    schema->excludes(markdown);
    gate_schema->excludes(schema)->excludes(markdown);
    command->callback([this] {
      if (schema_) describe_.format = DescribeFormat::schema;
      if (markdown_) describe_.format = DescribeFormat::markdown;
      if (gate_schema_) describe_.format = DescribeFormat::gate_schema;
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

  void add_cache() {
    CLI::App* cache = app_.add_subcommand("cache", "Converged references that are kept on disk");
    cache->require_subcommand(1);
    CLI::App* list = cache->add_subcommand("list", "What is there, the least recently used first");
    add_cache_folder(*list, cache_);
    add_cache_bytes(*list, cache_);
    list->callback(
        [this] { action_ = [this](const Environment& e) { return cache_list_command(e, cache_); }; });

    CLI::App* check = cache->add_subcommand(
        "check", "Verify every checksum and remove what is damaged; exit code 1 where something was");
    add_cache_folder(*check, cache_);
    check->callback(
        [this] { action_ = [this](const Environment& e) { return cache_check_command(e, cache_); }; });

    CLI::App* clear = cache->add_subcommand("clear", "Remove references");
    clear->add_option("ENTRY", cache_entries_, "First digits of their hashes (default: all)")
        ->type_name("HASH");
    add_cache_folder(*clear, cache_);
    clear->callback([this] {
      action_ = [this](const Environment& e) { return cache_clear_command(e, cache_, cache_entries_); };
    });
  }

  CLI::App app_;
  RunOptions run_;
  PointsOptions points_;
  MergeOptions merge_;
  CheckOptions check_;
  DescribeOptions describe_;
  bool schema_ = false, markdown_ = false, gate_schema_ = false;
  Shell shell_ = Shell::bash;
  SceneRenderOptions render_;  // its scene and file serve info and export as well
  CacheOptions cache_;
  std::vector<std::string> cache_entries_;
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

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "export/export.h"
#include "farm/commands.h"

namespace veduta {
namespace {

struct Options {
  std::filesystem::path file, out;
  std::optional<uint64_t> cell;
  std::optional<std::array<float, 3>> at;
};

int run_export(const Options& options, Verbosity verbosity) {
  check_exportable(options.out, options.cell || options.at);
  const PvsStream stream(options.file);
  std::optional<uint32_t> cell;
  if (options.cell) cell = cell_of_number(stream.index(), *options.cell);
  if (options.at) cell = cell_at(stream.index(), {(*options.at)[0], (*options.at)[1], (*options.at)[2]});
  const Exported exported = export_result(stream, cell, options.out);
  if (verbosity == Verbosity::quiet) return 0;
  std::cout << fmt::format("{}: {}, {} objects, {}{:.1f} MB\n", options.out.string(),
                           cell ? fmt::format("cell {}", *cell) : fmt::format("{} cells", exported.cells),
                           exported.objects,
                           exported.triangles > 0 ? fmt::format("{} triangles, ", exported.triangles) : "",
                           static_cast<double>(exported.bytes) / 1e6)
            << std::flush;
  return 0;
}

}  // namespace

void add_export(CLI::App& app, CommandLine& line) {
  auto* const command = app.add_subcommand(
      "export", "Write what a cell sees as OBJ, glTF or a plan (SVG), or rows as JSON lines");
  auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "A city.pvs.h5")->required();
  command
      ->add_option("-o,--out", options->out,
                   "What to write: .obj, .gltf, .glb, .svg of a cell; .jsonl of a cell or all")
      ->required();
  auto* const cell = command->add_option("--cell", options->cell, "Number of the cell")
                         ->check(CLI::Range(uint64_t{0}, uint64_t{1} << 62));
  command->add_option("--at", options->at, "X Y Z: a point in the cell, m from the file's origin")
      ->excludes(cell);
  command->callback(
      [options, &line] { line.run = [options, &line] { return run_export(*options, line.verbosity); }; });
}

}  // namespace veduta

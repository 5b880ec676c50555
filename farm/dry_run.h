// What a bake would be, without doing it: `veduta bake --dry-run`.
#pragma once

#include "farm/bake.h"
#include "farm/machine.h"
#include "pvs/run_paths.h"
#include "worker/settings.h"

namespace veduta {

/// Prints configuration, machine, view-cells, and about how long they will take and how much disk they need.
/// A run that is prepared says exactly how many cells there are, and has a few of them baked; else they are
/// estimated from the model. Writes nothing. \throw Error as a bake: of the model, the worker, or for a run
/// directory of another job.
void print_plan(const BakeOptions& options, const Settings& settings, const RunPaths& run, int ranks,
                const RankShare& share);

}  // namespace veduta

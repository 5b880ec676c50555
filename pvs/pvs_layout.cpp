#include "pvs/pvs_layout.h"

#include "pvs/digest.h"

namespace veduta {

std::string content_digest(const City& city, bool conservative, const ColumnDigests& digests) {
  Digest digest;
  for (const auto& [path, hex] : digests) {
    // These differ from run to run.
    if (path == column::cell_bake_us.path || path == column::cell_worker.path ||
        path == column::worker_name.path)
      continue;
    digest.update_text(path);
    digest.update_text(hex);
  }
  digest.update_text(city.scene.crs);
  digest.update(city.scene.origin.data(), sizeof city.scene.origin);
  for (const OctreeForest* forest : {&city.navigation.free, &city.navigation.surfaces}) {
    digest.update(&forest->lower, sizeof forest->lower);
    digest.update(&forest->leaf_size_m, sizeof forest->leaf_size_m);
    digest.update(&forest->depth, sizeof forest->depth);
  }
  const HeightField& ground = city.navigation.ground;
  digest.update(&ground.lower_x, sizeof ground.lower_x);
  digest.update(&ground.lower_y, sizeof ground.lower_y);
  digest.update(&ground.step_m, sizeof ground.step_m);
  const uint8_t safe = conservative ? 1 : 0;
  digest.update(&safe, sizeof safe);
  return digest.hex();
}

std::string header_digest(const RootAttributes& root) {
  Digest digest;
  for (const std::string& text : {root.format, root.unit, root.up, root.crs, root.header.fingerprint,
                                  root.header.config, root.header.renderer, root.content_digest})
    digest.update_text(text);
  digest.update(&root.version, sizeof root.version);
  digest.update(root.origin.data(), sizeof root.origin);
  const uint8_t flags[2] = {root.header.complete, root.header.conservative};
  digest.update(flags, sizeof flags);
  return digest.hex();
}

}  // namespace veduta

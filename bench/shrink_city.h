// What the benchmark of shrinking works on: a city in blocks.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "worker/settings.h"
#include "worker/shrinker.h"

namespace veduta::bench {

using Json = nlohmann::ordered_json;

struct Job {
  Settings settings;
  std::vector<std::string> methods;
  ShrinkRequest request;
  double core_m = 64;
  size_t blocks = 0;
  uint64_t points = 20000;
  size_t alone = 0, exact = 0;
};

/// \throw on what is no job: nlohmann's errors, Error.
Job job_from(const Json& in);

/// A block of the city and the buildings that are its own.
struct Piece {
  SealedBlock block;
  std::vector<uint32_t> buildings;
};

class City {
 public:
  /// Reads the model; completes the job's request with what depends on it. \param job outlives this.
  explicit City(Job& job);

  const Scene& scene() const { return scene_; }
  double seed_size_m() const { return job_.settings.navigation.seed_size_m; }

  /// The blocks that the job asks for.
  std::vector<Piece> pieces() const;

  /// A building by itself, on a ground at its foot. Its foot lies in a plane of the lattice: else the fill
  /// would find a way below it.
  SealedBlock alone(uint32_t object) const;

 private:
  double halo_m() const;

  const Job& job_;
  Scene scene_;
  std::vector<PlacedTriangle> triangles_;
};

}  // namespace veduta::bench

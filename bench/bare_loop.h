// What a renderer reaches in bare loops of the steps that occlusion is made of: the limits that its figures
// are held against.
#pragma once

#include <string>

#include "pvs/city.h"

namespace veduta::bench {

/// All of it into one cube face of 32-bit float depth, nothing else. Each the best of five.
struct BareLimits {
  double triangles_per_s = 0;           ///< of two pixels each, every one of them nearer than what is there
  double streamed_triangles_per_s = 0;  ///< the same, vertices sent anew each time
  double pixels_per_s = 0;              ///< quads that fill the face, back to front: every pixel is written
  double rejected_pixels_per_s = 0;     ///< front to back: every pixel but the first is refused
  double box_tests_per_s = 0;           ///< compute: box to rectangle, four texels of a pyramid
  /// Hardware occlusion queries, each of eight triangles over 1/16 of the edge; answers fetched at the end.
  double queries_per_s = 0;
  double read_back_ms = 0;  ///< fetching a word that a shader has just written (median)
  double rays_per_s = 0;    ///< first hits in the city, all round, one thread
};

/// Needs a current GL 4.3 context. `resolution`: pixels along the edge of a face. Takes some seconds.
BareLimits bare_limits(int resolution, const City& city);

}  // namespace veduta::bench

// The end of a wall, and things behind it that look past it by a little more each: what is wrong by a little
// shows in them.
#pragma once

#include "tests/worker/occlusion_city.h"

namespace veduta::mutation {

/// Where the cell is [0, edge] x [0, edge], lengths are in sixteenths of its edge, so that they go with it.
struct Silhouette {
  double edge_m = 16;
  double margin_m = 0;              ///< how far eyes may be beside the cell
  double wall_x = 20, wall_y = -8;  ///< the end of the wall; it goes on to higher y
  int resolution = 1024;            ///< pixels along a face of the cube
  int first = -125,
      count =
          160;  ///< by how much things look past the end, in hundredths, as seen by the eye that sees most
  /// Long strips, of which next to nothing is to be seen; else small boxes at the ends of long bounds.
  bool strips = false;

  /// Adds it and prepares the city. Things are wider than the cell, so that T2 leaves no room.
  void make(test::OcclusionCity& city) const;
};

}  // namespace veduta::mutation

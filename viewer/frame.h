// One frame, whoever asks for it: window or pictures.
#pragma once

#include <functional>
#include <memory>

#include "viewer/draw/composer.h"
#include "viewer/stream/city_stream.h"
#include "viewer/view_state.h"

namespace veduta {

class Hud;

struct FrameOptions {
  int samples = 4;             ///< of multi-sampling; 1: none
  bool allow_one_pass = true;  ///< both eyes by one call where the driver can
  bool wait = false;           ///< for all that is to be drawn (pictures); false: draw what is here (window)
  uint64_t upload_bytes = 4u << 20;  ///< put on the GPU in a frame at most, one page at least
};

class FrameDrawer {
 public:
  /// On the current GL context, which has to outlive it; so has the stream. `hud` may be nullptr.
  FrameDrawer(CityStream& stream, const FrameOptions& options, Hud* hud);
  ~FrameDrawer();

  /// Draws what the state says. `velocity_m_s`: of the eye, for reading ahead.
  FrameStats draw(const ViewState& state, const glm::vec3& velocity_m_s, const Output& output);

  bool one_pass() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace veduta

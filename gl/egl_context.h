// A headless OpenGL context: EGL on a chosen device, without window, surface or display server (DESIGN §7).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace veduta {

/// Which EGL device to use, as the user says it.
struct GpuChoice {
  enum class Mode : uint8_t { automatic, software, device };
  Mode mode = Mode::automatic;
  uint32_t device = 0;  ///< for Mode::device: its number in list_devices()

  /// "auto" (hardware, else software), "software", or a device number.
  /// \throw Error(usage) for anything else.
  static GpuChoice parse(const std::string& text);
};

/// One line per EGL device of this machine, by number: "0: hardware /dev/dri/card0 cuda 3" (CUDA's number,
/// where the driver tells it), "1: software". Opens none of them. Empty without EGL.
std::vector<std::string> list_devices();

/// An OpenGL 4.3+ core context, current on the thread that made it, until it is destroyed there.
class EglContext {
 public:
  /// `gpu` as GpuChoice::parse; "auto" is the first hardware device that works (the farm names a device to
  /// each of its workers: farm/devices.h). \throw Error(usage) when there is no such device, or no usable EGL
  /// or OpenGL 4.3, saying what to install.
  explicit EglContext(const std::string& gpu);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  std::string renderer() const { return renderer_; }  ///< GL_RENDERER
  std::string version() const { return version_; }    ///< GL_VERSION
  bool software() const;                              ///< is it a CPU renderer?

 private:
  bool try_device(void* device);
  bool try_display(void* display);

  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string renderer_, version_;
  std::string refusal_;  ///< why the last device tried could not be used
};

}  // namespace veduta

#include "gl/egl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "scene/error.h"

namespace veduta {
namespace {

constexpr const char* what_to_install =
    "install a driver (Debian: apt install libegl1 libopengl0 libgl1-mesa-dri)";

bool has_word(const char* words, const std::string& word) {
  return words && (" " + std::string(words) + " ").find(" " + word + " ") != std::string::npos;
}

// epoxy ends the process when a library that it needs is missing, so we look first.
bool loadable(const char* library) {
  return dlopen(library, RTLD_LAZY | RTLD_LOCAL) != nullptr;
}

bool egl_present() {
  static const bool present =
      loadable("libEGL.so.1") && (loadable("libOpenGL.so.0") || loadable("libGL.so.1"));
  return present;
}

const char* client_extensions() {
  return eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
}

bool can_enumerate() {
  const char* words = client_extensions();
  const bool enumerates =
      has_word(words, "EGL_EXT_device_base") ||
      (has_word(words, "EGL_EXT_device_enumeration") && has_word(words, "EGL_EXT_device_query"));
  return enumerates && has_word(words, "EGL_EXT_platform_base") && has_word(words, "EGL_EXT_platform_device");
}

std::vector<EGLDeviceEXT> devices() {
  if (!egl_present() || !can_enumerate()) return {};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(0, nullptr, &count) || count <= 0) return {};
  std::vector<EGLDeviceEXT> found(static_cast<size_t>(count));
  if (!eglQueryDevicesEXT(count, found.data(), &count)) return {};
  found.resize(static_cast<size_t>(count));
  return found;
}

bool is_software(EGLDeviceEXT device) {
  return has_word(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

std::string egl_error() {
  return fmt::format("EGL error 0x{:x}", eglGetError());
}

}  // namespace

GpuChoice GpuChoice::parse(const std::string& text) {
  if (text == "auto") return {Mode::automatic, 0};
  if (text == "software") return {Mode::software, 0};
  uint32_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || fault != std::errc() || end != text.data() + text.size())
    throw Error(ExitStatus::usage, fmt::format("gpu: \"{}\" is not auto, software or a device number", text));
  return {Mode::device, number};
}

std::vector<std::string> list_devices() {
  std::vector<std::string> lines;
  for (EGLDeviceEXT device : devices()) {
    std::string line = fmt::format("{}: {}", lines.size(), is_software(device) ? "software" : "hardware");
    if (has_word(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_EXT_device_drm"))
      if (const char* node = eglQueryDeviceStringEXT(device, EGL_DRM_DEVICE_FILE_EXT))
        line += std::string(" ") + node;
    EGLAttrib cuda = 0;
    if (has_word(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_NV_device_cuda") &&
        eglQueryDeviceAttribEXT(device, EGL_CUDA_DEVICE_NV, &cuda))
      line += fmt::format(" cuda {}", cuda);
    lines.push_back(line);
  }
  return lines;
}

EglContext::EglContext(const std::string& gpu) {
  const GpuChoice choice = GpuChoice::parse(gpu);
  if (!egl_present())
    throw Error(ExitStatus::usage, fmt::format("gpu: EGL or OpenGL is missing here; {}", what_to_install));

  const std::vector<EGLDeviceEXT> all = devices();
  std::vector<EGLDeviceEXT> candidates;
  if (choice.mode == GpuChoice::Mode::device) {
    if (choice.device >= all.size())
      throw Error(ExitStatus::usage,
                  fmt::format("gpu: there is no device {}; this machine has {}", choice.device, all.size()));
    candidates = {all[choice.device]};
  } else {
    if (choice.mode == GpuChoice::Mode::automatic)
      std::copy_if(all.begin(), all.end(), std::back_inserter(candidates),
                   [](auto d) { return !is_software(d); });
    std::copy_if(all.begin(), all.end(), std::back_inserter(candidates), is_software);
  }
  for (EGLDeviceEXT device : candidates)
    if (try_device(device)) return;

  // Older EGL cannot list devices; Mesa's surfaceless platform is then whatever the driver loader picks.
  if (choice.mode != GpuChoice::Mode::device && has_word(client_extensions(), "EGL_EXT_platform_base") &&
      has_word(client_extensions(), "EGL_MESA_platform_surfaceless") &&
      try_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)) &&
      (choice.mode == GpuChoice::Mode::automatic || software()))
    return;
  const std::string why = refusal_.empty() ? "" : fmt::format(" ({})", refusal_);
  throw Error(ExitStatus::usage,
              fmt::format("gpu: no usable OpenGL 4.3 for \"{}\"{}; {}", gpu, why, what_to_install));
}

bool EglContext::try_device(void* device) {
  return try_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
}

bool EglContext::try_display(void* display) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
    refusal_ = egl_error() + " on opening the device";
    return false;
  }
  const char* words = eglQueryString(display, EGL_EXTENSIONS);
  if (!has_word(words, "EGL_KHR_surfaceless_context") || !has_word(words, "EGL_KHR_create_context")) {
    refusal_ = "the driver needs a window";
    return false;
  }
  EGLConfig config = nullptr;  // EGL_NO_CONFIG_KHR
  if (!has_word(words, "EGL_KHR_no_config_context")) {
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                       EGL_NONE};
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted.data(), &config, 1, &count) || count == 0) {
      refusal_ = egl_error() + " on choosing a configuration";
      return false;
    }
  }
  const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         4,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         3,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                         EGL_NONE};
  EGLContext context = EGL_NO_CONTEXT;
  if (eglBindAPI(EGL_OPENGL_API))
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT) {
    refusal_ = egl_error() + " on asking for OpenGL 4.3";
    return false;
  }
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
    refusal_ = egl_error() + " on making the context current";
    eglDestroyContext(display, context);
    return false;
  }
  // A display belongs to the whole process and to every context on it, so it is never terminated.
  if (context_) eglDestroyContext(display_, context_);
  display_ = display, context_ = context;
  const auto text = [](GLenum name) {
    const GLubyte* string = glGetString(name);
    return string ? std::string(reinterpret_cast<const char*>(string)) : std::string("unknown");
  };
  renderer_ = text(GL_RENDERER), version_ = text(GL_VERSION);
  return true;
}

EglContext::~EglContext() {
  if (!context_) return;
  if (eglGetCurrentContext() == context_)
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

bool EglContext::software() const {
  const auto named = [&](const char* name) { return renderer_.find(name) != std::string::npos; };
  return named("llvmpipe") || named("softpipe") || named("swrast") || named("SWR") ||
         named("Software Rasterizer");
}

}  // namespace veduta

// Which EGL device each worker of a host draws on (DESIGN §8).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace veduta {

/// An EGL device as probing found it. EGL counts devices in another order than CUDA.
struct Device {
  uint32_t number = 0;  ///< for --gpu
  bool software = true;
  std::optional<int> cuda;  ///< CUDA's number, where the driver tells it
  std::string text;         ///< "0: hardware /dev/dri/card0 cuda 3"
  std::string refusal;      ///< why nothing can be drawn on it; empty when something can
};

/// From a line of `veduta-worker --probe`; nullopt for any other line.
std::optional<Device> parse_device(const std::string& line);

/// The devices of this host; empty when there is none or the list cannot be had. Each is tried in a child of
/// its own: drivers have been seen to crash on a device that the scheduler hides from the job. \param
/// software_too  try software renderers as well; they are only listed otherwise
std::vector<Device> probe_devices(bool software_too = false);

/// What the workers of a host get as --gpu, in turn (gpu_of_worker); one element at least.
/// \param gpu           as the user gave it: auto, software or a number
/// \param cuda_visible  value of CUDA_VISIBLE_DEVICES, may be null: with auto, the usable devices that it
/// names, in its
///                      order; all usable ones when it names none of them (then it counts in numbers of its
///                      own)
std::vector<std::string> gpus_in_turn(const std::vector<Device>& devices, const std::string& gpu,
                                      const char* cuda_visible);

/// The element for a worker of a host's rank `local_rank` of `local_ranks`: the first workers of all ranks
/// come first, then the second ones, so that ranks may have different numbers of workers.
const std::string& gpu_of_worker(const std::vector<std::string>& gpus, uint32_t local_rank,
                                 uint32_t local_ranks, uint32_t worker);

}  // namespace veduta

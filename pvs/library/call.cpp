#include "pvs/library/call.h"

#include <hdf5.h>

#include "pvs/library/veduta/pvs.h"
#include "scene/error.h"

namespace veduta::pvs {
namespace {

class HostSettings {
 public:
  HostSettings()
      : has_printer_(H5Eget_auto2(H5E_DEFAULT, &printer_, &printed_to_) >= 0),
        has_plugins_(H5PLget_loading_state(&plugins_) >= 0) {}
  ~HostSettings() {
    if (has_printer_) H5Eset_auto2(H5E_DEFAULT, printer_, printed_to_);
    if (has_plugins_) H5PLset_loading_state(plugins_);
  }
  HostSettings(const HostSettings&) = delete;
  HostSettings& operator=(const HostSettings&) = delete;

 private:
  H5E_auto2_t printer_ = nullptr;
  void* printed_to_ = nullptr;
  unsigned plugins_ = 0;
  bool has_printer_, has_plugins_;
};

}  // namespace

void call(const std::function<void()>& read) {
  const HostSettings settings;
  call_without_hdf5(read);
}

void call_without_hdf5(const std::function<void()>& read) {
  try {
    read();
  } catch (const veduta::Error& error) {
    throw Error(error.what());
  }
}

}  // namespace veduta::pvs

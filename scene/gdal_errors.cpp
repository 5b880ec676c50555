#include "scene/gdal_errors.h"

#include <cpl_error.h>

#include "scene/text.h"

namespace veduta {
namespace {

void keep(CPLErr level, CPLErrorNum, const char* message) {
  if (level >= CE_Failure) static_cast<GdalErrors*>(CPLGetErrorHandlerUserData())->add(message);
}

}  // namespace

GdalErrors::GdalErrors() {
  CPLPushErrorHandlerEx(keep, this);
  CPLSetCurrentErrorHandlerCatchDebug(FALSE);
}

GdalErrors::~GdalErrors() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

void GdalErrors::add(const char* message) {
  if (first_.empty()) first_ = printable(message);
}

}  // namespace veduta

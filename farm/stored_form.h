// A verification as a file keeps it.
#pragma once

#include "pvs/verification.h"
#include "verify/verify.h"

namespace veduta {

/// Dated now.
Verification stored_form(const VerifyReport& report, const VerifyOptions& options);

}  // namespace veduta

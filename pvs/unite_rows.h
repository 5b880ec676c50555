// Two rows as one: what either of two eyes may see (thesis §5.1.4: they may be in two cells).
#pragma once

#include "pvs/visibility.h"

namespace veduta {

/// Replaces `out`, which is neither of the rows, by entries that together draw what `a` or `b` draws and
/// nothing else, by ascending object. Three bytes cannot say every union: an object may then have two
/// entries, one after the other, of which only the first has a z byte. What was united may be united again,
/// for more than two eyes: an object then has at most as many entries as there were rows.
void unite_rows(const PvsRow& a, const PvsRow& b, PvsRow& out);

}  // namespace veduta

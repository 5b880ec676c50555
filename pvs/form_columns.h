// Forms in HDF5.
#pragma once

#include "pvs/forms.h"
#include "pvs/hdf5_input.h"
#include "pvs/pvs_check.h"

namespace veduta {

/// Digests are compared, and the forms held against the slices of their objects.
inline Forms read_forms(const hdf5::Input& input, const std::vector<SliceCounts>& slices,
                        ColumnDigests& digests) {
  Forms forms;
  digests[column::pvs_form_begin.path] =
      hdf5::ColumnReader(input, column::pvs_form_begin).read_into(forms.begin);
  digests[column::pvs_form_index.path] =
      hdf5::ColumnReader(input, column::pvs_form_index).read_into(forms.index);
  input.refuse(find_form_defect(forms, slices));
  return forms;
}

}  // namespace veduta

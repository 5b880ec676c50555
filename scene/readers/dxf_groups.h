// DXF as it lies in the file: pairs of a group code and a value, each on a line of its own.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/text.h"

namespace veduta {

/// Walks over the groups of an ASCII DXF file. Comments (999) are passed over.
class DxfGroups {
 public:
  /// The file must outlive this. \throw Error(bad_input) for binary DXF, DWG and what is not DXF at all
  explicit DxfGroups(const InputFile& file);

  /// To the next group. \throw Error(bad_input) when the file ends: one that is complete ends with 0/EOF,
  /// which is not asked further
  void next();
  int code() const { return code_; }
  std::string_view value() const { return value_; }  ///< without blanks around it
  bool is(int code, std::string_view value) const { return code_ == code && value_ == value; }
  uint64_t line() const { return line_; }  ///< of the value, from 1

  /// The value as a number. \throw Error(bad_input) when it is none, or not finite
  double real() const;
  int64_t integer() const;

  Error error(const std::string& what) const;  ///< at the line of the value
  std::string place() const;                   ///< "city.dxf: line 12"
  const InputFile& file() const { return file_; }

 private:
  std::string_view take_line();

  const InputFile& file_;
  std::string_view rest_;
  int code_ = -1;
  std::string_view value_;
  uint64_t line_ = 0;
};

/// A name in a DXF file as UTF-8 on one line: "\U+00E9" becomes its character, and what is not UTF-8 is taken
/// to be Latin-1 (ANSI_1252).
std::string dxf_name(std::string_view value);

}  // namespace veduta

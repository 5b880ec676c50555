// What GDAL, PROJ and GEOS complain about, kept for a message of ours instead of going to stderr.
#pragma once

#include <string>

namespace veduta {

/// While it lives, errors and warnings of GDAL on this thread go here. Errors only are kept. Scopes nest.
class GdalErrors {
 public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  /// The first error since construction or clear(), on one printable line; empty if there was none.
  const std::string& first() const { return first_; }
  void clear() { first_.clear(); }
  void add(const char* message);

 private:
  std::string first_;
};

}  // namespace veduta

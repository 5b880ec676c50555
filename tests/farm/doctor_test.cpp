#include "farm/doctor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace veduta {
namespace {

HostFindings host(const std::string& name, const std::string& version) {
  return {name, {{"veduta", version}, {"MPI", "Open MPI v4.1.4"}, {"HDF5", "1.10.8"}, {"cores", name}}};
}

TEST(Doctor, NamesVersionsThatDifferFromTheFirstHost) {
  EXPECT_EQ(differences({{0, host("n0", "0.1.0")}, {4, host("n1", "0.1.0")}}), "");
  EXPECT_EQ(differences({{0, host("n0", "0.1.0")}, {4, host("n1", "0.1.0")}, {8, host("n2", "0.2.0")}}),
            "difference  veduta: 0.1.0 on n0, 0.2.0 on n2\n");
}

TEST(Doctor, WhatIsMissingIsAFinding) {
  const auto findings = examine_host("/proc/no/such/directory");
  const auto writing = std::find_if(findings.begin(), findings.end(),
                                    [](const Finding& each) { return each.name == "writing"; });
  ASSERT_NE(writing, findings.end());
  EXPECT_FALSE(writing->good);
}

TEST(Doctor, AMarkIsSeenWhileItIsThere) {
  std::filesystem::path file;
  {
    const DoctorMark mark(testing::TempDir());
    file = mark.file();
    EXPECT_EQ(look_for_mark(file).value, "yes, locks too");
  }
  EXPECT_FALSE(look_for_mark(file).good);
}

}  // namespace
}  // namespace veduta

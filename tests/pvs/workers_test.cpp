// Who baked each cell: /cells/worker and /cells/worker_name, which a file may lack.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <nlohmann/json.hpp>

#include "tests/pvs/small_verification.h"

namespace veduta {
namespace {

using test::small_workers;
using test::status_of;

class PvsWorkers : public testing::Test {
 protected:
  std::string write(const CellSource& cells = test::small_row_of_worker,
                    const std::vector<std::string>& workers = small_workers) {
    return write_pvs(file_, test::small_city(), test::small_header(), cells, workers);
  }
  void remove(const char* dataset) const {
    const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(H5Ldelete(file, dataset, H5P_DEFAULT), 0);
    H5Fclose(file);
  }
  test::TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "a.h5";
};

TEST_F(PvsWorkers, AreReadAsTheyWereWritten) {
  write();
  const PvsFile file = read_pvs(file_);
  EXPECT_EQ(file.workers, small_workers);
  EXPECT_EQ(file.cell_worker, (std::vector<uint32_t>{0, 1, 0, 1, no_worker, 1, 0}));
}

TEST_F(PvsWorkers, StayWhenAVerificationIsStored) {
  write();
  store_verification(file_, read_pvs(file_), test::small_verification());
  EXPECT_EQ(read_pvs(file_).workers, small_workers);
  EXPECT_EQ(read_pvs(file_).verification, test::small_verification());
}

TEST_F(PvsWorkers, AreNotOfTheContent) {
  const std::string digest = write();
  EXPECT_EQ(write(test::small_row, {}), digest);
  EXPECT_TRUE(read_pvs(file_).workers.empty());
  EXPECT_TRUE(read_pvs(file_).cell_worker.empty());
}

TEST_F(PvsWorkers, AFileWithoutThemReadsAndOneWithHalfOfThemDoesNot) {
  write();
  remove("/cells/worker");
  std::string message;
  EXPECT_EQ(status_of([&] { read_pvs(file_); }, &message), ExitStatus::bad_input);
  EXPECT_NE(message.find("/cells/worker: missing"), std::string::npos) << message;
  remove("/cells/worker_name");
  EXPECT_TRUE(read_pvs(file_).workers.empty());
}

TEST_F(PvsWorkers, OutOfRangeAreADefectOfWhoWrites) {
  const auto cells = [](uint32_t c) {
    BakedCell cell = test::small_row(c);
    cell.worker = 2;
    return cell;
  };
  EXPECT_EQ(status_of([&] { write(cells); }), ExitStatus::defect);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(PvsWorkers, AreDescribed) {
  write();
  const PvsFile file = read_pvs(file_);
  EXPECT_NE(describe(file, file_).find("workers    2; 0001-r0-w0 baked most, 3 cells"), std::string::npos)
      << describe(file, file_);
  const auto json = nlohmann::json::parse(describe_json(file, file_));
  ASSERT_EQ(json.at("workers").size(), 2u);
  EXPECT_EQ(json["workers"][1]["name"], small_workers[1]);
  EXPECT_EQ(json["workers"][1]["cells"], 3);
  write(test::small_row, {});
  EXPECT_NE(describe(read_pvs(file_), file_).find("workers    not known"), std::string::npos);
}

}  // namespace
}  // namespace veduta

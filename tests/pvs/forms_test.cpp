#include "pvs/forms.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "pvs/hdf5_output.h"
#include "pvs/pvs_check.h"
#include "pvs/pvs_stream.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

TEST(Forms, AreNumberedInTheOrderInWhichTheyCome) {
  FormTable table(3);
  EXPECT_EQ(table.number({2, {0, 0, 1}}), 0);
  EXPECT_EQ(table.number({0, {-3, 0, 2}}), 0);
  EXPECT_EQ(table.number({2, {0, 5, 0}}), 1);
  EXPECT_EQ(table.number({0, {-3, 0, 2}}), 0);
  EXPECT_EQ(table.number({2, {0, 0, 1}}), 0);
  EXPECT_EQ(table.number({2, {5, 0, 0}}), 2);
  const Forms forms = table.forms();
  EXPECT_EQ(forms.begin, (std::vector<uint64_t>{0, 1, 1, 4}));
  EXPECT_EQ(forms.index, (std::vector<VisibilityIndex>{{-3, 0, 2}, {0, 0, 1}, {0, 5, 0}, {5, 0, 0}}));
}

TEST(Forms, AreFoundAgain) {
  std::mt19937 random(2);
  std::vector<PvsEntry> entries(20000);
  for (PvsEntry& entry : entries) {
    entry.object = random() % 40 * 1000;
    entry.index = {static_cast<int8_t>(random() % 5 - 2), 0, static_cast<int8_t>(random() % 4)};
  }
  FormTable table(40000);
  std::vector<uint16_t> numbers;
  for (const PvsEntry& entry : entries) numbers.push_back(table.number(entry));
  EXPECT_EQ(table.size(), 40u * 5 * 4);
  const Forms forms = table.forms();
  for (size_t i = 0; i < entries.size(); ++i) {
    PvsEntry got{entries[i].object, {}};
    ASSERT_TRUE(forms.set(numbers[i], got));
    ASSERT_EQ(got, entries[i]) << i;
  }
}

/// A number of two bytes is enough for all that an object of 127 x 127 x 127 slices can have.
TEST(Forms, AllThatAnObjectCanHave) {
  FormTable table(1);
  const std::vector<SliceCounts> slices{{127, 127, 127}};
  std::vector<PvsEntry> entries;
  for (int x = -127; x <= 127; ++x)
    for (int y = -127; y <= 127; ++y)
      for (int z = 0; z <= 127; ++z) {
        const PvsEntry entry{0, {static_cast<int8_t>(x), static_cast<int8_t>(y), static_cast<int8_t>(z)}};
        if (!find_defect(&entry, &entry + 1, slices)) entries.push_back(entry);
      }
  ASSERT_EQ(entries.size(), 64895u);
  for (size_t i = 0; i < entries.size(); ++i) ASSERT_EQ(table.number(entries[i]), i);
  EXPECT_EQ(find_form_defect(table.forms(), slices), std::nullopt);
}

TEST(Forms, DoNotReachIntoThoseOfTheNextObject) {
  const Forms forms{{0, 2, 2, 3}, {{0, 0, 1}, {0, 0, 2}, {1, 0, 0}}};
  PvsEntry first{0, {}}, second{1, {}}, third{2, {}};
  EXPECT_TRUE(forms.set(1, first));
  EXPECT_EQ(first.index, (VisibilityIndex{0, 0, 2}));
  EXPECT_FALSE(forms.set(2, first));
  EXPECT_FALSE(forms.set(65535, first));
  EXPECT_FALSE(forms.set(0, second));
  EXPECT_TRUE(forms.set(0, third));
  EXPECT_FALSE(forms.set(1, third));
}

TEST(Forms, DefectsAreFound) {
  const std::vector<SliceCounts> slices{{4, 1, 2}, {1, 1, 1}};
  const auto defect = [&](const std::vector<uint64_t>& begin, const std::vector<VisibilityIndex>& index) {
    return find_form_defect({begin, index}, slices).value_or("none");
  };
  const VisibilityIndex whole = completely_visible;
  EXPECT_EQ(defect({0, 1, 2}, {whole, whole}), "none");
  EXPECT_EQ(defect({0, 0, 0}, {}), "none");
  const std::string bounds =
      "/pvs/form_begin: not one more than there are objects, from 0 to the number of forms";
  EXPECT_EQ(defect({0, 1}, {whole}), bounds);
  EXPECT_EQ(defect({}, {}), bounds);
  EXPECT_EQ(defect({1, 1, 2}, {whole, whole}), bounds);
  EXPECT_EQ(defect({0, 1, 3}, {whole, whole}), bounds);
  EXPECT_EQ(defect({0, 3, 2}, {whole, whole}), "/pvs/form_begin: object 0 ends before it begins");
  EXPECT_EQ(defect({0, 1, 2}, {whole, {1, 1, 0}}),
            "/pvs/form_index: form 1: 1, 1, 0 is outside of the slices of object 1");
  EXPECT_EQ(defect({0, 2, 2}, {{-3, 0, 2}, {-4, 0, 0}}),
            "/pvs/form_index: form 1: -4, 0, 0 is outside of the slices of object 0");
}

std::string sum(const std::vector<uint32_t>& steps, std::vector<uint32_t>* objects = nullptr) {
  std::vector<PvsEntry> entries;
  for (const uint32_t step : steps) entries.push_back({step, {}});
  const auto defect = sum_steps(entries.data(), entries.data() + entries.size(), 10);
  if (objects)
    for (const PvsEntry& entry : entries) objects->push_back(entry.object);
  return defect.value_or("none");
}

TEST(Steps, AddUp) {
  std::vector<uint32_t> objects;
  EXPECT_EQ(sum({0, 1, 5, 3}, &objects), "none");
  EXPECT_EQ(objects, (std::vector<uint32_t>{0, 1, 6, 9}));
  EXPECT_EQ(sum({}), "none");
  EXPECT_EQ(sum({10}), "object 10 of 10");
  EXPECT_EQ(sum({3, 0}), "object 3 comes twice");
  EXPECT_EQ(sum({3, 6, 1}), "object 10 of 10");
  EXPECT_EQ(sum({4, 0xfffffffe}), "object 4294967298 of 10") << "2 in 32 bits";
}

/// What a file says after one of its datasets was replaced by another, digest and all.
template <typename T>
std::string message_with(const Column& column, const std::vector<T>& rows) {
  test::TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row);
  {
    hdf5::Output output(directory / "a.h5", hdf5::Output::Start::go_on);
    output.remove(column.path);
    hdf5::write_rows(output, column, rows);
    output.close();
  }
  std::string message;
  EXPECT_EQ(test::status_of([&] { read_pvs(directory / "a.h5"); }, &message), ExitStatus::bad_input);
  EXPECT_EQ(test::status_of([&] { PvsStream(directory / "a.h5"); }), ExitStatus::bad_input);
  return message.substr(message.find(": ") + 2);
}

/// The file has rows {}, {0} and {0, 2}: steps 0, 0, 2; forms 0, 0, 0; of objects 0 and 2 one form each.
TEST(Forms, OfAFileThatDoNotFitTogetherAreRefused) {
  using Steps = std::vector<uint32_t>;
  EXPECT_EQ(message_with(column::pvs_object_step, Steps{0, 0, 0}),
            "/pvs/object_step: row 2: object 0 comes twice");
  EXPECT_EQ(message_with(column::pvs_object_step, Steps{0, 0, 6}), "/pvs/object_step: row 2: object 6 of 6");
  EXPECT_EQ(message_with(column::pvs_object_step, Steps{0, 0, 1}),
            "/pvs/form: entry 2: no such form of its object");
  EXPECT_EQ(message_with(column::pvs_object_step, Steps{0, 0}),
            "/pvs/form: not one for each of /pvs/object_step");
  EXPECT_EQ(message_with(column::pvs_form, std::vector<uint16_t>{0, 1, 0}),
            "/pvs/form: entry 1: no such form of its object");
  const std::string bounds =
      "/pvs/form_begin: not one more than there are objects, from 0 to the number of forms";
  EXPECT_EQ(message_with(column::pvs_form_begin, std::vector<uint64_t>{0, 1, 1, 2}), bounds);
  EXPECT_EQ(message_with(column::pvs_form_index, std::vector<VisibilityIndex>{completely_visible}), bounds);
  EXPECT_EQ(message_with(column::pvs_form_index, std::vector<VisibilityIndex>{{0, 0, 3}, {-3, 0, 2}}),
            "/pvs/form_index: form 0: 0, 0, 3 is outside of the slices of object 0");
}

}  // namespace
}  // namespace veduta

// docs/format.md says what the file holds: every dataset and attribute, and nothing else.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "pvs/hdf5_input.h"
#include "pvs/pvs_layout.h"
#include "tests/pvs/small_verification.h"

namespace veduta {
namespace {

const std::filesystem::path docs = std::filesystem::path(VEDUTA_TEST_DATA) / "../../docs";

std::string name_of(hdf5::Element element) {
  using hdf5::Element;
  static const std::map<Element, std::string> names = {
      {Element::f32, "f32"}, {Element::u8, "u8"},   {Element::u16, "u16"}, {Element::u32, "u32"},
      {Element::i8, "i8"},   {Element::i32, "i32"}, {Element::u64, "u64"}, {Element::text, "text"}};
  return names.at(element);
}

/// "f32[3]" of an attribute.
std::string type_of(hid_t attribute) {
  const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  std::string name = "text";
  if (H5Tget_class(type) != H5T_STRING) {
    const bool real = H5Tget_class(type) == H5T_FLOAT, is_signed = !real && H5Tget_sign(type) == H5T_SGN_2;
    name = (real ? "f" : is_signed ? "i" : "u") + std::to_string(8 * H5Tget_size(type));
  }
  H5Tclose(type);
  H5Sclose(space);
  return count == 1 ? name : name + "[" + std::to_string(count) + "]";
}

/// Every attribute of a file: object@name, and its type.
std::map<std::string, std::string> attributes_of(const std::filesystem::path& path) {
  std::map<std::string, std::string> found;
  const auto visit = [](hid_t root, const char* name, const H5O_info_t*, void* out) -> herr_t {
    const std::string object = std::string(name) == "." ? "/" : "/" + std::string(name);
    const hid_t opened = H5Oopen(root, name, H5P_DEFAULT);
    for (int i = 0; i < H5Aget_num_attrs(opened); ++i) {
      const hid_t attribute = H5Aopen_by_idx(opened, ".", H5_INDEX_NAME, H5_ITER_INC, static_cast<hsize_t>(i),
                                             H5P_DEFAULT, H5P_DEFAULT);
      char text[256] = {};
      H5Aget_name(attribute, sizeof text, text);
      (*static_cast<std::map<std::string, std::string>*>(out))[object + "@" + text] = type_of(attribute);
      H5Aclose(attribute);
    }
    H5Oclose(opened);
    return 0;
  };
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &found);
  H5Fclose(file);
  return found;
}

class FormatDoc : public testing::Test {
 protected:
  FormatDoc() {
    std::istringstream lines(text_);
    const std::regex row(R"(^\| `(/[^`]*)` \| ([^|]*) \| ([^|]*) \|.*)"), quoted("`([^`]+)`");
    std::smatch cell, name;
    for (std::string line; std::getline(lines, line);) {
      if (!std::regex_match(line, cell, row)) continue;
      const std::string second = cell[2];
      const bool attribute = std::regex_match(second, name, quoted);
      const std::string what = attribute ? cell[1].str() + "@" + name[1].str() : cell[1].str();
      const std::string type = attribute ? cell[3].str() : second + " " + cell[3].str();
      const bool added = (attribute ? attributes_ : datasets_).emplace(what, type).second;
      EXPECT_TRUE(added) << what << " is there twice";
    }
  }
  const std::string text_ = test::read_bytes(docs / "format.md");
  std::map<std::string, std::string> datasets_;    ///< by path: type and shape
  std::map<std::string, std::string> attributes_;  ///< by path@name: type
};

TEST_F(FormatDoc, HasEveryDatasetWithItsTypeAndShapeAndNoOther) {
  std::map<std::string, std::string> expected;
  for (const Column* column : column::all) {
    const std::string description = column->description;
    const std::string shape = description.substr(0, description.find(']') + 1);
    expected[column->path] = name_of(column->element) + " " + shape;
  }
  EXPECT_EQ(datasets_, expected);
}

TEST_F(FormatDoc, HasEveryAttributeWithItsTypeAndNoOther) {
  test::TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row_of_worker,
            test::small_workers);
  store_verification(directory / "a.h5", read_pvs(directory / "a.h5"), test::small_verification());
  std::map<std::string, std::string> expected = attributes_of(directory / "a.h5");
  // Those that every dataset has are said once, in words.
  for (const auto& [path, type] : datasets_)
    for (const char* name : {"@description", "@digest"})
      EXPECT_EQ(expected.extract(path + name).mapped(), "text");
  EXPECT_EQ(attributes_, expected);
}

TEST_F(FormatDoc, NamesTheVersion) {
  const std::string version = std::to_string(pvs_version);
  EXPECT_NE(text_.find("This is **version " + version + "**"), std::string::npos);
  EXPECT_NE(text_.find("| `/` | `version` | u32 | " + version + " |"), std::string::npos);
  EXPECT_NE(text_.find("read version " + version + "."), std::string::npos);
  EXPECT_NE(text_.find("`veduta-city`, a version of its own (" + std::to_string(city_version) + ")"),
            std::string::npos);
  for (uint32_t v = 1; v <= pvs_version; ++v)
    EXPECT_NE(text_.find("\n| " + std::to_string(v) + " | "), std::string::npos) << v;
}

/// The two rows of its example, with the numbers that it gives.
TEST_F(FormatDoc, ExampleOfRowsIsWhatTheWriterWrites) {
  EXPECT_NE(text_.find("| `object_step` | 3 | 2 | 10 | 5 | 10 |"), std::string::npos);
  EXPECT_NE(text_.find("| `form` | 0 | 0 | 0 | 1 | 0 |"), std::string::npos);
  EXPECT_NE(text_.find("`form_index` is (0, 0, 1), (0, 0, 2), (0, 0, 1), (2, 0, 0)"), std::string::npos);
  test::TemporaryDirectory directory;
  const PvsRow rows[2] = {{{3, {0, 0, 1}}, {5, {0, 0, 2}}, {15, {2, 0, 0}}},
                          {{5, {0, 0, 1}}, {15, {2, 0, 0}}}};
  write_pvs(directory / "a.h5", test::small_city(19, 2), test::small_header(), [&](uint32_t c) {
    return BakedCell{CellStatus::baked, 0, rows[c]};
  });
  const hdf5::Input input(directory / "a.h5");
  const auto expect = [&]<typename T>(const Column& column, const std::vector<T>& expected) {
    std::vector<T> found;
    hdf5::ColumnReader(input, column).read_into(found);
    EXPECT_EQ(found, expected) << column.path;
  };
  expect(column::pvs_begin, std::vector<uint64_t>{0, 3, 5});
  expect(column::pvs_object_step, std::vector<uint32_t>{3, 2, 10, 5, 10});
  expect(column::pvs_form, std::vector<uint16_t>{0, 0, 0, 1, 0});
  expect(column::pvs_form_begin,
         std::vector<uint64_t>{0, 0, 0, 0, 1, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4});
  std::vector<VisibilityIndex> forms;
  hdf5::ColumnReader(input, column::pvs_form_index).read_into(forms);
  EXPECT_EQ(forms, (std::vector<VisibilityIndex>{{0, 0, 1}, {0, 0, 2}, {0, 0, 1}, {2, 0, 0}}));
}

TEST_F(FormatDoc, LeadsNowhereThatIsNot) {
  const std::regex link(R"(\]\(([^)#:]+)\))");
  size_t links = 0;
  for (std::sregex_iterator at(text_.begin(), text_.end(), link), end; at != end; ++at, ++links)
    EXPECT_TRUE(std::filesystem::exists(docs / (*at)[1].str())) << (*at)[1];
  EXPECT_GE(links, 4u);
}

}  // namespace
}  // namespace veduta

#include "scene/readers/cityjson.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/readers/cityjson_document.h"

namespace veduta {
namespace {

using cityjson::Element;
using std::string_view;

// simdjson is fast but does not say where it stopped; nlohmann's parser, which keeps no tree here, does.
class FailureFinder : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(size_t position, const std::string& token, const nlohmann::json::exception&) override {
    position_ = position;
    token_ = token;
    return false;
  }
  size_t position() const { return position_; }
  const std::string& token() const { return token_; }

 private:
  size_t position_ = 0;
  std::string token_;
};

Error parse_failure(const InputFile& file, size_t offset, string_view text, simdjson::error_code code) {
  if (code == simdjson::CAPACITY)
    return bad_input(file.name, "whole file",
                     "is larger than 4 GB; store it as CityJSONSeq (cjio FILE export jsonl)");
  FailureFinder finder;
  nlohmann::json::sax_parse(text.begin(), text.end(), &finder);
  const size_t position = offset + std::min(finder.position(), text.size());
  const string_view before = file.content().substr(0, position);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const bool ended = finder.position() >= text.size();
  const std::string what =
      ended && finder.position() > 0
          ? "ends in the middle (truncated?)"
          : printable(simdjson::error_message(code)) +
                (finder.token().empty() ? "" : " Near '" + printable(finder.token(), 40) + "'");
  return bad_input(file.name, "line " + std::to_string(line) + ", byte " + std::to_string(position),
                   "not valid JSON: " + what + "; export or download it again");
}

class CityJsonReader {
 public:
  CityJsonReader(const InputFile& file, ImportReport& report) : file_(file), report_(report) {
    model_.file = file.name;
  }

  RawModel read() {
    string_view text = file_.content();
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (!read_sequence(text)) {
      const Element document = parse(text);
      cityjson::Header header = cityjson::read_header(document, model_.file);
      adopt(header, "CityJSON ");
      cityjson::read_document(document, header, "", model_, report_);
    }
    return std::move(model_);
  }

 private:
  // A CityJSONSeq holds one JSON document a line, the first of them a CityJSON object. Whatever else there
  // is, a document over many lines for instance, is not a sequence.
  bool read_sequence(string_view text) {
    const size_t end = text.find('\n');
    const bool more_lines =
        end != string_view::npos && text.find_first_not_of(" \t\r\n", end) != string_view::npos;
    const bool named_so = file_.extension == ".jsonl" || file_.extension == ".cityjsonl";
    if (!more_lines && !named_so) return false;
    const string_view first_line = text.substr(0, end);
    Element element;
    if (parser_.parse(first_line.data(), first_line.size(), false).get(element) != simdjson::SUCCESS) {
      if (named_so) parse(first_line);  // says where
      return false;
    }
    // The parser's document is used again for each line: templates are copied into the header's own.
    simdjson::dom::parser header_parser;
    element = header_parser.parse(first_line.data(), first_line.size(), false).value();
    cityjson::Header header = cityjson::read_header(element, model_.file);
    adopt(header, "CityJSONSeq ");
    cityjson::read_document(element, header, "line 1: ", model_, report_);
    string_view rest = end == string_view::npos ? string_view() : text.substr(end + 1);
    for (uint64_t number = 2; !rest.empty(); ++number) {
      const size_t length = std::min(rest.find('\n'), rest.size());
      read_feature(rest.substr(0, length), header, number);
      rest.remove_prefix(std::min(length + 1, rest.size()));
    }
    return true;
  }

  void read_feature(string_view line, cityjson::Header& header, uint64_t number) {
    if (line.find_first_not_of(" \t\r") == string_view::npos) return;
    const std::string place = "line " + std::to_string(number);
    const Element feature = parse(line);
    string_view type;
    if (feature["type"].get(type) != simdjson::SUCCESS || type != "CityJSONFeature")
      throw bad_input(file_.name, place, "is not a CityJSONFeature; each line after the first must be one");
    cityjson::read_document(feature, header, place + ": ", model_, report_);
  }

  Element parse(string_view text) {
    Element element;
    const simdjson::error_code code = parser_.parse(text.data(), text.size(), false).get(element);
    if (code != simdjson::SUCCESS)
      throw parse_failure(file_, static_cast<size_t>(text.data() - file_.bytes.data()), text, code);
    return element;
  }

  void adopt(const cityjson::Header& header, const char* format) {
    model_.format = format + header.version;
    model_.crs = header.crs;
  }

  const InputFile& file_;
  ImportReport& report_;
  RawModel model_;
  simdjson::dom::parser parser_;
};

}  // namespace

RawModel read_cityjson(const InputFile& file, ImportReport& report) {
  return CityJsonReader(file, report).read();
}

}  // namespace veduta

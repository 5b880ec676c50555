// pugixml knows no namespaces: one pass over the tree resolves the prefixes and shortens the names in place,
// so that nobody else has to. It neither expands entities nor loads DTDs, and parses without recursion.
#include "scene/readers/citygml_document.h"

#include <algorithm>
#include <pugixml.hpp>
#include <unordered_map>

namespace veduta::citygml {
namespace {

using std::string_view;

constexpr int deepest = 1000;
constexpr string_view city_uri = "http://www.opengis.net/citygml/";

enum class Namespace { gml, city, xlink, other };

Namespace classify(string_view uri) {
  if (uri == "http://www.opengis.net/gml" || uri.starts_with("http://www.opengis.net/gml/"))
    return Namespace::gml;
  if (uri.starts_with(city_uri) || uri.starts_with("http://www.citygml.org/citygml/profiles/"))
    return Namespace::city;
  return uri == "http://www.w3.org/1999/xlink" ? Namespace::xlink : Namespace::other;
}

string_view prefix_of(string_view name) {
  const size_t colon = name.find(':');
  return colon == string_view::npos ? string_view() : name.substr(0, colon);
}

string_view local_of(string_view name) {
  const size_t colon = name.find(':');
  return colon == string_view::npos ? name : name.substr(colon + 1);
}

}  // namespace

struct Document::Tree {
  pugi::xml_document xml;
  std::unordered_map<string_view, pugi::xml_node> by_id;
  std::vector<size_t> line_ends;
};

// Walks the tree in the order of the file, without recursion.
class Document::Normaliser {
 public:
  Normaliser(const InputFile& file, Document& document) : file_(file), document_(document) {}

  void run() {
    pugi::xml_node node = document_.root();
    for (int depth = 0; node;) {
      enter(node, depth);
      if (const pugi::xml_node child = next_element(node.first_child())) {
        node = child;
        ++depth;
        continue;
      }
      leave(depth);
      pugi::xml_node next = next_element(node.next_sibling());
      while (!next && depth > 0) {
        node = node.parent();
        leave(--depth);
        if (depth > 0) next = next_element(node.next_sibling());
      }
      if (depth == 0) return;
      node = next;
    }
  }

 private:
  struct Binding {
    string_view prefix, uri;
    int depth;
  };

  static pugi::xml_node next_element(pugi::xml_node node) {
    while (node && node.type() != pugi::node_element) node = node.next_sibling();
    return node;
  }

  void enter(pugi::xml_node node, int depth) {
    if (depth > deepest)
      throw bad_input(file_.name, "line " + std::to_string(document_.line(node)),
                      "elements nest deeper than 1,000; this is no city model");
    ++document_.elements_;
    for (const pugi::xml_attribute attribute : node.attributes()) {
      const string_view name = attribute.name();
      if (name == "xmlns") bindings_.push_back({"", attribute.value(), depth});
      if (name.starts_with("xmlns:")) bindings_.push_back({name.substr(6), attribute.value(), depth});
    }
    if (bindings_.size() > most_bindings)
      throw bad_input(file_.name, "line " + std::to_string(document_.line(node)),
                      "more than 1,000 namespaces at once; this is no city model");
    const string_view uri = uri_of(prefix_of(node.name()));
    if (depth == 0) check_root(node, uri);
    for (const pugi::xml_attribute attribute : node.attributes()) take(node, attribute);
    const Namespace space = classify(uri);
    if (space == Namespace::gml || space == Namespace::city)
      rename(node, local_of(node.name()));
    else if (prefix_of(node.name()).empty())
      node.set_name("?");
  }

  void take(pugi::xml_node node, pugi::xml_attribute attribute) {
    const string_view local = local_of(attribute.name());
    const bool prefixed = local.size() < string_view(attribute.name()).size();
    const auto in = [&](Namespace space) {
      return !prefixed || classify(uri_of(prefix_of(attribute.name()))) == space;
    };
    if (local == "id" && in(Namespace::gml)) {
      attribute.set_name("id");
      document_.tree_->by_id.try_emplace(attribute.value(), node);
    } else if (local == "href" && in(Namespace::xlink)) {
      attribute.set_name("href");
    } else if (local == "srsName" && !prefixed) {
      std::vector<std::string>& known = document_.srs_names_;
      if (std::find(known.begin(), known.end(), attribute.value()) == known.end() &&
          known.size() < most_srs_names)
        known.emplace_back(attribute.value());
    }
  }

  void leave(int depth) {
    while (!bindings_.empty() && bindings_.back().depth >= depth) bindings_.pop_back();
  }

  string_view uri_of(string_view prefix) const {
    for (auto binding = bindings_.rbegin(); binding != bindings_.rend(); ++binding)
      if (binding->prefix == prefix) return binding->uri;
    return {};
  }

  // In place: a shorter name always fits.
  static void rename(pugi::xml_node node, string_view local) {
    if (local.size() < string_view(node.name()).size()) node.set_name(std::string(local).c_str());
  }

  void check_root(pugi::xml_node root, string_view uri) {
    const std::string place = "line " + std::to_string(document_.line(root));
    const string_view name = local_of(root.name());
    if (name != "CityModel" || classify(uri) != Namespace::city)
      throw bad_input(file_.name, place,
                      "the root is '" + printable(name, 40) + "' in namespace '" + printable(uri, 60) +
                          "', not the CityModel of CityGML; convert it to CityGML 2.0 or CityJSON");
    document_.version_ = printable(uri.substr(uri.find_last_of('/') + 1), 20);
    if (document_.version_ != "1.0" && document_.version_ != "2.0")
      throw bad_input(
          file_.name, place,
          "CityGML " + document_.version_ + " is not read, but 1.0 and 2.0 are; convert it (citygml-tools)");
  }

  static constexpr size_t most_bindings = 1000;  // each prefix is looked for among them
  static constexpr size_t most_srs_names = 16;   // more than one is already too many
  const InputFile& file_;
  Document& document_;
  std::vector<Binding> bindings_;
};

Document::Document(const InputFile& file) : tree_(std::make_unique<Tree>()) {
  const string_view text = file.content();
  for (size_t end = text.find('\n'); end != string_view::npos; end = text.find('\n', end + 1))
    tree_->line_ends.push_back(end);
  const pugi::xml_parse_result result = tree_->xml.load_buffer(text.data(), text.size());
  if (!result) {
    const auto offset = static_cast<size_t>(std::max<ptrdiff_t>(result.offset, 0));
    const auto line = std::upper_bound(tree_->line_ends.begin(), tree_->line_ends.end(), offset);
    throw bad_input(file.name, "line " + std::to_string(1 + (line - tree_->line_ends.begin())),
                    std::string("not well-formed XML: ") + result.description() +
                        " (truncated?); export or download it again");
  }
  Normaliser(file, *this).run();
}

Document::~Document() = default;

pugi::xml_node Document::root() const {
  return tree_->xml.document_element();
}

pugi::xml_node Document::find(string_view href) const {
  if (!href.starts_with('#')) return {};
  const auto found = tree_->by_id.find(href.substr(1));
  return found == tree_->by_id.end() ? pugi::xml_node() : found->second;
}

uint32_t Document::line(const pugi::xml_node& node) const {
  const auto offset = static_cast<size_t>(std::max<ptrdiff_t>(node.offset_debug(), 0));
  const auto end = std::lower_bound(tree_->line_ends.begin(), tree_->line_ends.end(), offset);
  return static_cast<uint32_t>(1 + (end - tree_->line_ends.begin()));
}

bool is_known(const pugi::xml_node& node) {
  const string_view name = node.name();
  return node.type() == pugi::node_element && name != "?" && name.find(':') == string_view::npos;
}

}  // namespace veduta::citygml

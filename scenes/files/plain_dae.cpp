#include <charconv>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "scenes/files/limits.hpp"
#include "scenes/files/mesh_checks.hpp"
#include "scenes/files/plain_model.hpp"
#include "scenes/files/words.hpp"

namespace skein::sim {
namespace {

constexpr std::string_view kXmlSpace = " \t\r\n";

constexpr std::size_t kMostInputs = 32;  ///< of a list of primitives

/// A COLLADA file whose parts are checked and removed in place.
class PlainDae {
 public:
  PlainDae(const std::filesystem::path& file, const std::string& bytes) : file_(file) {
    if (bytes.starts_with("PK")) wrong("a ZIP archive; unpack it");
    const pugi::xml_parse_result parsed = document_.load_buffer(
        bytes.data(), bytes.size(), pugi::parse_default | pugi::parse_trim_pcdata);  // Assimp does not know " Z_UP "
    if (!parsed) wrong(std::string(parsed.description()) + " at byte " + std::to_string(parsed.offset));
    root_ = document_.child("COLLADA");
    if (!root_) wrong("it has no element 'COLLADA'");
  }

  std::string plain() {
    for (const char* unused :
         {"library_animations", "library_animation_clips", "library_cameras", "library_controllers", "library_effects",
          "library_images", "library_lights", "library_materials", "library_physics_models",
          "library_physics_materials", "library_physics_scenes", "extra"}) {
      while (root_.remove_child(unused)) {
      }
    }
    check(root_, 0);
    check_accessors();
    check_geometries();
    if (instances_ > 0) {
      for (const pugi::xml_node scene : root_.child("library_visual_scenes").children("visual_scene")) {
        count_nodes(scene);
      }
    }
    std::ostringstream text;
    document_.save(text, "", pugi::format_raw);
    return text.str();
  }

 private:
  /// Checks the elements below this one, and removes what refers to materials.
  void check(pugi::xml_node parent, std::size_t depth) {
    if (depth > kDeepest) wrong("its elements are nested more than " + std::to_string(kDeepest) + " deep");
    for (pugi::xml_node child = parent.first_child(); child;) {
      const pugi::xml_node next = child.next_sibling();
      const std::string_view name = child.name();
      if (name == "bind_material" || name == "extra" || name.starts_with("instance_physics")) {
        parent.remove_child(child);
      } else {
        check_element(child, name);
        check(child, depth + 1);
      }
      child = next;
    }
  }

  void check_element(const pugi::xml_node& element, std::string_view name) {
    if (name == "instance_controller") {
      wrong("it has a skeleton or morph targets (instance_controller), which are not supported; export without them");
    }
    if (name == "float_array" || name == "matrix" || name == "translate" || name == "rotate" || name == "scale" ||
        name == "skew" || name == "lookat") {
      check_numbers(element);
    }
    if (name == "p" || name == "vcount") {
      const auto [list, is_new] = indices_.try_emplace(element.parent());
      if (is_new) lists_.push_back(element.parent());
      list->second += check_indices(element, name);
    }
    if (name == "float_array") {
      const std::size_t count = words(element);
      if (whole(element, "count", count + 1) != count) wrong("the count of a float_array is too small");
      if (!arrays_.emplace(element.attribute("id").value(), count).second) wrong("two float_arrays have the same id");
    }
    if (name == "accessor") accessors_.push_back(element);
    if (name == "input" && element.attribute("offset")) whole(element, "offset", kMostInputs);
    if (name == "unit") {
      const std::optional<float> metres = parsed_float(element.attribute("meter").as_string("1"));
      if (!metres || !std::isfinite(*metres) || !(*metres > 0.0F)) wrong("its unit is not a positive number of metres");
    }
    if (name == "instance_node") {
      ++instances_;
      if (!std::string_view(element.attribute("url").value()).starts_with('#')) {
        wrong("it needs another file: an instance_node has the url '" + shown(element.attribute("url").value()) + "'");
      }
    }
    if (name == "geometry") geometries_.emplace(element.attribute("id").value());
    if (name == "instance_geometry") {
      const std::string_view url = element.attribute("url").value();
      if (!url.starts_with('#')) {
        wrong("it needs another file: an instance_geometry has the url '" + shown(url) + "'");
      }
      needed_geometries_.emplace(url.substr(1));
    }
    if (name == "node") {
      const std::string id = element.attribute("id").value(), given = element.attribute("name").value();
      nodes_by_name_.emplace(id, element);
      if (given != id) nodes_by_name_.emplace(given, element);  // Assimp looks for both
    }
  }

  void check_numbers(const pugi::xml_node& element) const {
    for_each_word(element.text().get(), kXmlSpace, [&](std::string_view word) {
      const std::optional<float> number = parsed_float(word);
      if (!number || !std::isfinite(*number)) {
        wrong(std::string(element.name()) + ": a finite number is needed, not '" + shown(word) + "'");
      }
    });
  }

  /// @returns how many there are.
  std::size_t check_indices(const pugi::xml_node& element, std::string_view name) const {
    std::size_t indices = 0;
    for_each_word(element.text().get(), kXmlSpace, [&](std::string_view word) {
      std::uint32_t index = 0;
      const auto result = std::from_chars(word.data(), word.data() + word.size(), index);
      if (result.ec != std::errc() || result.ptr != word.data() + word.size()) {
        wrong(std::string(name) + ": an index is needed, not '" + shown(word) + "'");
      }
      ++indices;
      if (name == "vcount" && index > kMostCorners) {
        wrong("a face has more than " + std::to_string(kMostCorners) + " vertices");
      }
    });
    if (std::string_view(element.parent().name()) == "polygons" && indices > kMostCorners * kMostInputs) {
      wrong("a face has more than " + std::to_string(kMostCorners) + " vertices");
    }
    return indices;
  }

  /// Assimp reserves memory for as many primitives as a list announces, and reads as many values as an accessor
  /// announces, whether they are there or not.
  void check_accessors() const {
    for (const pugi::xml_node& list : lists_) whole(list, "count", indices_.at(list) + 1);
    for (const pugi::xml_node& accessor : accessors_) {
      const auto array = arrays_.find(std::string(accessor.attribute("source").value()).erase(0, 1));
      if (array == arrays_.end()) wrong("an accessor has no float_array");
      const std::size_t end = array->second + 1, count = whole(accessor, "count", end);
      if (count == 0) continue;  // of an empty object; its stride is that of others
      const std::size_t offset = accessor.attribute("offset") ? whole(accessor, "offset", end) : 0;
      const std::size_t stride = accessor.attribute("stride") ? whole(accessor, "stride", end) : 1;
      const auto params = accessor.children("param");
      if (static_cast<std::size_t>(std::distance(params.begin(), params.end())) > stride) {
        wrong("an accessor has more params than its stride");
      }
      if (offset + count * stride > array->second) wrong("an accessor needs more numbers than its float_array has");
    }
  }

  /// Assimp leaves out what it does not find.
  void check_geometries() const {
    for (const std::string& id : needed_geometries_) {
      if (!geometries_.contains(id))
        wrong("an instance_geometry has the url '#" + shown(id) + "', but no geometry has this id");
    }
  }

  static std::size_t words(const pugi::xml_node& element) {
    std::size_t count = 0;
    for_each_word(element.text().get(), kXmlSpace, [&](std::string_view) { ++count; });
    return count;
  }

  /// The attribute as a whole number below `end`.
  std::size_t whole(const pugi::xml_node& element, const char* name, std::size_t end) const {
    const std::string_view text = element.attribute(name).value();
    std::size_t number = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size() || number >= end) {
      wrong("'" + std::string(name) + "' of an element '" + shown(element.name()) + "' must be a whole number below " +
            std::to_string(end) + ", not '" + shown(text) + "'");
    }
    return number;
  }

  /// Counts nodes as Assimp copies them.
  void count_nodes(const pugi::xml_node& node) {
    if (++nodes_ > kMostNodes)
      wrong("it has more than " + std::to_string(kMostNodes) + " nodes, each instance counted");
    if (++depth_ > kDeepest) {
      wrong("its nodes are nested more than " + std::to_string(kDeepest) + " deep, or contain each other");
    }
    for (const pugi::xml_node child : node.children("node")) count_nodes(child);
    for (const pugi::xml_node instance : node.children("instance_node")) {
      const auto [begin, end] = nodes_by_name_.equal_range(instance.attribute("url").value() + 1);
      if (begin == end) {
        wrong("an instance_node has the url '" + shown(instance.attribute("url").value()) +
              "', but no node has this id");
      }
      for (auto node_of_name = begin; node_of_name != end; ++node_of_name) count_nodes(node_of_name->second);
    }
    --depth_;
  }

  [[noreturn]] void wrong(const std::string& what) const { refuse(file_, "not a readable COLLADA file: " + what); }

  const std::filesystem::path& file_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::multimap<std::string, pugi::xml_node> nodes_by_name_;
  std::vector<pugi::xml_node> lists_;              ///< of primitives, in the order of the file
  std::map<pugi::xml_node, std::size_t> indices_;  ///< how many each of them has; its order varies between runs
  std::map<std::string, std::size_t> arrays_;      ///< how many numbers each float_array has
  std::vector<pugi::xml_node> accessors_;
  std::set<std::string> geometries_;  ///< their ids
  std::set<std::string> needed_geometries_;
  std::size_t instances_ = 0;
  std::size_t nodes_ = 0;
  std::size_t depth_ = 0;
};

}  // namespace

std::string plain_dae(const std::filesystem::path& file, const std::string& bytes) {
  return PlainDae(file, bytes).plain();
}

}  // namespace skein::sim

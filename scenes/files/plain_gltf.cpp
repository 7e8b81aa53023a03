#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>
#include <vector>

#include "core/text/base64.hpp"
#include "scenes/files/limits.hpp"
#include "scenes/files/mesh_checks.hpp"
#include "scenes/files/plain_model.hpp"
#include "scenes/files/words.hpp"

namespace skein::sim {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kFloatCode = 5126, kUint8Code = 5121, kUint16Code = 5123, kUint32Code = 5125;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942, kMagic = 0x46546c67;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

void append_word(std::string& bytes, std::uint32_t word) {
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

class PlainGltf {
 public:
  PlainGltf(const std::filesystem::path& file, std::string_view bytes) : file_(file) {
    const bool binary = bytes.size() >= 4 && word_at(bytes, 0) == kMagic;
    const std::string_view text = binary ? chunks(bytes) : bytes;
    doc_ = Json::parse(text, nullptr, false);
    if (!doc_.is_object()) wrong("its text is not a JSON object");
    const std::string version = string(member(doc_, "asset"), "version");
    if (!version.starts_with("2.")) wrong("version '" + shown(version) + "' instead of 2.0");
    check_extensions();
  }

  std::string plain() {
    copied_ = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", Json::array()}};
    for (const char* name : {"nodes", "meshes", "accessors", "bufferViews"}) copied_[name] = Json::array();
    const Json roots = copy_nodes(scene(), 0);
    copied_["scenes"].push_back({{"nodes", roots}});
    if (binary_.empty()) check_count(file_, 0);
    copied_["buffers"] = {{{"byteLength", binary_.size()}}};
    return glb(copied_.dump(), binary_);
  }

 private:
  struct Elements {
    std::string_view bytes;  ///< at least stride * (count - 1) and one element
    std::size_t count = 0;
    std::size_t stride = 0;
    std::size_t size = 0;  ///< of one component
    std::uint32_t type = 0;
  };

  /// @returns the text of a .glb; its binary part is kept.
  std::string_view chunks(std::string_view bytes) {
    constexpr std::size_t kHead = 12, kChunkHead = 8;
    if (bytes.size() < kHead + kChunkHead) wrong("truncated");
    if (word_at(bytes, 4) != 2) wrong("version " + std::to_string(word_at(bytes, 4)) + " instead of 2");
    if (word_at(bytes, 8) != bytes.size()) {
      wrong("truncated, or damaged: its head says that it has " + std::to_string(word_at(bytes, 8)) + " bytes, not " +
            std::to_string(bytes.size()));
    }
    std::string_view text;
    for (std::size_t at = kHead; at + kChunkHead <= bytes.size();) {
      const std::size_t size = word_at(bytes, at), type = word_at(bytes, at + 4);
      at += kChunkHead;
      if (size > bytes.size() - at) wrong("truncated: a chunk is longer than the file");
      if (type == kJsonChunk && text.empty()) text = bytes.substr(at, size);
      if (type == kBinaryChunk && !chunk_) chunk_ = bytes.substr(at, size);
      at += size;
    }
    return text;
  }

  void check_extensions() const {
    for (const char* unsupported : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization",
                                    "EXT_mesh_gpu_instancing"}) {
      const auto used = doc_.find("extensionsUsed");
      if (used == doc_.end() || !used->is_array()) continue;
      if (std::find(used->begin(), used->end(), unsupported) != used->end()) {
        wrong("it uses " + std::string(unsupported) + ", which is not supported; export without it");
      }
    }
  }

  /// The scene to be read: the one that the file names, else the first one. A file may also have no scenes: then the
  /// scene consists of all nodes without a parent.
  const Json& scene() {
    if (doc_.contains("scenes") || doc_.contains("scene")) {
      const Json& scenes = list("scenes");
      return scenes[index(doc_, "scene", scenes.size(), 0)];
    }
    all_nodes_ = Json::object();
    if (!doc_.contains("nodes")) return all_nodes_;
    const Json& nodes = list("nodes");
    std::vector<bool> has_parent(nodes.size());
    for (const Json& node : nodes) {
      if (!node.is_object() || !node.contains("children")) continue;
      for (const Json& child : node["children"]) {
        if (child.is_number_unsigned() && child.get<std::uint64_t>() < nodes.size())
          has_parent[child.get<std::size_t>()] = true;
      }
    }
    for (std::size_t number = 0; number < nodes.size(); ++number) {
      if (!has_parent[number]) all_nodes_["nodes"].push_back(number);
    }
    return all_nodes_;
  }

  /// Copies the nodes that `parent` (a node or the scene) names, with their children. @returns their new numbers.
  Json copy_nodes(const Json& parent, std::size_t depth) {
    if (depth > kDeepest) wrong("its nodes are nested more than " + std::to_string(kDeepest) + " deep");
    const char* const key = depth == 0 ? "nodes" : "children";
    Json numbers = Json::array();
    if (!parent.is_object()) wrong("a node or scene is not an object");
    if (!parent.contains(key)) return numbers;
    const Json& nodes = list("nodes");
    seen_.resize(nodes.size());
    if (!parent[key].is_array()) wrong("'" + std::string(key) + "' is not a list");
    for (const Json& child : parent[key]) {
      const std::size_t number = index(child, key, nodes.size());
      if (seen_[number]) wrong("a node has two parents");
      seen_[number] = true;
      Json copy = Json::object();
      copy_transformation(nodes[number], copy);
      if (nodes[number].contains("mesh")) copy_mesh(nodes[number], copy);
      if (const Json children = copy_nodes(nodes[number], depth + 1); !children.empty()) copy["children"] = children;
      numbers.push_back(copied_["nodes"].size());
      copied_["nodes"].push_back(std::move(copy));
      if (copied_["nodes"].size() > kMostNodes) wrong("it has more than " + std::to_string(kMostNodes) + " nodes");
    }
    return numbers;
  }

  void copy_transformation(const Json& node, Json& copy) const {
    if (!node.is_object()) wrong("a node is not an object");
    constexpr std::array<std::pair<const char*, std::size_t>, 4> kParts = {
        {{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}};
    for (const auto& [name, size] : kParts) {
      if (!node.contains(name)) continue;
      const Json& numbers = node[name];
      const auto finite = [](const Json& number) {
        return number.is_number() && std::isfinite(static_cast<float>(number.get<double>()));
      };
      if (!numbers.is_array() || numbers.size() != size || !std::all_of(numbers.begin(), numbers.end(), finite)) {
        wrong("the " + std::string(name) + " of a node must have " + std::to_string(size) + " finite numbers");
      }
      copy[name] = numbers;
    }
  }

  void copy_mesh(const Json& node, Json& copy) {
    if (node.contains("skin")) wrong("it has a skeleton (skin), which is not supported; export without it");
    const Json& meshes = list("meshes");
    const std::size_t number = index(node, "mesh", meshes.size());
    if (!mesh_copies_.contains(number)) mesh_copies_[number] = copied_mesh(meshes[number]);
    if (mesh_copies_[number]) copy["mesh"] = *mesh_copies_[number];
  }

  /// @returns the number of the copy, or nothing if the mesh has no triangles.
  std::optional<std::size_t> copied_mesh(const Json& mesh) {
    constexpr std::uint64_t kTriangles = 4, kFan = 6;
    const Json& primitives = member(mesh, "primitives");
    if (!primitives.is_array()) wrong("'primitives' is not a list");
    Json copies = Json::array();
    for (const Json& primitive : primitives) {
      const std::size_t mode = index(primitive, "mode", kFan + 1, kTriangles);
      if (mode < kTriangles) continue;  // points and lines
      const Json& attributes = member(primitive, "attributes");
      if (!attributes.is_object() || !attributes.contains("POSITION")) continue;  // the standard allows this
      const Elements vertices = accessor(attributes, "POSITION", "VEC3");
      if (vertices.type != kFloatCode) wrong("positions must be floats (componentType 5126)");
      std::vector<std::uint32_t> corners = read_corners(primitive, vertices.count);
      if (mode == kTriangles) corners.resize(corners.size() / 3 * 3);
      if (corners.size() < 3) continue;
      triangles_ += mode == kTriangles ? corners.size() / 3 : corners.size() - 2;
      if (triangles_ > kMostTriangles) refuse_count(file_, "more");
      const std::vector<float> positions = read_positions(vertices, corners);
      copies.push_back({{"mode", mode},
                        {"attributes", {{"POSITION", append(positions, kFloatCode, "VEC3", positions.size() / 3)}}},
                        {"indices", append(corners, kUint32Code, "SCALAR", corners.size())}});
    }
    if (copies.empty()) return std::nullopt;
    copied_["meshes"].push_back({{"primitives", std::move(copies)}});
    return copied_["meshes"].size() - 1;
  }

  /// Reads all vertices. If there are fewer corners than vertices, reads one vertex for each corner instead, and
  /// numbers the corners anew: many primitives may share the vertices of a whole model.
  std::vector<float> read_positions(const Elements& vertices, std::vector<std::uint32_t>& corners) const {
    const bool some = corners.size() < vertices.count;
    const std::size_t count = some ? corners.size() : vertices.count;
    std::vector<float> positions(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t vertex = some ? corners[i] : i;
      std::memcpy(&positions[3 * i], vertices.bytes.data() + vertex * vertices.stride, 3 * sizeof(float));
    }
    if (some) std::iota(corners.begin(), corners.end(), 0u);
    for (const float coordinate : positions) {
      if (!std::isfinite(coordinate)) wrong("a vertex is not finite");
    }
    return positions;
  }

  /// The vertices of the corners in their order.
  std::vector<std::uint32_t> read_corners(const Json& primitive, std::size_t vertices) {
    std::vector<std::uint32_t> corners;
    if (!primitive.contains("indices")) {
      corners.resize(vertices);
      std::iota(corners.begin(), corners.end(), 0u);
      return corners;
    }
    const Elements elements = accessor(primitive, "indices", "SCALAR");
    const std::size_t size = elements.size;
    if (elements.type == kFloatCode) wrong("indices must be unsigned integers");
    corners.resize(elements.count);
    for (std::size_t i = 0; i < elements.count; ++i) {
      std::memcpy(&corners[i], elements.bytes.data() + i * elements.stride, size);  // little-endian
      if (corners[i] >= vertices) wrong("a triangle needs a vertex that the file does not have");
    }
    return corners;
  }

  Elements accessor(const Json& owner, const char* key, const std::string& type) {
    const Json& accessors = list("accessors");
    const Json& accessor = accessors[index(owner, key, accessors.size())];
    if (string(accessor, "type") != type) wrong(std::string(key) + " must have the type " + type);
    if (accessor.contains("sparse")) wrong("sparse accessors are not supported");
    Elements elements;
    elements.type = static_cast<std::uint32_t>(index(accessor, "componentType", kFloatCode + 1));
    elements.size = elements.type == kFloatCode || elements.type == kUint32Code ? 4
                    : elements.type == kUint16Code                              ? 2
                                                                                : 1;
    if (elements.size == 1 && elements.type != kUint8Code)
      wrong("unknown componentType " + std::to_string(elements.type));
    const std::size_t element = elements.size * (type == "VEC3" ? 3 : 1);
    const Json& views = list("bufferViews");
    const Json& view = views[index(accessor, "bufferView", views.size())];
    const std::string_view bytes =
        part(buffer(view), index(view, "byteOffset", kMostModelBytes, 0), index(view, "byteLength", kMostModelBytes));
    const std::size_t offset = index(accessor, "byteOffset", kMostModelBytes, 0);
    elements.stride = index(view, "byteStride", 253, element);
    elements.count = index(accessor, "count", kMostModelBytes);
    if (elements.stride < element) wrong("the byteStride of a bufferView is too small");
    if (elements.count == 0) wrong("an accessor has no elements");
    elements.bytes = part(bytes, offset, elements.stride * (elements.count - 1) + element);
    return elements;
  }

  std::string_view part(std::string_view bytes, std::size_t offset, std::size_t size) const {
    if (offset > bytes.size() || size > bytes.size() - offset) wrong("truncated: a part lies behind its buffer's end");
    return bytes.substr(offset, size);
  }

  /// The bytes of a view's buffer: the binary part of a .glb, or those that the text has.
  std::string_view buffer(const Json& view) {
    const Json& buffers = list("buffers");
    const std::size_t number = index(view, "buffer", buffers.size());
    if (!buffers[number].contains("uri")) {
      if (number == 0 && chunk_) return *chunk_;
      wrong("a buffer has neither data nor a uri");
    }
    const auto known = decoded_.find(number);
    if (known != decoded_.end()) return known->second;
    const std::string uri = string(buffers[number], "uri");
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = uri.find(kMark);
    if (!uri.starts_with("data:")) {
      wrong("its data are in another file, '" + shown(uri) + "'; export as one .glb file");
    }
    const auto bytes = mark == std::string::npos ? std::nullopt : read_base64(uri.substr(mark + kMark.size()));
    if (!bytes) wrong("the data of a buffer are not Base64");
    return decoded_.emplace(number, std::string(bytes->begin(), bytes->end())).first->second;
  }

  /// Appends the values to the binary part, as an accessor. @returns its number.
  std::size_t append(const auto& values, std::uint32_t type, const char* form, std::size_t count) {
    const std::size_t size = values.size() * sizeof values[0];
    copied_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}});
    binary_.append(reinterpret_cast<const char*>(values.data()), size);
    copied_["accessors"].push_back(
        {{"bufferView", copied_["bufferViews"].size() - 1}, {"componentType", type}, {"count", count}, {"type", form}});
    return copied_["accessors"].size() - 1;
  }

  static std::string glb(std::string text, const std::string& binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string bytes;
    for (const std::size_t word : {std::size_t{kMagic}, std::size_t{2}, 12 + 8 + text.size() + 8 + binary.size(),
                                   text.size(), std::size_t{kJsonChunk}}) {
      append_word(bytes, static_cast<std::uint32_t>(word));
    }
    bytes += text;
    append_word(bytes, static_cast<std::uint32_t>(binary.size()));
    append_word(bytes, kBinaryChunk);
    return bytes + binary;
  }

  const Json& member(const Json& owner, const char* key) const {
    if (!owner.is_object() || !owner.contains(key)) wrong("'" + std::string(key) + "' is missing");
    return owner[key];
  }

  std::string string(const Json& owner, const char* key) const {
    const Json& text = member(owner, key);
    if (!text.is_string()) wrong("'" + std::string(key) + "' is not text");
    return text.get<std::string>();
  }

  /// A list of the document.
  const Json& list(const char* key) const {
    const Json& found = member(doc_, key);
    if (!found.is_array()) wrong("'" + std::string(key) + "' is not a list");
    return found;
  }

  std::size_t index(const Json& owner, const char* key, std::size_t end, std::size_t otherwise) const {
    if (!owner.is_object()) wrong("'" + std::string(key) + "' is missing");
    if (!owner.contains(key) && otherwise < end) return otherwise;
    return index(owner, key, end);
  }

  /// A whole number below `end`: the value itself, or the member `key` of an object.
  std::size_t index(const Json& value, const char* key, std::size_t end) const {
    const Json& number = value.is_object() ? member(value, key) : value;
    const bool whole = number.is_number_unsigned();
    if (!whole || number.get<std::uint64_t>() >= end) {
      wrong("'" + std::string(key) + "' must be a whole number below " + std::to_string(end));
    }
    return number.get<std::size_t>();
  }

  [[noreturn]] void wrong(const std::string& what) const { refuse(file_, "not a readable glTF file: " + what); }

  const std::filesystem::path& file_;
  Json doc_;
  Json all_nodes_;  ///< the scene of a file without scenes
  Json copied_;
  std::optional<std::string_view> chunk_;
  std::map<std::size_t, std::string> decoded_;
  std::map<std::size_t, std::optional<std::size_t>> mesh_copies_;
  std::vector<bool> seen_;
  std::size_t triangles_ = 0;
  std::string binary_;
};

}  // namespace

std::string plain_gltf(const std::filesystem::path& file, const std::string& bytes) {
  return PlainGltf(file, bytes).plain();
}

}  // namespace skein::sim

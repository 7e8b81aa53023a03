#include "scenes/files/model_file.hpp"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <string>
#include <utility>

#include "core/files/file_bytes.hpp"
#include "scenes/files/limits.hpp"
#include "scenes/files/mesh_checks.hpp"
#include "scenes/files/plain_model.hpp"

namespace skein::sim {
namespace {

/// The only file that Assimp sees: whatever other name a file refers to does not exist.
class OneFile : public Assimp::IOSystem {
 public:
  OneFile(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

  bool Exists(const char* name) const override { return name == name_; }
  char getOsSeparator() const override { return '/'; }
  void Close(Assimp::IOStream* stream) override { delete stream; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (name != name_ || *mode != 'r') return nullptr;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
  }

 private:
  const std::string name_;
  const std::string bytes_;
};

struct PlainModel {
  std::string name;  ///< by whose extension Assimp chooses the reader
  std::string bytes;
  Eigen::Matrix3d R_WM;  ///< from the frame of Assimp's scene
};

PlainModel plain(const std::filesystem::path& file, ModelFormat format) {
  const std::string bytes = read_file_bytes(file, kMostModelBytes);
  if (bytes.empty()) refuse(file, "empty; a mesh is needed");
  const Eigen::Matrix3d as_is = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d from_y_up;
  from_y_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  switch (format) {
    case ModelFormat::kObj:
      return {"model.obj", plain_obj(file, bytes), as_is};
    case ModelFormat::kPly:
      return {"model.ply", plain_ply(file, bytes), as_is};
    case ModelFormat::kDae:
      return {"model.dae", plain_dae(file, bytes), from_y_up};
    default:
      return {"model.glb", plain_gltf(file, bytes), from_y_up};
  }
}

Eigen::Matrix4d matrix(const aiMatrix4x4& m) {
  Eigen::Matrix4d X;
  for (unsigned row = 0; row < 4; ++row) {
    for (unsigned column = 0; column < 4; ++column) X(row, column) = double{m[row][column]};
  }
  return X;
}

/// Collects the triangles of all nodes, in doubles until they are in frame W.
class Triangles {
 public:
  Triangles(const std::filesystem::path& file, const aiScene& scene) : file_(file), scene_(scene) {}

  /// @param X_WP  from the frame of the node's parent.
  void add(const aiNode& node, const Eigen::Matrix4d& X_WP) {
    const Eigen::Matrix4d X_WN = X_WP * matrix(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) refuse(file_, "holds a node without its mesh");
      add(*scene_.mMeshes[node.mMeshes[i]], X_WN);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], X_WN);
  }

  TriangleMesh take() {
    check_count(file_, mesh_.triangles.size());
    return std::move(mesh_);
  }

 private:
  void add(const aiMesh& part, const Eigen::Matrix4d& X_WN) {
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // a point or a line
      if (mesh_.triangles.size() == kMostTriangles) refuse_count(file_, "more");
      std::array<std::uint32_t, 3> triangle{};
      for (unsigned i = 0; i < 3; ++i) {
        if (face.mIndices[i] >= part.mNumVertices) refuse(file_, "holds a triangle without its vertices");
        const aiVector3D& v = part.mVertices[face.mIndices[i]];
        const Eigen::Vector4d p_N(double{v.x}, double{v.y}, double{v.z}, 1.0);
        const Eigen::Vector3f p_W = (X_WN * p_N).head<3>().cast<float>();
        check_vertex(file_, mesh_.triangles.size(), p_W);
        triangle[i] = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(p_W);
      }
      mesh_.triangles.push_back(triangle);
    }
  }

  const std::filesystem::path& file_;
  const aiScene& scene_;
  TriangleMesh mesh_;
};

}  // namespace

std::optional<ModelFormat> model_format(std::string_view extension) {
  if (extension == ".obj") return ModelFormat::kObj;
  if (extension == ".ply") return ModelFormat::kPly;
  if (extension == ".dae") return ModelFormat::kDae;
  if (extension == ".glb") return ModelFormat::kGlb;
  if (extension == ".gltf") return ModelFormat::kGltf;
  return std::nullopt;
}

TriangleMesh read_model(const std::filesystem::path& file, ModelFormat format) {
  PlainModel model = plain(file, format);
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFile(model.name, std::move(model.bytes)));  // the importer deletes it
  // Without meshes, Assimp would make up some that show the nodes.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* scene = importer.ReadFile(model.name, aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) refuse(file, std::string("Assimp cannot read it: ") + importer.GetErrorString());
  Eigen::Matrix4d X_WM = Eigen::Matrix4d::Identity();
  X_WM.topLeftCorner<3, 3>() = model.R_WM;
  Triangles triangles(file, *scene);
  triangles.add(*scene->mRootNode, X_WM);
  return triangles.take();
}

}  // namespace skein::sim

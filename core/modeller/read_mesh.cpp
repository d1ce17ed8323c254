#include "core/modeller/read_mesh.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "core/model/diagnostic_list.h"
#include "core/modeller/run_apart.h"

namespace limber {
namespace {

constexpr std::array<const char*, 5> kKinds = {".obj", ".ply", ".stl", ".gltf", ".glb"};

[[noreturn]] void refuse(const std::filesystem::path& file, std::string what, std::string remedy) {
  throw InputError({file.string(), std::move(what), std::move(remedy)});
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension)
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

void require_file(const std::filesystem::path& file) {
  using std::filesystem::file_type;
  std::error_code error;
  const file_type type = std::filesystem::status(file, error).type();
  if (type == file_type::directory) refuse(file, "is a folder", "name a file in it");
  const bool hidden = error == std::errc::permission_denied;
  if (hidden || (type == file_type::regular && !std::ifstream(file)))
    refuse(file, "may not be read by this user", "give the user permission to read it");
  if (type == file_type::not_found || type == file_type::none)
    refuse(file, "there is no such file", "check the path");
  if (type != file_type::regular) refuse(file, "is not a regular file", "check the path");
}

void require_readable(const std::filesystem::path& file, double scale) {
  if (!(scale > 0.0 && std::isfinite(scale)))
    refuse(file, say("the scale is ", scale), "give the metres in a unit of the file, above 0");
  const std::string kind = lower_extension(file);
  if (std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end())
    refuse(file, "is not an OBJ, PLY, STL or glTF file by its name",
           "let it end in .obj, .ply, .stl, .gltf or .glb");
  require_file(file);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) refuse(file, "cannot be read: " + error.message(), "check the path");
  if (bytes == 0) refuse(file, "is empty", "export the mesh again");
  if (bytes > kMostMeshBytes)
    refuse(file, say("has ", bytes, " bytes, more than ", kMostMeshBytes),
           "reduce the mesh to fewer triangles");
}

// "gltf glb" has "glb".
bool has_word(const std::string& words, const std::string& word) {
  return (" " + words + " ").find(" " + word + " ") != std::string::npos;
}

// Assimp looks into the file where the name leaves doubts; we read what the name says or nothing.
// There is more than one importer for glTF: by its version.
void keep_importers_of(const std::filesystem::path& file, Assimp::Importer& importer) {
  const std::string kind = lower_extension(file).substr(1);
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;)
    if (!has_word(importer.GetImporterInfo(i)->mFileExtensions, kind))
      importer.UnregisterLoader(importer.GetImporter(i));
}

// A mesh file may name further files, which come from its own folder or below, also by links.
class OwnFolder : public Assimp::DefaultIOSystem {
 public:
  explicit OwnFolder(const std::filesystem::path& file)
      : mesh_(canonical(file)), folder_(canonical(file.parent_path() / ".")) {}

  bool Exists(const char* file) const override {
    return allowed(file) && DefaultIOSystem::Exists(file);
  }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return allowed(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  bool allowed(const char* name) const {
    std::error_code error;
    const std::filesystem::path file = std::filesystem::canonical(name, error);
    if (error) return false;
    return file == mesh_ ||
           std::mismatch(folder_.begin(), folder_.end(), file.begin(), file.end()).first ==
               folder_.end();
  }

  std::filesystem::path mesh_, folder_;
};

void ask_for_bare_triangles(Assimp::Importer& importer) {
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(
      AI_CONFIG_PP_RVC_FLAGS,
      aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
          aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
          aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS);
}

constexpr unsigned kSteps = aiProcess_ValidateDataStructure | aiProcess_RemoveComponent |
                            aiProcess_Triangulate | aiProcess_SortByPType |
                            aiProcess_JoinIdenticalVertices;

// The product of the transforms on the way to a node, metres from the file's units.
struct Placed {
  const aiNode* node;
  aiMatrix4x4t<double> to_world;
};

aiMatrix4x4t<double> as_double(const aiMatrix4x4& m) {
  return {m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4,
          m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4};
}

Vec3 placed(const aiMatrix4x4t<double>& m, const aiVector3D& v, double scale) {
  const double x = v.x, y = v.y, z = v.z;
  return scale * Vec3(m.a1 * x + m.a2 * y + m.a3 * z + m.a4, m.b1 * x + m.b2 * y + m.b3 * z + m.b4,
                      m.c1 * x + m.c2 * y + m.c3 * z + m.c4);
}

// A mirror turns triangles round; they are turned back. A corner that the mesh does not have is -1,
// not a vertex of the next mesh.
void append(const aiMesh& from, const aiMatrix4x4t<double>& to_world, double scale,
            TriangleMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.positions.size());
  const bool mirrored = aiMatrix3x3t<double>(to_world).Determinant() < 0.0;
  for (unsigned i = 0; i < from.mNumVertices; ++i)
    mesh.positions.push_back(placed(to_world, from.mVertices[i], scale));
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) continue;
    MeshTriangle t;
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned corner = face.mIndices[k];
      t[k] = corner < from.mNumVertices ? first + static_cast<std::int32_t>(corner) : -1;
    }
    if (mirrored) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
}

bool affordable(const TriangleMesh& mesh, const aiMesh& next) {
  return mesh.triangles.size() + next.mNumFaces <= kMostMeshTriangles &&
         mesh.positions.size() + next.mNumVertices <= 3 * kMostMeshTriangles;
}

struct TooManyTriangles : std::runtime_error {
  using runtime_error::runtime_error;
};

// Throws TooManyTriangles.
TriangleMesh gathered(const aiScene& scene, double scale) {
  TriangleMesh mesh;
  std::vector<Placed> open = {{scene.mRootNode, {}}};
  while (!open.empty()) {
    const auto [node, parent] = open.back();
    open.pop_back();
    const aiMatrix4x4t<double> to_world = parent * as_double(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      const aiMesh& part = *scene.mMeshes[node->mMeshes[i]];
      if (!affordable(mesh, part))
        throw TooManyTriangles(say("has more than ", kMostMeshTriangles, " triangles"));
      append(part, to_world, scale, mesh);
    }
    for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], to_world});
  }
  return mesh;
}

// What the child process sends: a mesh, text that says why there is none, or that it is empty.
constexpr char kIsMesh = 'M';
constexpr char kIsText = 'T';
constexpr char kIsEmpty = 'E';

template <class T>
void put(std::string& bytes, const std::vector<T>& items) {
  const std::uint64_t n = items.size();
  bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
  bytes.append(reinterpret_cast<const char*>(items.data()), n * sizeof(T));
}

template <class T>
void take(const std::string& bytes, std::size_t& at, std::vector<T>& items) {
  std::uint64_t n = 0;
  std::memcpy(&n, bytes.data() + at, sizeof n);
  items.resize(n);
  std::memcpy(static_cast<void*>(items.data()), bytes.data() + at + sizeof n, n * sizeof(T));
  at += sizeof n + n * sizeof(T);
}

// What Assimp says of a scene without triangles.
bool means_empty(const std::string& error) {
  for (const char* text : {"contains no faces", "contains no vertices", "mNumMeshes is 0"})
    if (error.find(text) != std::string::npos) return true;
  return false;
}

// Assimp's own words are about its classes: not for the user.
std::string without_mesh(const std::filesystem::path& file, const std::string& error) {
  if (means_empty(error)) return {kIsEmpty};
  const std::string kind = lower_extension(file);
  const std::string others =
      kind == ".gltf" ? ", or a file that it names is not in its folder" : "";
  return kIsText + ("is cut short or is not a " + kind + " file" + others);
}

std::string imported(const std::filesystem::path& file, double scale) {
  try {
    Assimp::Importer importer;
    importer.SetIOHandler(new OwnFolder(file));  // the importer deletes it
    keep_importers_of(file, importer);
    ask_for_bare_triangles(importer);
    const aiScene* scene = importer.ReadFile(file.string(), kSteps);
    if (scene == nullptr || scene->mRootNode == nullptr)
      return without_mesh(file, importer.GetErrorString());
    const TriangleMesh mesh = gathered(*scene, scale);
    std::string bytes(1, kIsMesh);
    put(bytes, mesh.positions);
    put(bytes, mesh.triangles);
    return bytes;
  } catch (const TooManyTriangles& error) {
    return kIsText + std::string(error.what());
  } catch (const std::bad_alloc&) {
    return kIsText + std::string("takes more memory than a mesh may");
  } catch (const std::exception& error) {
    return without_mesh(file, error.what());
  }
}

// Assimp reads some ten MB a second on a slow machine; at a PLY header without end it never ends.
ApartLimits limits_for(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  ApartLimits limits;
  limits.seconds = 10 + static_cast<unsigned>(error ? 0 : bytes >> 20);
  return limits;
}

[[noreturn]] void refuse_empty(const std::filesystem::path& file) {
  refuse(file, "holds no triangles", "export surfaces, not points, lines or an empty scene");
}

constexpr const char* kWriteAnew = "write it anew, or convert it to another of these formats";

}  // namespace

// In another process: Assimp 5.2 as Debian builds it aborts at broken files.
TriangleMesh read_mesh(const std::filesystem::path& file, double scale) {
  require_readable(file, scale);
  const ApartResult result = run_apart([&] { return imported(file, scale); }, limits_for(file));
  if (!result.failure.empty()) refuse(file, "cannot be read: " + result.failure, kWriteAnew);
  if (result.bytes.front() == kIsEmpty) refuse_empty(file);
  if (result.bytes.front() != kIsMesh) refuse(file, result.bytes.substr(1), kWriteAnew);
  TriangleMesh mesh;
  mesh.name = file.stem().string();
  std::size_t at = 1;
  take(result.bytes, at, mesh.positions);
  take(result.bytes, at, mesh.triangles);
  if (mesh.triangles.empty()) refuse_empty(file);
  return mesh;
}

}  // namespace limber

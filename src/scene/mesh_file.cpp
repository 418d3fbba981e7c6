#include "scene/mesh_file.h"

#include "base/error.h"
#include "geometry/triangulate.h"
#include "scene/assimp_log.h"
#include "scene/file_axes.h"
#include "scene/mesh_file_check.h"
#include "scene/rig_import.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>

namespace weft {

namespace {

using Mat4 = Eigen::Matrix4d;

Mat4 to_eigen(const aiMatrix4x4& m) {
    Mat4 result;
    result << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
        m.d3, m.d4;
    return result;
}

/// assimp's own nodes for FBX pivots carry the object's name and a suffix.
constexpr const char* k_pivot_suffix = "_$AssimpFbx$";

std::string node_name(const aiNode& node) {
    const std::string name = node.mName.C_Str();
    return name.substr(0, name.find(k_pivot_suffix));
}

bool is_pivot(const aiNode& node) {
    return std::string_view(node.mName.C_Str()).find(k_pivot_suffix) != std::string_view::npos;
}

/// Adds one polygon to the object, cut into triangles, each with its corners' uv.
void add_face(const aiMesh& mesh, const aiFace& face, bool mirrored, FileObject& object) {
    const auto number = static_cast<Index>(object.faces++);
    std::vector<Vec3> corners;
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices) {
            object.bad_faces.push_back(number);
            return;
        }
        corners.push_back(object.positions[face.mIndices[k]]);
    }
    for (Triangle cut : triangulate_polygon(corners)) {
        if (mirrored) {
            std::swap(cut[1], cut[2]);
        }
        Triangle triangle{};
        std::array<Vec2, 3> uv;
        for (std::size_t k = 0; k < 3; ++k) {
            const unsigned v = face.mIndices[cut[k]];
            triangle[k] = static_cast<Index>(v);
            if (mesh.HasTextureCoords(0)) {
                uv[k] = Vec2(mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y);
            }
        }
        object.triangles.push_back(triangle);
        object.face_of_triangle.push_back(number);
        if (mesh.HasTextureCoords(0)) {
            object.corner_uv.push_back(uv);
        }
    }
}

FileObject read_object(const aiMesh& mesh, const Mat4& transform) {
    FileObject object;
    object.mesh_name = mesh.mName.C_Str();
    object.positions.reserve(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        const aiVector3D& p = mesh.mVertices[v];
        const Vec3 position(p.x, p.y, p.z);
        object.positions.emplace_back(transform.topLeftCorner<3, 3>() * position +
                                      transform.topRightCorner<3, 1>());
    }
    const bool mirrored = transform.topLeftCorner<3, 3>().determinant() < 0.0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        if (mesh.mFaces[f].mNumIndices < 3) {
            ++object.points_and_lines;
        } else {
            add_face(mesh, mesh.mFaces[f], mirrored, object);
        }
    }
    return object;
}

/// What a walk over the nodes has gathered.
struct Walk {
    std::vector<FileObject> objects;
    std::vector<ObjectOrigin> origins; ///< one an object
    Index nodes = 0;                   ///< met so far
};

void walk_nodes(const aiScene& scene,
                const aiNode& node,
                const Mat4& parent,
                std::vector<std::string> parents,
                Walk& walk) {
    const Mat4 transform = parent * to_eigen(node.mTransformation);
    const Index number = walk.nodes++;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        FileObject object = read_object(*scene.mMeshes[node.mMeshes[i]], transform);
        object.name = node_name(node);
        object.parents = parents;
        walk.objects.push_back(std::move(object));
        walk.origins.push_back({number, node.mMeshes[i]});
    }
    if (node.mNumMeshes == 0 &&
        !is_pivot(node)) { // a group; a node with a surface of its own stands for itself
        parents.push_back(node_name(node));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        walk_nodes(scene, *node.mChildren[i], transform, parents, walk);
    }
}

/// assimp's reason in one line, without the path that the message has already.
std::string one_line(std::string reason) {
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    const std::size_t no_reader = reason.find("No suitable reader found");
    return no_reader == std::string::npos ? reason : "not in a format that can be read, or damaged";
}

void name_the_nameless(std::vector<FileObject>& objects, const std::string& file_stem) {
    for (FileObject& object : objects) {
        if (object.name.empty() || object.name.front() == '<') { // '<OFFRoot>', '<STL_BINARY>'
            object.name = object.mesh_name.empty() ? file_stem : object.mesh_name;
        }
    }
}

} // namespace

MeshFile read_mesh_file(const std::filesystem::path& file, const std::string& name) {
    const std::string warning = check_mesh_file(file, name);
    const AssimpLog log;
    Assimp::Importer importer;
    // Without pivots as nodes of their own, assimp loses the animation of FBX joints that have an
    // orientation.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
    const aiScene* scene = nullptr;
    std::string reason;
    try {
        scene = importer.ReadFile(file.string(), 0);
        reason = importer.GetErrorString();
    } catch (const std::exception& error) {
        reason = error.what();
    }
    if (scene == nullptr || scene->mRootNode == nullptr) {
        fail_input("{}: cannot be read: {}", name, one_line(reason));
    }
    // assimp drops such faces of glTF and says so in its log alone.
    if (const std::string warning = log.find("out-of-range"); !warning.empty()) {
        fail_input("{}: {}", name, warning);
    }
    MeshFile result;
    if (!warning.empty()) {
        result.warnings.push_back(warning);
    }
    const FileAxes axes = read_file_axes(*scene);
    result.format = axes.format;
    result.states_unit = axes.states_unit;
    result.metres_per_unit = axes.metres_per_unit;
    result.states_up = axes.states_up;
    result.to_y_up = axes.to_y_up;
    result.up = axes.up;
    Walk walk;
    walk_nodes(*scene, *scene->mRootNode, axes.undo_root, {}, walk);
    result.objects = std::move(walk.objects);
    if (scene->HasAnimations()) {
        result.rig = std::make_shared<Rig>(read_rig(*scene, axes.undo_root, walk.origins));
    }
    name_the_nameless(result.objects, file.stem().string());
    return result;
}

} // namespace weft

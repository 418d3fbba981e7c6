#include "scene/mesh_file.h"

#include "base/eigen.h"
#include "base/error.h"
#include "geometry/triangulate.h"
#include "scene/format_checks.h"
#include "scene/rig.h"

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <assimp/commonMetaData.h>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace weft {
namespace {

class Collector : public Assimp::LogStream {
public:
    explicit Collector(std::vector<std::string>& lines) : lines_(lines) {}

    /// Lines look like "Warn,  T0: words\n".
    void write(const char* message) override {
        std::string line = message;
        const std::size_t start = line.find(": ");
        line = line.substr(start == std::string::npos ? 0 : start + 2);
        lines_.push_back(line.substr(0, line.find('\n')));
    }

private:
    std::vector<std::string>& lines_;
};

/// Collects what assimp warns of while it lives; assimp has one log for the process, so there may
/// be one of these at a time.
class AssimpLog {
public:
    AssimpLog();
    ~AssimpLog();
    AssimpLog(const AssimpLog&) = delete;
    AssimpLog& operator=(const AssimpLog&) = delete;

    /// The first warning that contains `words`, without its line end; "" when there is none.
    std::string find(const std::string& words) const;

private:
    std::vector<std::string> lines_;
};

AssimpLog::AssimpLog() {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new Collector(lines_), // the logger deletes it
                                               Assimp::Logger::Warn | Assimp::Logger::Err);
}

AssimpLog::~AssimpLog() {
    Assimp::DefaultLogger::kill();
}

std::string AssimpLog::find(const std::string& words) const {
    for (const std::string& line : lines_) {
        if (line.find(words) != std::string::npos) {
            return line;
        }
    }
    return "";
}

/// What a file says about its own unit and axes. assimp applies it for COLLADA (in the root node),
/// not for FBX and Blender; here all of them come out alike, in the file's own unit and axes.
struct FileAxes {
    std::string format; ///< assimp's words
    bool states_unit = false;
    double metres_per_unit = 1.0;
    bool states_up = false;
    Mat3 to_y_up = Mat3::Identity(); ///< the file's axes into x right, y up
    char up = 'y';
    Eigen::Matrix4d undo_root = Eigen::Matrix4d::Identity(); ///< goes before the root's transform
};

/// x, y, z of a z-up file into x, z, -y.
Mat3 z_up_to_y_up() {
    Mat3 turn;
    turn << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
    return turn;
}

int get_int(const aiMetadata& data, const char* key, int otherwise) {
    std::int32_t value = otherwise;
    return data.Get(key, value) ? value : otherwise;
}

double get_real(const aiMetadata& data, const char* key, double otherwise) {
    float single = 0.0F;
    double value = otherwise;
    if (data.Get(key, single)) {
        return single;
    }
    return data.Get(key, value) ? value : otherwise;
}

void read_fbx(const aiMetadata& data, FileAxes& axes) {
    const double centimetres = get_real(data, "UnitScaleFactor", 1.0);
    axes.states_unit = std::isfinite(centimetres) && centimetres > 0.0;
    axes.metres_per_unit = axes.states_unit ? 0.01 * centimetres : 1.0;
    const int up = get_int(data, "UpAxis", 1);
    const int right = get_int(data, "CoordAxis", 0);
    if (up < 0 || up > 2 || right < 0 || right > 2 || up == right) {
        return;
    }
    const Vec3 y = Vec3::Unit(up) * (get_int(data, "UpAxisSign", 1) < 0 ? -1.0 : 1.0);
    const Vec3 x = Vec3::Unit(right) * (get_int(data, "CoordAxisSign", 1) < 0 ? -1.0 : 1.0);
    axes.states_up = true;
    axes.up = "xyz"[up];
    // The third axis follows: a rotation, never a mirror.
    axes.to_y_up.row(0) = x.transpose();
    axes.to_y_up.row(1) = y.transpose();
    axes.to_y_up.row(2) = x.cross(y).transpose();
}

void read_collada(const aiNode& root, FileAxes& axes) {
    const aiMatrix4x4& m = root.mTransformation;
    Mat3 linear;
    linear << m.a1, m.a2, m.a3, m.b1, m.b2, m.b3, m.c1, m.c2, m.c3;
    const double scale = std::cbrt(linear.determinant());
    if (!(scale > 0.0)) {
        return;
    }
    axes.states_unit = true;
    axes.metres_per_unit = scale;
    axes.states_up = true;
    axes.to_y_up = (linear / scale).array().round().matrix(); // rotations by quarter turns
    Index up = 1;
    axes.to_y_up.row(1).cwiseAbs().maxCoeff(&up);
    axes.up = "xyz"[up];
    axes.undo_root.topLeftCorner<3, 3>() = axes.to_y_up.transpose() / scale;
}

/// Unit and axes by format: FBX has them in its global settings (unit factor in cm), COLLADA in its
/// root transform, Blender files are in metres and z-up, glTF in metres and y-up; others say
/// nothing.
FileAxes read_file_axes(const aiScene& scene) {
    FileAxes axes;
    aiString format;
    if (scene.mMetaData != nullptr && scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format)) {
        axes.format = format.C_Str();
    }
    const auto format_has = [&](const char* word) {
        return axes.format.find(word) != std::string::npos;
    };
    if (format_has("FBX")) {
        read_fbx(*scene.mMetaData, axes);
    } else if (format_has("Collada")) {
        read_collada(*scene.mRootNode, axes);
    } else if (format_has("glTF")) {
        axes.states_unit = axes.states_up = true;
    } else if (format_has("Blender")) {
        axes.states_unit = axes.states_up = true;
        axes.to_y_up = z_up_to_y_up();
        axes.up = 'z';
    }
    return axes;
}

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

#include "scene/file_axes.h"

#include <assimp/commonMetaData.h>
#include <assimp/scene.h>

#include <cmath>

namespace weft {

namespace {

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

} // namespace

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

} // namespace weft

#include "glb.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace weft {

namespace {

constexpr int k_float = 5126, k_byte = 5121, k_unsigned = 5125; // glTF component types

/// Collects the binary chunk and the accessors that describe it.
class Buffer {
public:
    /// @param type    "VEC3" ...
    /// @param bounds  `,"min":[..],"max":[..]` where glTF asks for it, else ""
    template <typename T>
    int add(const std::vector<T>& values,
            std::size_t count,
            const char* type,
            int component,
            const std::string& bounds = "") {
        while (bytes_.size() % 4 != 0) {
            bytes_.push_back('\0');
        }
        const std::size_t size = values.size() * sizeof(T);
        views_ << (accessors_count_ ? "," : "") << R"({"buffer":0,"byteOffset":)" << bytes_.size()
               << R"(,"byteLength":)" << size << "}";
        accessors_ << (accessors_count_ ? "," : "") << R"({"bufferView":)" << accessors_count_
                   << R"(,"componentType":)" << component << R"(,"count":)" << count
                   << R"(,"type":")" << type << '"' << bounds << "}";
        bytes_.append(reinterpret_cast<const char*>(values.data()), size);
        return accessors_count_++;
    }

    std::string json() const {
        std::ostringstream text;
        text << R"("buffers":[{"byteLength":)" << bytes_.size() << R"(}],"bufferViews":[)"
             << views_.str() << R"(],"accessors":[)" << accessors_.str() << "]";
        return text.str();
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::ostringstream views_, accessors_;
    int accessors_count_ = 0;
};

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value + 0.0);
    return text;
}

std::string list(const Eigen::Vector3d& v) {
    return "[" + number(v.x()) + "," + number(v.y()) + "," + number(v.z()) + "]";
}

std::string bounds_of(const std::vector<Eigen::Vector3d>& points) {
    Eigen::Vector3d low = points[0];
    Eigen::Vector3d high = points[0];
    for (const Eigen::Vector3d& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return R"(,"min":)" + list(low) + R"(,"max":)" + list(high);
}

template <typename V> void push(std::vector<float>& values, const V& v) {
    for (Eigen::Index i = 0; i < v.size(); ++i) {
        values.push_back(static_cast<float>(v[i]));
    }
}

/// The four heaviest joints of each vertex and their weights, which sum to 1.
void add_weights(const Eigen::MatrixXd& weights,
                 std::vector<std::uint8_t>& joints,
                 std::vector<float>& values) {
    std::vector<int> order(static_cast<std::size_t>(weights.cols()));
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
                         [&](int a, int b) { return weights(v, a) > weights(v, b); });
        double sum = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
            sum += weights(v, order[k]);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            joints.push_back(static_cast<std::uint8_t>(order[k]));
            values.push_back(static_cast<float>(weights(v, order[k]) / sum));
        }
    }
}

std::string mesh_json(Buffer& buffer, const Figure& figure, const Eigen::MatrixXd& weights) {
    std::vector<float> positions;
    for (const Eigen::Vector3d& p : figure.vertices) {
        push(positions, p);
    }
    std::vector<std::uint32_t> indices;
    for (const auto& t : figure.triangles) {
        for (const int v : t) {
            indices.push_back(static_cast<std::uint32_t>(v));
        }
    }
    std::vector<std::uint8_t> joints;
    std::vector<float> values;
    add_weights(weights, joints, values);
    const std::size_t n = figure.vertices.size();
    std::ostringstream text;
    text << R"("meshes":[{"name":"figure","primitives":[{"attributes":{"POSITION":)"
         << buffer.add(positions, n, "VEC3", k_float, bounds_of(figure.vertices))
         << R"(,"JOINTS_0":)" << buffer.add(joints, n, "VEC4", k_byte) << R"(,"WEIGHTS_0":)"
         << buffer.add(values, n, "VEC4", k_float) << R"(},"indices":)"
         << buffer.add(indices, indices.size(), "SCALAR", k_unsigned) << "}]}]";
    return text.str();
}

/// Node 0 carries the mesh, node 1 + j is joint j.
std::string nodes_json(Buffer& buffer, const Skeleton& skeleton) {
    std::ostringstream text;
    std::vector<float> inverse_binds;
    text << R"("nodes":[{"name":"figure","mesh":0,"skin":0})";
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint& joint = skeleton.joints[j];
        const Eigen::Vector3d above =
            joint.parent < 0 ? Eigen::Vector3d::Zero()
                             : skeleton.joints[static_cast<std::size_t>(joint.parent)].place;
        text << R"(,{"name":")" << joint.name << R"(","translation":)" << list(joint.place - above);
        std::string children;
        for (std::size_t c = 0; c < skeleton.joints.size(); ++c) {
            if (skeleton.joints[c].parent == static_cast<int>(j)) {
                children += (children.empty() ? "" : ",") + std::to_string(c + 1);
            }
        }
        text << (children.empty() ? "" : R"(,"children":[)" + children + "]") << "}";
        Eigen::Matrix4f inverse = Eigen::Matrix4f::Identity();
        inverse.topRightCorner<3, 1>() = -joint.place.cast<float>();
        inverse_binds.insert(inverse_binds.end(), inverse.data(), inverse.data() + 16);
    }
    text << R"(],"scenes":[{"nodes":[0,1]}],"scene":0,"skins":[{"inverseBindMatrices":)"
         << buffer.add(inverse_binds, skeleton.joints.size(), "MAT4", k_float) << R"(,"joints":[)";
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        text << (j ? "," : "") << j + 1;
    }
    text << "]}]";
    return text.str();
}

std::string animation_json(Buffer& buffer,
                           const std::string& name,
                           const Skeleton& skeleton,
                           const PoseSequence& sequence) {
    const std::size_t count = sequence.poses.size();
    std::vector<float> times;
    std::vector<float> ways;
    for (std::size_t k = 0; k < count; ++k) {
        times.push_back(static_cast<float>(static_cast<double>(k) / sequence.rate));
        push(ways, (skeleton.joints[0].place + sequence.poses[k].way).eval());
    }
    const int input =
        buffer.add(times, count, "SCALAR", k_float,
                   R"(,"min":[0],"max":[)" + number(static_cast<double>(times.back())) + "]");
    std::ostringstream samplers;
    std::ostringstream channels;
    samplers << R"({"input":)" << input << R"(,"output":)"
             << buffer.add(ways, count, "VEC3", k_float) << "}";
    channels << R"({"sampler":0,"target":{"node":1,"path":"translation"}})";
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        std::vector<float> turns;
        for (const Pose& pose : sequence.poses) {
            push(turns, pose.turns[j].coeffs());
        }
        samplers << R"(,{"input":)" << input << R"(,"output":)"
                 << buffer.add(turns, count, "VEC4", k_float) << "}";
        channels << R"(,{"sampler":)" << j + 1 << R"(,"target":{"node":)" << j + 1
                 << R"(,"path":"rotation"}})";
    }
    return R"("animations":[{"name":")" + name + R"(","samplers":[)" + samplers.str() +
           R"(],"channels":[)" + channels.str() + "]}]";
}

void put(std::ofstream& file, std::uint32_t value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value); // little-endian machines
}

void put_chunk(std::ofstream& file, const char* type, std::string bytes, char filler) {
    bytes.resize((bytes.size() + 3) / 4 * 4, filler);
    put(file, static_cast<std::uint32_t>(bytes.size()));
    file.write(type, 4);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

} // namespace

void write_glb(const std::filesystem::path& path,
               const std::string& animation,
               const Figure& figure,
               const Skeleton& skeleton,
               const Eigen::MatrixXd& weights,
               const PoseSequence& sequence) {
    Buffer buffer;
    std::string json = R"({"asset":{"version":"2.0","generator":"weft animate_figure"},)";
    json += mesh_json(buffer, figure, weights) + ",";
    json += nodes_json(buffer, skeleton) + ",";
    json += animation_json(buffer, animation, skeleton, sequence) + ",";
    json += buffer.json() + "}";
    const std::size_t padded = (json.size() + 3) / 4 * 4 + (buffer.bytes().size() + 3) / 4 * 4;
    std::ofstream file(path, std::ios::binary);
    file.write("glTF", 4);
    put(file, 2);
    put(file, static_cast<std::uint32_t>(12 + 8 + 8 + padded));
    put_chunk(file, "JSON", json, ' ');
    put_chunk(file, std::string("BIN\0", 4).c_str(), buffer.bytes(), '\0');
    file.flush();
    if (!file) {
        throw std::runtime_error(path.string() + ": cannot be written");
    }
}

} // namespace weft
